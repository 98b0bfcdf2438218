// Projection methods: what arithmetic turns a scene's vertices into positions on the screen, and to how many
// subpixel bits these are rounded. All else is exact, so a score says which part of a picture's errors comes
// from where: from rounding, or from the arithmetic before it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "lab/coverage/cracks.h"
#include "lab/projection/truth.h"

namespace edgewise::lab {

// One or more views, judged together: all triangles in them, front and back.
struct ProjectionScene {
  Size size;
  int frames;
  std::function<Scene(int frame)> make;
};

// A sphere of radius 1 about the origin, of so many rings and segments.
Scene sphere_scene(unsigned rings, unsigned segments);
// The same with its vertices, and the camera, moved by `away` along each axis in the mesh's own space: floats
// then hold the vertices less precisely.
Scene sphere_far_from_origin(double away);
// The same seen from a distance, as large in the picture.
Scene sphere_far_from_camera(double distance);

// A triangle's positions in pixels, exact in double. A clipped triangle becomes several.
struct ProjectedTriangle {
  double x_px[3], y_px[3];
  std::uint32_t source;  // the triangle of the scene
};

struct ProjectionMethod {
  MethodInfo info;
  std::optional<int> snap_bits;  // the subpixel bits to which it rounds positions, half to even
  // Of all triangles that the truth shows.
  std::vector<ProjectedTriangle> (*project)(const SceneTruth& scene, std::optional<int> snap_bits);
};

// The exact projection, clipped exactly, then rounded.
std::vector<ProjectedTriangle> exactly_projected(const SceneTruth& scene, int subpixel_bits);

// Ours first. The table is in methods.cpp.
std::span<const ProjectionMethod> projection_methods();

// (triangle, pixel) pairs that a method draws and the truth lacks, or the other way round.
struct ProjectionScore {
  std::uint64_t wrong = 0;  // against the exact projection
  // Of the exact projection rounded to the method's bits: against the exact one, and against the method's.
  std::uint64_t by_rounding = 0, by_projection = 0;
  std::uint64_t folds = 0;  // see Cracks::folds; clipped triangles do not count

  ProjectionScore& operator+=(const ProjectionScore& other);
  bool operator==(const ProjectionScore&) const = default;
};

// Judges methods on one view, in a window of its image. All functions may be called from several threads.
class ProjectionJudge {
 public:
  ProjectionJudge(Scene scene, Size size, int threads);
  std::uint64_t triangles() const;  // that can be seen
  std::uint64_t covered() const { return exact_.covered; }
  std::uint64_t crossings() const { return crossings_; }
  ProjectionScore score(const ProjectionMethod& method) const;

 private:
  struct Rounded {
    std::once_flag once;
    std::vector<Run> runs;
    std::uint64_t wrong = 0;
  };
  std::vector<Run> runs_of(std::span<const ProjectedTriangle> triangles) const;
  const Surface& surface() const;
  const Rounded& rounded(int bits) const;

  SceneTruth truth_;
  CoverageTruth exact_;
  std::uint64_t crossings_;
  mutable std::once_flag surface_once_;
  mutable std::vector<FloatTriangle> outlines_;  // by triangle, rounded to float
  mutable std::optional<Surface> surface_;
  mutable std::array<Rounded, kMostSnapBits + 1> rounded_;
};

}  // namespace edgewise::lab
