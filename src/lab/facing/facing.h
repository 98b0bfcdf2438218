// Facing methods: the tests by which engines drop back faces, scored against the exact sign of the projected
// area. There are two truths. That of the source projects the given positions in rationals. The snapped truth
// takes the positions that a rasterizer draws, projected in float and snapped, and is exact from there on.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lab/method.h"

namespace edgewise::lab {

// right, down and forward form a right-handed frame. A point p is projected to
//   size / 2 + focal_px (right·(p - eye), down·(p - eye)) / w,
// where w is forward·(p - eye) under perspective and 1 under an orthographic camera. Vertices must have w >
// 0.
struct FacingView {
  bool perspective = true;
  glm::vec3 eye{0.0f}, right{1.0f, 0.0f, 0.0f}, down{0.0f, 1.0f, 0.0f}, forward{0.0f, 0.0f, 1.0f};
  float focal_px = 128.0f;
  Size size{256, 256};
};

// The projection in float, as methods and the snapped truth use it.
class FloatProjector {
 public:
  explicit FloatProjector(const FacingView& view)
      : view_(view),
        centre_px_(static_cast<float>(view.size.width) * 0.5f, static_cast<float>(view.size.height) * 0.5f) {}
  glm::vec2 operator()(glm::vec3 p) const {
    const glm::vec3 ray = p - view_.eye;
    const float scale = view_.perspective ? view_.focal_px / glm::dot(view_.forward, ray) : view_.focal_px;
    return centre_px_ + scale * glm::vec2(glm::dot(view_.right, ray), glm::dot(view_.down, ray));
  }

 private:
  FacingView view_;
  glm::vec2 centre_px_;
};

// A polygon, planar or not. It is a front face if its whole projected area is clockwise on the y-down screen.
// As in the engines, methods read a stored normal of the face, or the positions of its first three vertices.
struct Face {
  std::uint32_t first, count;  // into FacingScene::positions; count >= 3
  glm::vec3 normal;            // face_normal() of its vertices
};

struct FacingScene {
  FacingView view;
  std::vector<glm::vec3> positions;
  std::vector<Face> faces;

  // Appends a face of the positions from index `first` on.
  void add_face(std::size_t first);
};

// A face's exact orientation in one truth.
struct FaceSide {
  bool covers_sample;       // the projection covers a sample
  bool front;               // the whole polygon
  bool first_three_differ;  // the first three vertices have another orientation than the polygon (for
                            // example at a reflex corner)
};

// Exact orientations of a face, and measures of how near it is to edge-on, rounded to double.
struct FaceFacts {
  FaceSide snapped, source;
  // All before snapping:
  bool normal_differs;  // the polygon is bent: by its normal, a vertex is seen from another side than the
                        // whole
  // The least distance of the camera from the planes of the face's normal through its first three vertices,
  // over the length of the ray to their mean: for a planar face, the sine of the angle between ray and plane.
  double sine;
  double tilt_sine;    // of the angle between that ray (from the eye, whatever the camera) and forward
  double object_sine;  // of the angle between that ray and the one to the mean of all positions
  double width_px;     // least height of the first three vertices on the screen
  // The factor by which the dot product of normal and ray magnifies the rounding of a position: 1 + |camera
  // position| / |ray|.
  double magnification;
  double rounding_px;  // bound on the error of projecting these vertices in float
};
std::vector<FaceFacts> facing_facts(const FacingScene& scene, int threads = 1);

struct FacingMethod {
  MethodInfo info;
  // The timed part: front[i] = 1 if face i is kept, else 0. `front` has one entry per face.
  void (*classify)(const FacingScene& scene, std::span<std::uint8_t> front);
  // The promise: false if the method cannot misjudge the orientation of its input, which is the normal, or
  // the first three vertices.
  bool (*may_err)(const FaceFacts& face, const FacingView& view);
  bool by_normal = false;  // uses the face's normal
};

// Ours first. The table is in methods.cpp.
std::span<const FacingMethod> facing_methods();

// The score against one truth.
struct FacingScore {
  std::uint64_t faces = 0;          // faces that cover a sample
  std::uint64_t misclassified = 0;  // of these
  // Of these, faces whose normal_differs or whose first_three_differ, whichever the method judges by.
  std::uint64_t misled = 0;
};
struct FacingScores {
  FacingScore snapped, source;
  // Broken promises, without misled ones: misclassified against the source though may_err is false, or
  // by an exact method against the snapped truth.
  std::uint64_t broken = 0;
};
FacingScores score(const FacingMethod& method, const FacingScene& scene, std::span<const FaceFacts> facts);

// Small scenes on which methods fail.
struct FacingCase {
  std::string_view name;
  FacingScene (*make)();
};
std::span<const FacingCase> facing_cases();

// Small faces of random directions, spread over an arc of half a turn about the view axis. The ray to each is
// tilted by `tilt` radians, below 90 degrees; hardly any has the same ray as the mean of all faces.
FacingScene tilted_faces(double tilt, bool perspective, std::size_t count, std::uint64_t seed);
// Polygons of three to seven vertices in random directions, spread over the view. Regular ones are convex;
// the others may have reflex corners, and bent ones are not planar.
enum class Shape { regular, irregular, bent };
FacingScene polygons(Shape shape, std::size_t count, std::uint64_t seed);
// Triangles that are almost edge-on, along lines through pixel centres.
FacingScene edge_on_faces(bool perspective, std::size_t count, std::uint64_t seed);

}  // namespace edgewise::lab
