// Counts gaps and double hits in each frame of the tutorials' rotating cube.
#include <algorithm>

#include "cli/accuracy/score.h"
#include "core/parallel.h"
#include "edgewise/builtin.h"

namespace edgewise::tools {

namespace {

constexpr lab::Size kTurningCubeSize{640, 360};
constexpr int kFrames = 3600, kQuickFrames = 120, kCubeFramesPerSecond = 60;
constexpr int kFramesPerTask = 20;

lab::CoverageScene cube_at(int frame) {
  const SceneRequest request{kTurningCubeSize.width, kTurningCubeSize.height,
                             static_cast<float>(frame) / static_cast<float>(kCubeFramesPerSecond)};
  return lab::coverage_scene(find_scene("cube").make(request),
                             {kTurningCubeSize.width, kTurningCubeSize.height, Cull::back, false});
}

// The median of an even number of frames is the upper of the middle two.
PerFrame per_frame(std::vector<std::uint64_t> counts) {
  PerFrame result;
  for (const std::uint64_t n : counts) result.total += n;
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
  std::nth_element(counts.begin(), middle, counts.end());
  result.median = *middle;
  result.worst = *std::max_element(counts.begin(), counts.end());
  return result;
}

using Scores = std::vector<CoverageScores>;  // one per frame

CubeCounts summary(const Scores& scores, lab::CoverageScore CoverageScores::*truth) {
  const auto of = [&](std::uint64_t lab::CoverageScore::*count) {
    std::vector<std::uint64_t> counts;
    for (const CoverageScores& score : scores) counts.push_back(score.*truth.*count);
    return per_frame(std::move(counts));
  };
  return {of(&lab::CoverageScore::gaps), of(&lab::CoverageScore::double_hits),
          of(&lab::CoverageScore::missing), of(&lab::CoverageScore::extra)};
}

// The frame with the most gaps and double hits.
Closeup worst_frame(const lab::CoverageMethod& method, const Scores& scores) {
  const auto worst = std::max_element(scores.begin(), scores.end(), [](const auto& a, const auto& b) {
    return a.floats.gaps + a.floats.double_hits < b.floats.gaps + b.floats.double_hits;
  });
  const lab::CoverageScene scene = cube_at(static_cast<int>(worst - scores.begin()));
  const auto truth = lab::float_coverage(scene.input(), scene.window(), 1);
  std::vector<lab::Run> runs;
  method.runs(scene.input(), scene.window(), runs);
  return closeup(closeup_name(Family::coverage, kTurningCube, method.info.name),
                 mark_coverage(truth, std::move(runs), scene.floats, lab::gap_reach_px(method)));
}

}  // namespace

CubeResult judge_turning_cube(const AccuracyPlan& plan, const ChosenMethods& methods,
                              const std::function<void(double)>& progress, std::vector<Closeup>& closeups) {
  std::vector<const lab::CoverageMethod*> judged = methods.coverage;
  std::erase_if(judged, [](const auto* method) { return method->engine; });
  const int frames = plan.quick ? kQuickFrames : kFrames;
  std::vector<Scores> scores(judged.size(), Scores(static_cast<std::size_t>(frames)));
  std::mutex mutex;
  int done = 0;
  parallel_for(plan.threads, frames / kFramesPerTask, [&](int task) {
    for (int frame = task * kFramesPerTask; frame < (task + 1) * kFramesPerTask; ++frame) {
      const lab::CoverageScene scene = cube_at(frame);
      const auto snapped = lab::snapped_coverage(scene.input(), scene.window(), 1),
                 floats = lab::float_coverage(scene.input(), scene.window(), 1);
      for (std::size_t i = 0; i < judged.size(); ++i) {
        const lab::CoverageMethod& method = *judged[i];
        std::vector<lab::Run> runs;
        method.runs(scene.input(), scene.window(), runs);
        scores[i][static_cast<std::size_t>(frame)] = {
            lab::score_coverage(snapped, runs, scene.floats, lab::gap_reach_px(method)),
            lab::score_coverage(floats, std::move(runs), scene.floats, lab::gap_reach_px(method)),
            {}};
      }
    }
    const std::lock_guard lock(mutex);
    progress(static_cast<double>(done += kFramesPerTask) / frames);
  });

  const std::size_t first_closeup = closeups.size();
  CubeResult result{frames, kTurningCubeSize.width, kTurningCubeSize.height, {}};
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const lab::CoverageMethod& method = *judged[i];
    result.methods.push_back({std::string(method.info.name), method.info.exact,
                              summary(scores[i], &CoverageScores::snapped),
                              summary(scores[i], &CoverageScores::floats)});
    const CubeCounts& counts = result.methods.back().floats;
    if (plan.pictures && counts.gaps.total + counts.double_hits.total != 0)
      add_unless_known(worst_frame(method, scores[i]), closeups, first_closeup);
  }
  return result;
}

}  // namespace edgewise::tools
