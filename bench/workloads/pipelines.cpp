#include "bench/workloads/pipelines.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "core/input_file.h"
#include "edgewise/contract.h"
#include "support/options.h"

namespace edgewise::bench {

std::vector<std::shared_ptr<PipelineScene>> read_pipelines(const std::string& file) {
  InputFile input = open_input(file);
  std::vector<std::shared_ptr<PipelineScene>> scenes;
  std::set<std::string> names;
  try {
    for (const auto& entry : nlohmann::json::parse(*input.stream)) {
      const SceneRequest request{entry.at("width").get<int>(), entry.at("height").get<int>(), 0.0f,
                                 entry.at("scale").get<double>()};
      const auto name = entry.at("scene").get<std::string>();
      find_scene(name);
      const auto in_range = [](int side) { return side >= 1 && side <= contract::kMaxImageSide; };
      if (!in_range(request.width) || !in_range(request.height) ||
          !(request.scale > 0.0 && request.scale <= tools::kLargestScale))
        throw std::invalid_argument("'" + name + "' has a size or scale that is out of range");
      if (!names.insert(name).second) throw std::invalid_argument("two entries for '" + name + "'");
      scenes.push_back(std::make_shared<PipelineScene>());
      scenes.back()->name = name, scenes.back()->request = request;
      scenes.back()->tolerance_px = entry.at("tolerance_px").get<std::uint64_t>();
      for (const auto& levels : entry.at("minima"))
        scenes.back()->minima.push_back(lab::pipeline_of(levels.get<lab::Levels>()));
    }
  } catch (const nlohmann::json::exception& error) {
    throw FileError(file, fmt::format("not a list of what `edgewise needs --json` prints: {}", error.what()));
  } catch (const std::invalid_argument& error) {
    throw FileError(file, error.what());
  }
  return scenes;
}

std::function<void()> PipelineDraw::prepare(std::string& error) const {
  PipelineScene& at = *scene;
  if (!at.frame) {
    const SceneInfo& info = find_scene(at.name);
    const Drawable drawable = info.make(at.request);
    const FrontendOptions options{.width = at.request.width,
                                  .height = at.request.height,
                                  .cull = info.stream ? Cull::none : Cull::back,
                                  .payload = Payload::id};
    at.frame.emplace(drawable, options);
    at.right = lab::right_picture(lab::coverage_scene(drawable, options), 1);
  }
  at.frame->draw(pipeline, at.memory);
  const auto drawn = at.memory.picture();
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) wrong += drawn[i] != at.right[i] ? 1u : 0u;
  if (wrong > at.tolerance_px && pipeline != lab::exact_pipeline())
    error = fmt::format("{} pixels differ from the exact picture", wrong);
  return [&at, pipeline = pipeline] { at.frame->draw(pipeline, at.memory); };
}

}  // namespace edgewise::bench
