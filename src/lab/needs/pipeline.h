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
#include "lab/coverage/coverage.h"
#include "lab/needs/question.h"
#include "lab/visibility/visibility.h"

namespace edgewise::lab {

// The first three are those of ViewPlane.
enum Stage : std::size_t { kNearPlane, kFarPlane, kGuardBand, kFacing, kSubpixel, kVisibility, kDepth };
inline constexpr std::size_t kStages = kDepth + 1;
// A level per stage: 0 is the least precise. The exact pipeline, that of the library, has the highest ones.
using Pipeline = std::array<int, kStages>;

enum PlaneLevel { kNothing, kDrop, kClip };
inline constexpr int kNoTest = 0, kSnappedArea = 5;  // levels of kFacing
inline constexpr int kDepthBuffer = 3;               // the level of kVisibility
inline constexpr int kOurDepth = 30;                 // that of kDepth

std::string name_of(Stage stage);
// From the least precise on. Those of kDepth above the exact one are floats, beside the order.
std::vector<std::string> levels_of(Stage stage);
Pipeline exact_pipeline();
// Whether a differs from b, and each of its stages is the same or weaker. No facing test is weaker than any
// other; `submission_order` than each painter, and these than a depth buffer; fewer bits than more bits.
bool is_weaker(const Pipeline& a, const Pipeline& b);

using Levels = std::map<std::string, std::string>;  // by the names of stages
// A stage without a level is exact. Throws std::invalid_argument for a level that does not exist.
Pipeline pipeline_of(const Levels& levels);

// The id that each pixel must show or kNoTriangle, row by row: by the scene's own vertices, or the stream's.
std::vector<std::uint32_t> right_picture(const CoverageScene& scene, int threads);

struct ProjectedVertex {
  float x_px, y_px;
  double view_z;
  Vertex snapped;  // to the pipeline's bits
};

// The memory of a draw, for the next one.
struct PipelineMemory {
  std::vector<ProjectedVertex> vertices;
  Clipper clipper;
  VisibilityScene scene{};            // the assembled triangles; payloads are ids
  std::vector<std::uint8_t> kept_by;  // of each of these: bit t is set if facing test t was made and keeps it
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
  // Makes the triangles that every facing test and every visibility of such a pipeline begins with.
  void assemble(const Pipeline& pipeline, PipelineMemory& memory) const { assemble(pipeline, true, memory); }

 private:
  void assemble(const Pipeline& pipeline, bool for_all, PipelineMemory& memory) const;

  Drawable drawable_;
  Size size_;
  Cull cull_;
  glm::dvec3 centre_{0.0};  // the mean of all triangles' vertices
};

}  // namespace edgewise::lab
