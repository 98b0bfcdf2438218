// Moving pictures: counts cracks and wrong pixels in each frame of the tutorials' rotating cube, and the
// superfluous changes of pixels while a scene turns or the camera pans. And the chart for choosing a method:
// counts the wrong pixels and holes of its frames.
#include <algorithm>
#include <mutex>

#include "cli/accuracy/score.h"
#include "core/parallel.h"
#include "edgewise/builtin.h"
#include "lab/cases/backend_comparison.h"
#include "lab/choice/choice.h"
#include "lab/coverage/pixel_changes.h"
#include "lab/projection/truth.h"

namespace edgewise::tools {

namespace {

constexpr lab::Size kSize{640, 360};
constexpr int kFramesPerSecond = 60;
constexpr int kCubeFrames = 3600, kQuickCubeFrames = 120, kCubeFramesPerTask = 20;
constexpr int kMotionFrames = 24, kQuickMotionFrames = 6;
constexpr std::string_view kMovingScenes[] = {"torus-knot", "terrain"};

lab::CoverageScene scene_at(std::string_view name, int frame, int subpixel_bits) {
  const float seconds = static_cast<float>(frame) / static_cast<float>(kFramesPerSecond);
  return lab::coverage_scene(find_scene(name).make({kSize.width, kSize.height, seconds}),
                             {.width = kSize.width, .height = kSize.height, .subpixel_bits = subpixel_bits});
}

using Scores = std::vector<CoverageScores>;  // one per frame

CubeMethodResult summed(const lab::CoverageMethod& method, const Scores& scores, int subpixel_bits) {
  CubeMethodResult sum{std::string(method.info.name), is_exact(method, subpixel_bits)};
  for (const CoverageScores& score : scores) {
    sum.gaps += score.cracks.gaps, sum.double_hits += score.cracks.double_hits;
    sum.missing += score.source.missing, sum.extra += score.source.extra;
    sum.wrong_snapped += score.snapped.errors();
  }
  return sum;
}

// The frame with the most cracks.
Closeup worst_frame(const lab::CoverageMethod& method, const Scores& scores, int subpixel_bits) {
  const auto worst = std::max_element(scores.begin(), scores.end(), [](const auto& a, const auto& b) {
    return a.cracks.gaps + a.cracks.double_hits < b.cracks.gaps + b.cracks.double_hits;
  });
  const lab::CoverageScene scene = scene_at("cube", static_cast<int>(worst - scores.begin()), subpixel_bits);
  const lab::SourceJudge source(scene, 1);
  const lab::DrawnRuns drawn(method, scene.input(), scene.window());
  const lab::Cracks cracks =
      lab::CrackJudge(scene.floats, source.floats()).find(drawn, scene.snap_bits(method));
  return closeup(closeup_name(Family::coverage, kTurningCube, method.info.name),
                 mark_coverage(source.truth(), source.of_sources(drawn), cracks, source.source()));
}

void add(ChoiceTotal& total, const lab::ChoiceCounts& counts) {
  total.least = std::min(total.least, counts.wrong);
  total.most = std::max(total.most, counts.wrong);
  total.wrong += counts.wrong;
  total.holes += counts.holes;
}

}  // namespace

CubeResult judge_turning_cube(const AccuracyPlan& plan, const ChosenMethods& methods,
                              std::vector<Closeup>& closeups) {
  const auto& judged = methods.coverage;
  const int frames = plan.quick ? kQuickCubeFrames : kCubeFrames;
  std::vector<Scores> scores(judged.size(), Scores(static_cast<std::size_t>(frames)));
  parallel_for(plan.threads, frames / kCubeFramesPerTask, [&](int task) {
    for (int frame = task * kCubeFramesPerTask; frame < (task + 1) * kCubeFramesPerTask; ++frame) {
      const lab::CoverageScene scene = scene_at("cube", frame, plan.subpixel_bits);
      const auto snapped = lab::snapped_coverage(scene.input(), scene.window(), 1);
      const lab::SourceJudge source(scene, 1);
      const lab::CrackJudge cracks(scene.floats, source.floats());
      for (std::size_t i = 0; i < judged.size(); ++i) {
        const lab::DrawnRuns drawn(*judged[i], scene.input(), scene.window());
        scores[i][static_cast<std::size_t>(frame)] = {
            lab::score_coverage(snapped, drawn, scene.floats),
            source.score(drawn),
            CrackCounts(cracks.find(drawn, scene.snap_bits(*judged[i]))),
            {}};
      }
    }
  });

  const std::size_t first_closeup = closeups.size();
  CubeResult result{frames, kSize.width, kSize.height, {}};
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const lab::CoverageMethod& method = *judged[i];
    const CubeMethodResult& counts =
        result.methods.emplace_back(summed(method, scores[i], plan.subpixel_bits));
    if (plan.pictures && counts.gaps + counts.double_hits != 0)
      add_unless_known(worst_frame(method, scores[i], plan.subpixel_bits), closeups, first_closeup);
  }
  return result;
}

std::vector<MotionResult> judge_motions(const AccuracyPlan& plan, const ChosenMethods& methods) {
  const auto& judged = methods.coverage;
  const int frames = plan.quick ? kQuickMotionFrames : kMotionFrames;
  std::vector<MotionResult> results;
  for (const std::string_view name : kMovingScenes) {
    lab::PixelChanges truth;
    std::vector<lab::PixelChanges> changes(judged.size());
    std::vector<std::unique_ptr<lab::Canvas>> canvases;
    for (std::size_t i = 0; i < judged.size(); ++i)
      canvases.push_back(std::make_unique<lab::Canvas>(kSize.width, kSize.height));
    for (int frame = 0; frame < frames; ++frame) {
      lab::CoverageScene scene = scene_at(name, frame, plan.subpixel_bits);
      for (std::size_t i = 0; i < scene.floats.size(); ++i)  // ids from 1; 0 is the background
        ++scene.floats[i].payload, ++scene.snapped[i].payload;
      auto visible = scene.truth->visible_triangles(scene.window(), plan.threads).triangle;
      for (std::uint32_t& id : visible) ++id;  // kNoTriangle becomes 0
      truth.add(std::move(visible));
      parallel_for(plan.threads, static_cast<int>(judged.size()), [&](int n) {
        const auto i = static_cast<std::size_t>(n);
        judged[i]->draw(scene.input(), *canvases[i], {});
        changes[i].add(lab::payloads_of(canvases[i]->frame));
      });
    }
    MotionResult& result = results.emplace_back(MotionResult{std::string(name), frames, truth.sum(), {}});
    for (std::size_t i = 0; i < judged.size(); ++i)
      result.superfluous.emplace_back(judged[i]->info.name, changes[i].beyond(truth));
  }
  return results;
}

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
