// Coverage: compares every method's pixels of every triangle with both references.
#include <algorithm>

#include "cli/accuracy/score.h"
#include "core/parallel.h"

namespace edgewise::tools {

namespace {

bool on_our_grid(const lab::CoverageScene& scene) {
  constexpr int kOurs = 8;
  const auto is_rounded = [](float px) { return lab::rounded_to(double{px}, kOurs) == double{px}; };
  return std::ranges::all_of(scene.floats, [&](const lab::FloatTriangle& t) {
    return std::ranges::all_of(t.at.x_px, is_rounded) && std::ranges::all_of(t.at.y_px, is_rounded);
  });
}

}  // namespace

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

}  // namespace edgewise::tools
