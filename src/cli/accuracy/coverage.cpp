// Coverage: compares every method's pixels of every triangle with both references.
#include <algorithm>
#include <stdexcept>

#include "cli/accuracy/score.h"
#include "cli/accuracy/speed.h"
#include "core/parallel.h"

namespace edgewise::tools {

namespace {

constexpr Execution kPlainest{.threads = 1, .target = SimdTarget::scalar};

// The two forms of a method, scalar and with the widest SIMD of this machine, on one thread and on two. Of
// the engine, SIMD on one thread.
std::vector<Execution> executions_of(const lab::CoverageMethod& method) {
  const SimdTarget best = resolve(SimdTarget::best);
  if (method.engine) return {{.threads = 1, .target = best}};
  std::vector<SimdTarget> targets{SimdTarget::scalar};
  if (method.simd && best != SimdTarget::scalar) targets.push_back(best);
  std::vector<Execution> list;
  for (const SimdTarget target : targets)
    for (int threads = 1; threads <= (method.threaded ? 2 : 1); ++threads)
      list.push_back({.threads = threads, .target = target});
  return list;
}

// Throws std::runtime_error unless a method draws the picture of its plainest execution; otherwise the times
// would compare different work.
void check_same_picture(const lab::CoverageScene& scene, const lab::CoverageMethod& method,
                        const Execution& execution) {
  lab::Canvas plain(scene.size.width, scene.size.height), other(scene.size.width, scene.size.height);
  method.draw(scene.input(), plain, kPlainest);
  method.draw(scene.input(), other, execution);
  if (!lab::same_picture(method, plain, other))
    throw std::runtime_error(std::string(method.info.name) + " (" + std::string(name_of(execution.target)) +
                             ", " + std::to_string(execution.threads) +
                             " threads) draws other pixels than its scalar form on one thread");
}

void time_methods(const lab::CoverageScene& scene, const Bench& bench, SceneResult& result) {
  lab::Canvas canvas(scene.size.width, scene.size.height);
  const auto input = scene.input();
  std::vector<TimedDraw> draws;
  for (std::size_t i = 0; i < bench.methods.coverage.size(); ++i) {
    const lab::CoverageMethod& method = *bench.methods.coverage[i];
    const std::vector<Execution> executions = executions_of(method);
    for (const Execution& execution : executions) {
      if (&execution != &executions.front()) check_same_picture(scene, method, execution);
      draws.push_back(
          {i, execution.threads, execution.target,
           method.load ? method.load(input, scene.window(), execution)
                       : [&method, &input, &canvas, execution] { method.draw(input, canvas, execution); }});
    }
  }
  const auto speeds = time_interleaved(draws, bench.plan.quick);
  for (std::size_t i = 0; i < draws.size(); ++i) result.methods[draws[i].method].speed.push_back(speeds[i]);
}

}  // namespace

void judge(const lab::CoverageScene& scene, const Bench& bench, SceneResult& result) {
  const auto& methods = bench.methods.coverage;
  const auto input = scene.input();
  const auto snapped = lab::snapped_coverage(input, scene.window(), bench.plan.threads),
             floats = lab::float_coverage(input, scene.window(), bench.plan.threads);
  result.width = scene.size.width;
  result.height = scene.size.height;
  result.triangles = scene.floats.size();
  result.covered = snapped.covered;
  result.crossings = lab::edge_crossings(scene.floats, scene.window());
  result.shared_crossings = lab::shared_edge_crossings(scene.floats, scene.window());
  result.largest_side_px = lab::largest_side_px(scene.floats);

  result.methods.resize(methods.size());
  std::vector<Closeup> closeups(methods.size());
  std::mutex mutex;
  std::size_t done = 0;
  const lab::VisibleTriangleJudge visible(input, scene.size, bench.plan.threads);
  const auto judge_one = [&](std::size_t i) {
    const lab::CoverageMethod& method = *methods[i];
    std::vector<lab::Run> runs;
    method.runs(input, scene.window(), runs);
    CoverageScores scores{lab::score_coverage(snapped, runs, scene.floats, lab::gap_reach_px(method)),
                          lab::score_coverage(floats, runs, scene.floats, lab::gap_reach_px(method)),
                          visible.score(method)};
    result.methods[i] = {std::string(method.info.name), method.info.exact, scores, {}};
    if (bench.plan.pictures && bench.scene.smallest && scores.floats.errors() != 0)
      closeups[i] = closeup(closeup_name(Family::coverage, bench.scene.name, method.info.name),
                            mark_coverage(floats, std::move(runs), scene.floats, lab::gap_reach_px(method)));
    const std::lock_guard lock(mutex);
    bench.progress(static_cast<double>(++done) / static_cast<double>(methods.size() + 1));
  };
  parallel_for(bench.plan.threads, static_cast<int>(methods.size()), [&](int n) {
    if (const auto i = static_cast<std::size_t>(n); !methods[i]->load) judge_one(i);
  });
  for (std::size_t i = 0; i < methods.size(); ++i)
    if (methods[i]->load) judge_one(i);
  const std::size_t first = bench.closeups.size();
  for (Closeup& c : closeups)
    if (!c.name.empty()) add_unless_known(std::move(c), bench.closeups, first);
  if (bench.scene.timed) time_methods(scene, bench, result);
}

}  // namespace edgewise::tools
