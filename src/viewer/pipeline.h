// Draws a scene by the chosen methods and judges the picture. Composes the stages of the library and of
// src/lab. The times cover the stages only, not the composition.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/frontend.h"
#include "edgewise/image.h"
#include "lab/error_marks.h"
#include "lab/stage_methods.h"
#include "viewer/world.h"

namespace edgewise::viewer {

struct View {
  const World& world;
  FrontendOptions frontend;  // the pipeline sets payload and keep_unsnapped
  Execution execution;
};

struct Picture {
  Image image;
  double frontend_ms = 0, raster_ms = 0;
  FrontendStats stats;
};

// The reference that pictures are compared with. `contract`: the library's picture. `snapped`: exact depths
// for snapped positions, so rounded depths count as errors too. `floats`: exact for positions before
// snapping, so snapping counts too. Clipping methods return snapped positions only: for them the last two are
// the same. All three start from a front end's triangles. Of a scene they are therefore compared with the
// exact picture (lab/clipping/truth.h), which replaces them where they differ by more than 1/64 px.
enum class Truth { contract, snapped, floats };

struct Judgement {
  std::uint64_t covered = 0;  // pixels where the reference shows a triangle
  std::uint64_t wrong = 0;    // pixels whose visible triangle (or background) differs from the reference
  // Coverage methods other than backends only: pixels that no triangle draws between neighbours, and pixels
  // drawn twice where at most one triangle is, visible or not.
  std::optional<std::uint64_t> gaps, double_hits;
  std::vector<lab::Mark> marks;  // row by row
};
// "12 wrong of 3456 covered pixels, gaps: 2, double hits: 1"
std::string errors_of(const Judgement& judgement);

// Reuses its buffers between frames.
class Pipeline {
 public:
  // The choice must be drawable (lab::drawable_part).
  Picture draw(const lab::StageMethods& choice, const View& view);
  // Judges the picture of this choice and view; the choice must fill triangles.
  Judgement judge(const lab::StageMethods& choice, const View& view, Truth truth);
  // Adds outlines to the picture of the last draw; same choice and view.
  void outline(const lab::StageMethods& choice, const View& view, Image& image);
  // The state of each triangle of a scene; empty for the clipping methods of src/lab, which don't report
  // states.
  std::vector<TriangleState> states(const lab::StageMethods& choice, const View& view);
  // The output of the last draw's front end.
  std::span<const ScreenTriangle> screen_triangles() const { return screen_; }

 private:
  // The input of the coverage stage. A payload is the triangle's index in the scene plus one, because 0 is
  // the background of lab::Canvas.
  struct Triangles {
    std::vector<lab::FloatTriangle> floats;
    std::vector<ScreenTriangle> snapped;
    std::uint64_t culled = 0;  // dropped by cull()
  };
  // Per pixel, row by row: the visible triangle's index in the scene, or lab::kNoTriangle.
  using VisibleIds = std::vector<std::uint32_t>;

  void draw_composed(const lab::StageMethods& choice, const View& view, Picture& picture);
  Triangles triangles_of(const lab::StageMethods& choice, const View& view, double& spent_ms);
  Triangles from_front_end(const View& view, Cull cull);
  Triangles from_clipping(const lab::ClippingMethod& method, const View& view, double& spent_ms);
  void cull(const lab::FacingMethod& method, const View& view, Triangles& triangles, double& spent_ms);
  VisibleIds visible_ids_of(const lab::StageMethods& choice, const View& view, const Triangles& triangles,
                            double& spent_ms);
  VisibleIds visible_ids_by(const lab::VisibilityMethod& method, const View& view, const Triangles& triangles,
                            double& spent_ms);
  // `by`: the backend that draws the picture for Truth::contract.
  VisibleIds true_visible_ids(const View& view, const Triangles& triangles, Truth truth, std::string_view by);
  Backend& backend(std::string_view name);

  Frontend frontend_, frontend_of_ids_;
  std::map<std::string_view, std::unique_ptr<Backend>> backends_;
  std::optional<Framebuffer> frame_;
  std::optional<lab::Canvas> canvas_;
  lab::VisibilityFrame visibility_frame_;
  std::span<const ScreenTriangle> screen_;
};

}  // namespace edgewise::viewer
