// Counts the superfluous changes of pixels while a scene turns or the camera pans.
#include "cli/accuracy/score.h"
#include "core/parallel.h"
#include "edgewise/builtin.h"
#include "lab/coverage/changes.h"

namespace edgewise::tools {

namespace {

constexpr lab::Size kMotionSize{640, 360};
constexpr int kMotionFrames = 24, kQuickMotionFrames = 6, kMotionFramesPerSecond = 60;
constexpr std::string_view kMovingScenes[] = {"torus-knot", "terrain"};

// Payloads are ids of source triangles, from 1.
lab::CoverageScene scene_at(std::string_view name, int frame) {
  const SceneRequest request{kMotionSize.width, kMotionSize.height,
                             static_cast<float>(frame) / static_cast<float>(kMotionFramesPerSecond)};
  lab::CoverageScene scene =
      lab::coverage_scene(find_scene(name).make(request),
                          {.width = kMotionSize.width, .height = kMotionSize.height, .payload = Payload::id});
  for (std::size_t i = 0; i < scene.floats.size(); ++i) ++scene.floats[i].payload, ++scene.snapped[i].payload;
  return scene;
}

std::vector<std::uint32_t> picture_of(const Framebuffer& frame) {
  std::vector<std::uint32_t> picture;
  for (int y = 0; y < frame.height(); ++y)
    picture.insert(picture.end(), frame.payload_row(y), frame.payload_row(y) + frame.width());
  return picture;
}

}  // namespace

std::vector<MotionResult> judge_motions(const AccuracyPlan& plan, const ChosenMethods& methods,
                                        const std::function<void(double)>& progress) {
  std::vector<const lab::CoverageMethod*> judged = methods.coverage;
  std::erase_if(judged, [](const auto* method) { return method->engine; });
  const int frames = plan.quick ? kQuickMotionFrames : kMotionFrames;
  std::vector<MotionResult> results;
  for (const std::string_view name : kMovingScenes) {
    lab::Changes truth;
    std::vector<lab::Changes> changes(judged.size());
    std::vector<std::unique_ptr<lab::Canvas>> canvases;
    for (std::size_t i = 0; i < judged.size(); ++i)
      canvases.push_back(std::make_unique<lab::Canvas>(kMotionSize.width, kMotionSize.height));
    for (int frame = 0; frame < frames; ++frame) {
      const lab::CoverageScene scene = scene_at(name, frame);
      auto visible =
          lab::exact_visible_triangles(std::span(scene.floats), scene.window(), plan.threads).triangle;
      for (std::uint32_t& id : visible) id = id == lab::kNoTriangle ? 0 : scene.floats[id].payload;
      truth.add(std::move(visible));
      parallel_for(plan.threads, static_cast<int>(judged.size()), [&](int n) {
        const auto i = static_cast<std::size_t>(n);
        judged[i]->draw(scene.input(), *canvases[i], {});
        changes[i].add(picture_of(canvases[i]->frame));
      });
      progress((static_cast<double>(results.size()) + static_cast<double>(frame + 1) / frames) /
               static_cast<double>(std::size(kMovingScenes)));
    }
    MotionResult& result = results.emplace_back(
        MotionResult{std::string(name), frames, kMotionSize.width, kMotionSize.height, truth.sum(), {}});
    for (std::size_t i = 0; i < judged.size(); ++i)
      result.superfluous.emplace_back(judged[i]->info.name, changes[i].beyond(truth));
  }
  return results;
}

}  // namespace edgewise::tools
