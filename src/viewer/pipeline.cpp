#include "viewer/pipeline.h"

#include <fmt/format.h>

#include <utility>

#include "edgewise/contract.h"
#include "files/pictures.h"
#include "frontend/shade.h"
#include "lab/cases/backend_comparison.h"
#include "lab/cases/to_stream.h"
#include "lab/clipping/truth.h"
#include "lab/coverage/score.h"
#include "lab/view_space.h"
#include "support/milliseconds.h"
#include "viewer/annotations.h"

namespace edgewise::viewer {

namespace {

using tools::milliseconds;

lab::Size size_of(const View& view) {
  return {view.frontend.width, view.frontend.height};
}

lab::Window window_of(const View& view) {
  return {view.frontend.width, view.frontend.height};
}

// A backend that records its input instead of drawing.
class Recorder final : public Backend {
 public:
  std::vector<ScreenTriangle> triangles;

 private:
  void draw_checked(std::span<const ScreenTriangle> drawn, const FramePart&, const Execution&) override {
    triangles.assign(drawn.begin(), drawn.end());
  }
};

std::vector<std::uint32_t> colours_of(const Drawable& drawable, bool shade) {
  std::vector<std::uint32_t> colours;
  if (const auto* stream = std::get_if<TriangleStream>(&drawable)) {
    for (std::size_t i = 0; i < stream->size(); ++i) colours.push_back(stream->at(i).colour);
    return colours;
  }
  const Scene& scene = std::get<Scene>(drawable);
  return shade ? lit_colours(scene) : lab::in_world_space(scene, {}).mesh().colours;
}

// Payloads minus one: triangle indices; the background's 0 becomes lab::kNoTriangle.
std::vector<std::uint32_t> visible_ids_in(const Framebuffer& frame) {
  std::vector<std::uint32_t> ids = lab::payloads_of(frame);
  for (std::uint32_t& id : ids) --id;
  return ids;
}

}  // namespace

std::string errors_of(const Judgement& judgement) {
  std::string text = fmt::format("{} wrong of {} covered pixels", judgement.wrong, judgement.covered);
  if (!judgement.gaps) return text;
  return text + fmt::format(", gaps: {}, double hits: {}", *judgement.gaps, *judgement.double_hits);
}

Backend& Pipeline::backend(std::string_view name) {
  auto& slot = backends_[name];
  if (!slot) slot = (name == wireframe().name ? wireframe() : find_backend(name)).make();
  return *slot;
}

Picture Pipeline::draw(const lab::StageMethods& choice, const View& view) {
  Picture picture;
  FrontendOptions options = view.frontend;
  options.payload = Payload::colour;
  picture.frontend_ms =
      milliseconds([&] { screen_ = frontend_.run(view.world.drawable(), options, view.execution); });
  picture.stats = frontend_.stats();
  const lab::Size size = size_of(view);
  if (!frame_ || frame_->width() != size.width || frame_->height() != size.height) {
    frame_.emplace(size.width, size.height);
    canvas_.emplace(size.width, size.height);
  }
  if (!choice.ours()) {
    draw_composed(choice, view, picture);
    return picture;
  }
  Backend& by = backend(choice.coverage->info.name);
  const std::uint32_t background = tools::background_of(Payload::colour);
  picture.raster_ms = milliseconds([&] { by.draw(screen_, frame_->view(), {background}, view.execution); });
  picture.image = to_image(*frame_);
  return picture;
}

void Pipeline::draw_composed(const lab::StageMethods& choice, const View& view, Picture& picture) {
  double stages_ms = 0;
  const Triangles triangles = triangles_of(choice, view, stages_ms);
  if (!choice.our_facing() || !choice.our_clipping()) {
    picture.frontend_ms = stages_ms;
    picture.stats.culled = triangles.culled;
    picture.stats.emitted = triangles.snapped.size();
  }
  const VisibleIds visible = visible_ids_of(choice, view, triangles, picture.raster_ms);
  const auto colours = colours_of(view.world.drawable(), view.frontend.shade);
  picture.image = {view.frontend.width, view.frontend.height, {}};
  picture.image.pixels.reserve(visible.size());
  for (const std::uint32_t id : visible)
    picture.image.pixels.push_back(id == lab::kNoTriangle ? tools::background_of(Payload::colour)
                                                          : colours[id]);
}

void Pipeline::outline(const lab::StageMethods& choice, const View& view, Image& image) {
  double unused_ms = 0;
  const Triangles triangles = triangles_of(choice, view, unused_ms);
  const VisibleIds visible = visible_ids_of(choice, view, triangles, unused_ms);
  add_outlines(triangles.snapped, visible, backend(wireframe().name), frame_->view(), view.execution, image);
}

std::vector<TriangleState> Pipeline::states(const lab::StageMethods& choice, const View& view) {
  if (!choice.our_clipping()) return {};
  FrontendOptions options = view.frontend;
  options.keep_states = true;
  if (!choice.our_facing()) options.cull = Cull::none;
  frontend_of_ids_.run(view.world.drawable(), options, view.execution);
  std::vector<TriangleState> states(frontend_of_ids_.states().begin(), frontend_of_ids_.states().end());
  if (choice.our_facing()) return states;
  double unused_ms = 0;
  std::vector<bool> kept(states.size());
  for (const ScreenTriangle& t : triangles_of(choice, view, unused_ms).snapped) kept[t.payload - 1] = true;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (states[i] >= TriangleState::active && !kept[i]) states[i] = TriangleState::culled;
  return states;
}

Pipeline::Triangles Pipeline::from_front_end(const View& view, Cull cull) {
  FrontendOptions options = view.frontend;
  options.payload = Payload::id;
  options.keep_unsnapped = true;
  options.cull = cull;
  const auto screen = frontend_of_ids_.run(view.world.drawable(), options, view.execution);
  Triangles triangles{
      lab::unsnapped(screen, frontend_of_ids_.unsnapped()), {screen.begin(), screen.end()}, 0};
  for (auto& t : triangles.floats) ++t.payload;
  for (auto& t : triangles.snapped) ++t.payload;
  return triangles;
}

// Replaces the method's backend by one that records its input.
Pipeline::Triangles Pipeline::from_clipping(const lab::ClippingMethod& method, const View& view,
                                            double& spent_ms) {
  const lab::ClippingScene seen = lab::in_world_space(*view.world.scene(), size_of(view));
  lab::ClippingFrame frame(seen.size);
  auto recorder = std::make_unique<Recorder>();
  Triangles triangles;
  std::vector<ScreenTriangle>& recorded = recorder->triangles;
  frame.backend = std::move(recorder);
  spent_ms += milliseconds([&] { method.draw(seen, frame); });
  triangles.snapped = std::move(recorded);
  for (ScreenTriangle& t : triangles.snapped) ++t.payload;
  triangles.floats = lab::as_floats(triangles.snapped);
  return triangles;
}

void Pipeline::cull(const lab::FacingMethod& method, const View& view, Triangles& triangles,
                    double& spent_ms) {
  std::vector<std::uint8_t> fronts;  // empty: the sign of the snapped area decides the facing
  const lab::ClippingScene seen = lab::in_view_space(*view.world.scene(), size_of(view));
  if (&method != &lab::facing_methods().front())
    spent_ms += milliseconds([&] { fronts = lab::fronts_of(method, seen); });
  const auto side_of = [&](const ScreenTriangle& t) {
    const std::size_t id = t.payload - 1;
    // Facing methods test whole triangles; a triangle that crosses the near plane is judged by its clipped
    // pieces.
    const auto before_near = [&](std::size_t vertex) {
      return seen.mesh().positions[vertex].z > -seen.scene.camera.near_z;
    };
    if (fronts.empty() || before_near(3 * id) || before_near(3 * id + 1) || before_near(3 * id + 2))
      return contract::signed_area(t) < 0 ? -1 : 1;
    return fronts[id] != 0 ? 1 : -1;
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles.snapped.size(); ++i) {
    const ScreenTriangle& t = triangles.snapped[i];
    if (!seen.mesh().has_flag(t.payload - 1, kTwoSided) && !lab::keeps(view.frontend.cull, side_of(t)))
      continue;
    triangles.snapped[kept] = t;
    triangles.floats[kept++] = triangles.floats[i];
  }
  triangles.culled = triangles.snapped.size() - kept;
  triangles.snapped.resize(kept);
  triangles.floats.resize(kept);
}

Pipeline::Triangles Pipeline::triangles_of(const lab::StageMethods& choice, const View& view,
                                           double& spent_ms) {
  if (choice.our_clipping() && choice.our_facing()) return from_front_end(view, view.frontend.cull);
  Triangles triangles;
  if (choice.our_clipping())
    spent_ms += milliseconds([&] { triangles = from_front_end(view, Cull::none); });
  else
    triangles = from_clipping(*choice.clipping, view, spent_ms);
  cull(*choice.facing, view, triangles, spent_ms);
  return triangles;
}

Pipeline::VisibleIds Pipeline::visible_ids_of(const lab::StageMethods& choice, const View& view,
                                              const Triangles& triangles, double& spent_ms) {
  if (!choice.our_visibility()) return visible_ids_by(*choice.visibility, view, triangles, spent_ms);
  spent_ms = milliseconds([&] {
    if (choice.our_coverage())
      backend(choice.coverage->info.name).draw(triangles.snapped, canvas_->frame.view(), {0}, view.execution);
    else
      choice.coverage->draw({triangles.floats, triangles.snapped}, *canvas_, view.execution);
  });
  return visible_ids_in(canvas_->frame);
}

Pipeline::VisibleIds Pipeline::visible_ids_by(const lab::VisibilityMethod& method, const View& view,
                                              const Triangles& triangles, double& spent_ms) {
  std::vector<ScreenTriangle> by_id = triangles.snapped;
  std::vector<UnsnappedTriangle> at;
  for (ScreenTriangle& t : by_id) --t.payload;
  for (const lab::FloatTriangle& t : triangles.floats) at.push_back(t.at);
  const auto scene = lab::visibility_scene(by_id, at, *view.world.scene(), size_of(view));
  spent_ms = milliseconds([&] { method.draw(scene, visibility_frame_); });
  VisibleIds visible;
  visible.reserve(visibility_frame_.visible.size());
  for (const std::uint32_t i : visibility_frame_.visible)
    visible.push_back(i == lab::kNoTriangle ? lab::kNoTriangle : by_id[i].payload);
  return visible;
}

Pipeline::VisibleIds Pipeline::true_visible_ids(const View& view, const Triangles& triangles, Truth truth,
                                                std::string_view by) {
  if (truth == Truth::contract) {
    backend(by).draw(triangles.snapped, canvas_->frame.view(), {0}, view.execution);
    return visible_ids_in(canvas_->frame);
  }
  const auto visible_in = [&](const auto& list) {
    return lab::exact_visible_triangles(std::span(list), window_of(view), view.execution.threads).triangle;
  };
  VisibleIds visible = truth == Truth::snapped ? visible_in(triangles.snapped) : visible_in(triangles.floats);
  for (std::uint32_t& i : visible)
    if (i != lab::kNoTriangle) i = triangles.snapped[i].payload - 1;
  return visible;
}

Judgement Pipeline::judge(const lab::StageMethods& choice, const View& view, Truth truth) {
  double unused_ms = 0;
  const Triangles triangles = triangles_of(choice, view, unused_ms);
  const VisibleIds drawn = visible_ids_of(choice, view, triangles, unused_ms);

  // The reference picture comes from a different backend than the judged one.
  const bool is_first = choice.coverage->info.name == backends().front().name;
  const std::string_view by = backends()[is_first ? 1 : 0].name;
  VisibleIds expected = [&] {
    if (choice.our_clipping() && choice.our_facing()) return true_visible_ids(view, triangles, truth, by);
    const lab::StageMethods exact = lab::our_choice(by);
    if (choice.our_clipping()) return true_visible_ids(view, triangles_of(exact, view, unused_ms), truth, by);
    // Clipping methods work on slightly rounded world-space vertices, so the reference must clip the same
    // vertices.
    Triangles clipped = from_clipping(*exact.clipping, view, unused_ms);
    cull(*exact.facing, view, clipped, unused_ms);
    return true_visible_ids(view, clipped, truth, by);
  }();
  // That reference starts from our front end, which the exact picture of the same vertices judges.
  if (const Scene* scene = view.world.scene()) {
    std::optional<Scene> rounded;
    if (!choice.our_clipping()) rounded = lab::in_world_space(*scene, size_of(view)).scene;
    const Scene& seen = rounded ? *rounded : *scene;
    lab::correct(expected, size_of(view), lab::ClippingOracle(seen, size_of(view), view.frontend.cull),
                 view.execution.threads);
  }

  Judgement judgement;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] != lab::kNoTriangle) ++judgement.covered;
    if (expected[i] != drawn[i]) ++judgement.wrong;
  }
  judgement.marks = lab::mark_visible_triangles(expected, drawn, window_of(view)).marks;
  if (choice.our_coverage()) return judgement;

  const lab::CoverageInput input{triangles.floats, triangles.snapped};
  const lab::CoverageTruth covered = lab::float_coverage(input, window_of(view), view.execution.threads);
  const lab::DrawnRuns runs(*choice.coverage, input, window_of(view));
  const lab::Cracks cracks =
      lab::CrackJudge(triangles.floats, covered).find(runs, choice.coverage->promise.snap_bits);
  judgement.gaps = cracks.gaps.size(), judgement.double_hits = cracks.double_hits.size();
  const auto marked = lab::mark_coverage(covered, runs, cracks, lab::FloatSource(triangles.floats));
  for (std::size_t i = 0; i < marked.marks.size(); ++i)
    if (marked.marks[i] == lab::Mark::gap || marked.marks[i] == lab::Mark::twice)
      judgement.marks[i] = marked.marks[i];
  return judgement;
}

}  // namespace edgewise::viewer
