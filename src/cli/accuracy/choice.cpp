// The chart for choosing a method: counts the wrong pixels and holes of its frames.
#include <algorithm>
#include <mutex>

#include "cli/accuracy/score.h"
#include "core/parallel.h"
#include "lab/choice/choice.h"

namespace edgewise::tools {

namespace {

void add(ChoiceTotal& total, const lab::ChoiceCounts& counts) {
  total.least = std::min(total.least, counts.wrong);
  total.most = std::max(total.most, counts.wrong);
  total.wrong += counts.wrong;
  total.holes += counts.holes;
}

}  // namespace

std::vector<ChoiceResult> judge_choices(const AccuracyPlan& plan, const ChosenMethods& chosen) {
  const auto methods = lab::choice_methods(chosen.coverage);
  const auto scenes = lab::choice_scenes(plan.quick);
  const bool one_thread = std::ranges::any_of(methods, [](const auto& m) { return m.method->one_thread; });
  std::vector<ChoiceResult> results;
  for (const lab::ChoiceScene& scene : scenes) {
    ChoiceResult& result =
        results.emplace_back(ChoiceResult{scene.name, scene.summary, scene.size, scene.frames});
    for (const auto& method : methods) result.methods.emplace_back(method.name, ChoiceTotal());
    std::mutex mutex;
    parallel_for(one_thread ? 1 : plan.threads, scene.frames, [&](int frame) {
      const Drawable drawable = scene.make(frame);
      const lab::ChoiceJudge judge(drawable, scene.size, 1);
      lab::FrameDrawer drawer(scene.size);
      std::vector<lab::ChoiceCounts> counts;
      for (const auto& method : methods) {
        drawer.draw(drawable, method, Payload::id);
        counts.push_back(judge.count(drawer.canvas().frame));
      }
      const auto projection = judge.of_float_projection(1);
      const std::lock_guard lock(mutex);
      for (std::size_t i = 0; i < methods.size(); ++i) add(result.methods[i].second, counts[i]);
      if (projection) {
        if (!result.float_projection) result.float_projection.emplace();
        add(*result.float_projection, *projection);
      }
    });
  }
  return results;
}

}  // namespace edgewise::tools
