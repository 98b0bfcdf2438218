// Which faces look at the eye: the tests that engines use to drop the others, against the exact sign of the
// projected area, in two truths. One takes the positions as given and projects them by rationals; the other
// takes what a rasterizer draws, the positions that the front end would hand it, projected in float and
// snapped, as exact from there on.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lab/method.h"

namespace edgewise::lab {

// right, down and forward form a right-handed frame. A point p is seen at
//   size / 2 + focal_px (right·(p - eye), down·(p - eye)) / w,
// where w is forward·(p - eye) under perspective and 1 under an orthographic camera. Vertices must have w >
// 0.
struct FacingView {
  bool perspective = true;
  glm::vec3 eye{0.0f}, right{1.0f, 0.0f, 0.0f}, down{0.0f, 1.0f, 0.0f}, forward{0.0f, 0.0f, 1.0f};
  float focal_px = 128.0f;
  Size size{256, 256};
};

// A polygon, planar or not; front is the sign of its whole projected area, clockwise on the y-down screen.
// Methods look at its first three vertices, as the trainer does.
struct Face {
  std::uint32_t first, count;  // into FacingScene::positions; count >= 3
};

struct FacingScene {
  FacingView view;
  std::vector<glm::vec3> positions;
  std::vector<Face> faces;
};

// In one truth.
struct FaceSide {
  bool covers_sample;    // a sample lies in the projection
  bool front;            // the whole polygon
  bool first_three_lie;  // the first three vertices turn the other way than the polygon (they are a reflex
                         // corner, say)
};

// What is known exactly of a face, rounded to double only now: how near it is to being seen edge-on.
struct FaceFacts {
  FaceSide snapped, floats;
  // All before snapping:
  double sine;         // of the angle between the face's plane and the ray to its first three vertices' mean
  double tilt_sine;    // of the angle between that ray (from the eye, whatever the camera) and forward
  double object_sine;  // of the angle between that ray and the one to the mean of all positions
  double width_px;     // least height of the first three vertices on the screen
  // How rounding a position is magnified in a normal times a ray: the product of the first two sides over the
  // area they span, at least 1, times what is lost by measuring from an origin that lies elsewhere than the
  // eye.
  double magnification;
  double rounding_px;  // bound on the error of projecting these vertices in float
};
class FacingTruth {
 public:
  explicit FacingTruth(const FacingScene& scene);  // which must outlive it
  FaceFacts facts(const Face& face) const;

 private:
  const FacingScene& scene_;
  glm::tvec3<long double> object_;  // the mean of all positions
};
std::vector<FaceFacts> facing_facts(const FacingScene& scene);

struct FacingMethod {
  MethodInfo info;
  // The timed part: front[i] = 1 if face i is kept, else 0. `front` has one entry a face.
  void (*classify)(const FacingScene& scene, std::span<std::uint8_t> front);
  // The promise: false if the method can't be wrong about the sign of the first three vertices.
  bool (*may_err)(const FaceFacts& face, const FacingView& view);
  bool by_direction = false;  // it asks nothing of the view but `forward`
};

// Ours first.
std::span<const FacingMethod> facing_methods();

// Against one truth.
struct FacingScore {
  std::uint64_t faces = 0;           // that own a pixel
  std::uint64_t misclassified = 0;   // of those
  std::uint64_t by_first_three = 0;  // of those, faces whose first three vertices lie: nobody could know
};
struct FacingScores {
  FacingScore snapped, floats;
  std::uint64_t disagreements = 0;  // with the first method (ours), of all faces
  // Promises broken, where the first three vertices don't lie: misclassified before snapping though may_err
  // says that it can't be, or snapped by an exact method.
  std::uint64_t broken = 0;
};
FacingScores score(const FacingMethod& method, const FacingScene& scene, std::span<const FaceFacts> facts);

// The smallest scenes.
struct FacingCase {
  std::string_view name, idea;
  FacingScene (*make)();
};
std::span<const FacingCase> facing_cases();

// Small faces of random directions, spread over an arc of half a turn about the axis: the ray to each is
// tilted by `tilt` radians, below 90 degrees, while the ray to the mean of all is one that hardly any of them
// has.
FacingScene tilted_faces(double tilt, bool perspective, std::size_t count, std::uint64_t seed);
// Polygons of three to seven vertices all over the view, in random directions. Regular ones are convex; of
// the others corners may be reflex, and the bent ones are not planar.
enum class Shape { regular, irregular, bent };
FacingScene polygons(Shape shape, std::size_t count, std::uint64_t seed);
// Triangles that are almost edge-on, along lines through pixel centres.
FacingScene edge_on_faces(bool perspective, std::size_t count, std::uint64_t seed);

}  // namespace edgewise::lab
