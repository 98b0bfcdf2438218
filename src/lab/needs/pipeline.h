// Whole pipelines, from the vertices of a frame to the visible triangle of each pixel. All run in the same
// scalar code on one thread, which is a reference, not optimized.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "frontend/clip.h"
#include "lab/needs/question.h"
#include "lab/visibility/visibility.h"

namespace edgewise::lab {

// The first three are those of ViewPlane.
enum Stage : std::size_t { kNearPlane, kFarPlane, kGuardBand, kFacing, kVisibility, kDepth, kSubpixel };
inline constexpr std::size_t kStages = kSubpixel + 1;
// A level per stage: 0 is the least precise. The exact pipeline, that of the library, has the highest ones.
using Pipeline = std::array<int, kStages>;

enum PlaneLevel { kNothing, kDrop, kClip };
inline constexpr int kDepthBuffer = 3;  // the level of kVisibility

// The stage's name, and its levels as answers.
Question levels_of(Stage stage);
// Float depth buffers: the levels of kDepth above the exact one.
Question float_depths();
Pipeline exact_pipeline();
// By the names of stages and levels; a stage without one is exact. Throws std::invalid_argument for a level
// that does not exist.
Pipeline pipeline_of(const std::map<std::string, std::string>& levels);

struct ProjectedVertex {
  float x_px, y_px;
  double view_z;
  Vertex snapped;  // to the pipeline's bits
};

// The memory of a draw, for the next one.
struct PipelineMemory {
  std::vector<ProjectedVertex> vertices;
  Clipper clipper;
  VisibilityScene scene{};  // the assembled triangles; payloads are ids
  VisibilityFrame frame;

  // The id that each pixel shows, or kNoTriangle, row by row.
  std::vector<std::uint32_t> picture() const;
};

// A frame that pipelines draw. Of what they need, it prepares the normals of faces and the mean of all
// vertices.
class PipelineFrame {
 public:
  PipelineFrame(const Drawable& drawable, const FrontendOptions& options);
  Size size() const { return size_; }

  void draw(const Pipeline& pipeline, PipelineMemory& memory) const;

  // The picture that is right, as PipelineMemory::picture(): each pixel shows the triangle that is visible by
  // the positions snapped to 8 bits and the exact planes through the given distances. By the truths' own
  // arithmetic, from the library's front end on. Throws what Frontend::run() throws.
  std::vector<std::uint32_t> right() const;

 private:
  Drawable drawable_;
  Size size_;
  Cull cull_;
  glm::dvec3 centre_{0.0};  // the mean of all triangles' vertices
};

}  // namespace edgewise::lab
