// From a scene to a picture by the chosen methods, and the judgement of it. Composes the library's parts and
// the laboratory's; what is measured is their work and not the composing.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/frontend.h"
#include "edgewise/image.h"
#include "lab/choice.h"
#include "lab/error_marks.h"
#include "lab/hidden_faces.h"
#include "viewer/world.h"

namespace edgewise::viewer {

struct View {
  const World& world;
  FrontendOptions frontend;  // payload and keep_unsnapped are the pipeline's business
  Execution execution;
};

struct Picture {
  Image image;
  double frontend_ms = 0, raster_ms = 0;
  FrontendStats stats;
};

// What pictures are judged against. Each next one blames a picture for more: `contract` for what differs from
// the library's bits, `snapped` for the rounding of depths too, `floats` for snapping too. (Clipping methods
// hand on snapped positions only: for them the last two are one.)
enum class Truth { contract, snapped, floats };
inline constexpr Truth kTruths[] = {Truth::contract, Truth::snapped, Truth::floats};
std::string_view name_of(Truth truth);

struct Judgement {
  std::uint64_t covered = 0;  // pixels that show a triangle, in truth
  std::uint64_t wrong = 0;    // pixels that show another one, or none, or one where none is
  // Of coverage methods other than the backends: pixels that nobody draws between neighbours, and pixels
  // drawn twice where at most one triangle is, whatever is seen of it.
  std::optional<std::uint64_t> gaps, double_hits;
  std::vector<lab::Mark> marks;  // row by row
};

// Keeps its memory between frames.
class Pipeline {
 public:
  // The choice must be drawable (drawable_part).
  Picture draw(const lab::Choice& choice, const View& view);
  // Of the same choice and view; the choice must be one that fills.
  Judgement judge(const lab::Choice& choice, const View& view, Truth truth);
  // Over the picture of the last draw, by the same choice and view.
  void outline(const lab::Choice& choice, const View& view, Image& image);
  // What became of each triangle of a scene; none is known of what a clipping method of the laboratory cuts.
  std::vector<TriangleState> states(const lab::Choice& choice, const View& view);
  // What the last draw's front end would hand to a backend.
  std::span<const ScreenTriangle> screen_triangles() const { return screen_; }

 private:
  // Triangles that await coverage. Their payload is their index in the scene plus one, since 0 is the
  // background of the laboratory's canvas.
  struct Triangles {
    std::vector<lab::FloatTriangle> floats;
    std::vector<ScreenTriangle> snapped;
    std::uint64_t culled = 0;  // dropped by cull()
  };
  // Row by row, a triangle's index in the scene or lab::kNobody.
  using Owners = std::vector<std::uint32_t>;

  void draw_ours(const lab::Choice& choice, const View& view, Picture& picture);
  // Times a method that drops hidden faces before anything is projected at its own work.
  void run_dropped(const lab::FacingMethod& method, const View& view, Picture& picture);
  void draw_composed(const lab::Choice& choice, const View& view, Picture& picture);
  Triangles triangles_of(const lab::Choice& choice, const View& view, double& spent_ms);
  Triangles from_front_end(const View& view, Cull cull);
  Triangles from_clipping(const lab::ClippingMethod& method, const View& view, double& spent_ms);
  void cull(const lab::FacingMethod& method, const View& view, Triangles& triangles, double& spent_ms);
  Owners owners_of(const lab::Choice& choice, const View& view, const Triangles& triangles, double& spent_ms);
  Owners owners_by_visibility(const lab::VisibilityMethod& method, const View& view,
                              const Triangles& triangles, double& spent_ms);
  // `by`: the backend that draws the contract's picture.
  Owners true_owners(const View& view, const Triangles& triangles, Truth truth, std::string_view by);
  Backend& backend(std::string_view name);

  Frontend frontend_, frontend_of_ids_;
  std::map<std::string_view, std::unique_ptr<Backend>> backends_;
  std::optional<Framebuffer> frame_;
  std::optional<lab::Canvas> canvas_;
  lab::VisibilityFrame visibility_frame_;
  std::span<const ScreenTriangle> screen_;
  std::optional<lab::HiddenFaces> hidden_;  // of the scene at this address
  const Scene* hidden_of_ = nullptr;
};

}  // namespace edgewise::viewer
