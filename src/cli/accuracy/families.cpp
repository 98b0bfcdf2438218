// Judges methods against the exact references of their family.
#include <algorithm>

#include "cli/accuracy/score.h"
#include "core/parallel.h"
#include "lab/cases/backend_comparison.h"

namespace edgewise::tools {

namespace {

// Calls score_one(method) for all methods, on several threads.
template <typename Method, typename ScoreOne>
void score_all(const std::vector<const Method*>& methods, const Judging& judging, SceneResult& result,
               ScoreOne&& score_one) {
  result.methods.resize(methods.size());
  parallel_for(judging.plan.threads, static_cast<int>(methods.size()), [&](int n) {
    const auto i = static_cast<std::size_t>(n);
    const lab::MethodInfo& info = methods[i]->info;
    result.methods[i] = {std::string(info.name), info.exact, score_one(*methods[i])};
  });
}

// Pixels that show a triangle.
std::uint64_t covered_pixels(const std::vector<std::uint32_t>& visible) {
  return static_cast<std::uint64_t>(
      std::count_if(visible.begin(), visible.end(), [](std::uint32_t id) { return id != lab::kNoTriangle; }));
}

bool on_our_grid(const lab::CoverageScene& scene) {
  constexpr int kOurs = 8;
  const auto is_rounded = [](float px) { return lab::rounded_to(double{px}, kOurs) == double{px}; };
  return std::ranges::all_of(scene.floats, [&](const lab::FloatTriangle& t) {
    return std::ranges::all_of(t.at.x_px, is_rounded) && std::ranges::all_of(t.at.y_px, is_rounded);
  });
}

}  // namespace

// Every method's pixels of every triangle, with both references.
void judge(const lab::CoverageScene& scene, const Judging& judging, SceneResult& result) {
  const auto& methods = judging.methods.coverage;
  const auto input = scene.input();
  const auto snapped = lab::snapped_coverage(input, scene.window(), judging.plan.threads);
  const lab::SourceJudge source(scene, judging.plan.threads);
  result.triangles = scene.floats.size();
  result.covered = snapped.covered;
  result.crossings = lab::edge_crossings(source.source(), scene.window());
  const lab::CrackJudge crack_judge(scene.floats, source.floats());
  result.shared_crossings = crack_judge.surface().crossings(scene.window());
  result.largest_side_px = lab::largest_side_px(scene.floats);
  if (result.kind != SceneKind::small)
    result.kind = on_our_grid(scene)             ? SceneKind::our_grid
                  : result.shared_crossings != 0 ? SceneKind::meshes
                                                 : SceneKind::triangles;

  result.methods.resize(methods.size());
  std::vector<Closeup> closeups(methods.size());
  const lab::VisibleTriangleJudge visible(scene, crack_judge.surface(), judging.plan.threads);
  result.slits = visible.slits();
  parallel_for(judging.plan.threads, static_cast<int>(methods.size()), [&](int n) {
    const auto i = static_cast<std::size_t>(n);
    const lab::CoverageMethod& method = *methods[i];
    const lab::DrawnRuns drawn(method, input, scene.window());
    const lab::Cracks cracks = crack_judge.find(drawn, scene.snap_bits(method));
    CoverageScores scores{lab::score_coverage(snapped, drawn, scene.floats), source.score(drawn),
                          CrackCounts(cracks), visible.score(method)};
    result.methods[i] = {std::string(method.info.name), is_exact(method, scene.subpixel_bits), scores};
    if (judging.plan.pictures && judging.scene.smallest && scores.source.errors() != 0)
      closeups[i] = closeup(closeup_name(Family::coverage, judging.scene.name, method.info.name),
                            mark_coverage(source.truth(), source.of_sources(drawn), cracks, source.source()));
  });
  const std::size_t first = judging.closeups.size();
  for (Closeup& c : closeups)
    if (!c.name.empty()) add_unless_known(std::move(c), judging.closeups, first);
}

void judge(const lab::VisibilityScene& scene, const Judging& judging, SceneResult& result) {
  const auto& methods = judging.methods.visibility;
  const auto truth = lab::true_visible_triangles(scene);
  result.triangles = scene.triangles.size();
  result.covered = covered_pixels(truth.snapped);
  score_all(methods, judging, result,
            [&](const lab::VisibilityMethod& method) { return lab::score(method, scene, truth); });
}

void judge(const lab::FacingScene& scene, const Judging& judging, SceneResult& result) {
  const auto& methods = judging.methods.facing;
  const auto facts = lab::facing_facts(scene, judging.plan.threads);
  result.triangles = scene.faces.size();
  result.covered = static_cast<std::uint64_t>(std::count_if(
      facts.begin(), facts.end(), [](const lab::FaceFacts& f) { return f.source.covers_sample; }));
  score_all(methods, judging, result,
            [&](const lab::FacingMethod& method) { return lab::score(method, scene, facts); });
}

void judge(const lab::ClippingScene& scene, const Judging& judging, SceneResult& result) {
  const auto& methods = judging.methods.clipping;
  const auto truth = lab::clipping_truth(scene, judging.plan.threads);
  result.triangles = scene.mesh().triangles.size();
  result.covered = covered_pixels(truth.visible);
  score_all(methods, judging, result,
            [&](const lab::ClippingMethod& method) { return lab::score(method, scene, truth); });
  if (!judging.plan.pictures || !judging.scene.smallest) return;
  lab::ClippingFrame frame(scene.size);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const auto& score = std::get<lab::ClippingScore>(result.methods[i].score);
    if (score.missing + score.extra + score.wrong_triangle == 0) continue;  // it doesn't show wrong depths
    methods[i]->draw(scene, frame);
    judging.closeups.push_back(
        closeup(closeup_name(Family::clipping, judging.scene.name, methods[i]->info.name),
                lab::mark_visible_triangles(truth.visible, lab::payloads_of(frame.picture),
                                            {scene.size.width, scene.size.height})));
  }
}

void judge(const lab::ProjectionScene& scene, const Judging& judging, SceneResult& result) {
  const auto& methods = judging.methods.projection;
  std::vector<lab::ProjectionScore> scores(methods.size());
  for (int frame = 0; frame < scene.frames; ++frame) {
    const lab::ProjectionJudge judge(scene.make(frame), scene.size, judging.plan.threads);
    result.triangles += judge.triangles();
    result.covered += judge.covered();
    result.crossings += judge.crossings();
    parallel_for(judging.plan.threads, static_cast<int>(methods.size()), [&](int n) {
      const auto i = static_cast<std::size_t>(n);
      scores[i] += judge.score(*methods[i]);
    });
  }
  for (std::size_t i = 0; i < methods.size(); ++i)
    result.methods.push_back({std::string(methods[i]->info.name), methods[i]->info.exact, scores[i]});
}

}  // namespace edgewise::tools
