// Counts cracks and wrong pixels in each frame of the tutorials' rotating cube.
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

template <typename Part, typename Counts>
PerFrame summary(const Scores& scores, Part CoverageScores::*part, std::uint64_t Counts::*count) {
  std::vector<std::uint64_t> counts;
  for (const CoverageScores& score : scores) counts.push_back(score.*part.*count);
  return per_frame(std::move(counts));
}
CubeCounts wrong(const Scores& scores, lab::CoverageScore CoverageScores::*truth) {
  return {summary(scores, truth, &lab::CoverageScore::missing),
          summary(scores, truth, &lab::CoverageScore::extra)};
}

// The frame with the most cracks.
Closeup worst_frame(const lab::CoverageMethod& method, const Scores& scores) {
  const auto worst = std::max_element(scores.begin(), scores.end(), [](const auto& a, const auto& b) {
    return a.cracks.gaps + a.cracks.double_hits < b.cracks.gaps + b.cracks.double_hits;
  });
  const lab::CoverageScene scene = cube_at(static_cast<int>(worst - scores.begin()));
  const auto truth = lab::float_coverage(scene.input(), scene.window(), 1);
  const lab::DrawnRuns drawn(method, scene.input(), scene.window());
  const lab::Cracks cracks = lab::CrackJudge(scene.floats, truth).find(drawn, method.promise.snap_bits);
  return closeup(closeup_name(Family::coverage, kTurningCube, method.info.name),
                 mark_coverage(truth, drawn, cracks, scene.floats));
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
      const lab::CrackJudge cracks(scene.floats, floats);
      for (std::size_t i = 0; i < judged.size(); ++i) {
        const lab::DrawnRuns drawn(*judged[i], scene.input(), scene.window());
        scores[i][static_cast<std::size_t>(frame)] = {
            lab::score_coverage(snapped, drawn, scene.floats),
            lab::score_coverage(floats, drawn, scene.floats),
            CrackCounts(cracks.find(drawn, judged[i]->promise.snap_bits)),
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
                              wrong(scores[i], &CoverageScores::snapped),
                              wrong(scores[i], &CoverageScores::floats),
                              summary(scores[i], &CoverageScores::cracks, &CrackCounts::gaps),
                              summary(scores[i], &CoverageScores::cracks, &CrackCounts::double_hits)});
    const CubeMethodResult& counts = result.methods.back();
    if (plan.pictures && counts.gaps.total + counts.double_hits.total != 0)
      add_unless_known(worst_frame(method, scores[i]), closeups, first_closeup);
  }
  return result;
}

}  // namespace edgewise::tools
