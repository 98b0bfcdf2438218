#include "bench/workloads/laboratory.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "core/input_file.h"
#include "edgewise/builtin.h"
#include "edgewise/contract.h"
#include "lab/needs/pipeline.h"
#include "support/options.h"

namespace edgewise::bench {

namespace {

constexpr Execution kPlainest{.threads = 1, .target = SimdTarget::scalar};

std::vector<Execution> forms_of(const lab::CoverageMethod& method) {
  const SimdTarget best = resolve(SimdTarget::best);
  std::vector<SimdTarget> targets{SimdTarget::scalar};
  if (method.simd && best != SimdTarget::scalar) targets.push_back(best);
  std::vector<Execution> list;
  for (const SimdTarget target : targets)
    for (int threads = 1; threads <= (method.threaded ? 2 : 1); ++threads)
      list.push_back({.threads = threads, .target = target});
  return list;
}

// A scene of the chart, and what its rows share after the first is prepared.
struct ChoiceFrame {
  lab::ChoiceScene scene;
  std::optional<Drawable> drawable = {};
  std::optional<lab::FrameDrawer> drawer = {};
};

// A scene, its least precise pipelines, and what their rows share.
struct PipelineScene {
  std::string name;
  SceneRequest request;
  std::vector<lab::Pipeline> minima;
  std::uint64_t tolerance_px;  // wrong pixels that each of them may draw
  // After a row is prepared:
  std::optional<lab::PipelineFrame> frame = {};
  std::vector<std::uint32_t> right = {};
  lab::PipelineMemory memory = {};
};

PipelineScene pipeline_scene(const nlohmann::json& entry) {
  PipelineScene scene{
      entry.at("scene").get<std::string>(),
      {entry.at("width").get<int>(), entry.at("height").get<int>(), 0.0f, entry.at("scale").get<double>()},
      {},
      entry.at("tolerance_px").get<std::uint64_t>()};
  find_scene(scene.name);
  const auto in_range = [](int side) { return side >= 1 && side <= contract::kMaxImageSide; };
  if (!in_range(scene.request.width) || !in_range(scene.request.height) ||
      !(scene.request.scale > 0.0 && scene.request.scale <= tools::kLargestScale))
    throw std::invalid_argument("'" + scene.name + "' has a size or scale that is out of range");
  for (const auto& levels : entry.at("minima"))
    scene.minima.push_back(lab::pipeline_of(levels.get<lab::Levels>()));
  return scene;
}

std::vector<std::shared_ptr<PipelineScene>> read_pipelines(const std::string& file) {
  InputFile input = open_input(file);
  std::vector<std::shared_ptr<PipelineScene>> scenes;
  std::set<std::string> names;
  try {
    for (const auto& entry : nlohmann::json::parse(*input.stream)) {
      scenes.push_back(std::make_shared<PipelineScene>(pipeline_scene(entry)));
      const std::string& name = scenes.back()->name;
      if (!names.insert(name).second) throw std::invalid_argument("two entries for '" + name + "'");
    }
  } catch (const nlohmann::json::exception& error) {
    throw FileError(file, fmt::format("not a list of what `edgewise needs --json` prints: {}", error.what()));
  } catch (const std::invalid_argument& error) {
    throw FileError(file, error.what());
  }
  return scenes;
}

TimedDraw prepare(PipelineScene& at, const lab::Pipeline& pipeline, Row& row) {
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
    row.error = fmt::format("{} pixels differ from the exact picture", wrong);
  return [&at, pipeline] { at.frame->draw(pipeline, at.memory); };
}

}  // namespace

Row method_row(const std::shared_ptr<MethodScene>& scene, const lab::CoverageMethod& method,
               const Execution& how) {
  Row row;
  row.name = fmt::format("lab/{}/family:coverage/method:{}/simd:{}/threads:{}", scene->info.name,
                         method.info.name, name_of(how.target), how.threads);
  row.execution = how;
  row.prepare = [scene, &method, how](Row& prepared) -> TimedDraw {
    MethodScene& at = *scene;
    if (!at.scene) {
      at.scene = std::get<lab::CoverageScene>(at.info.make());
      at.canvas.emplace(at.scene->size.width, at.scene->size.height);
    }
    const lab::CoverageInput input = at.scene->input();
    prepared.triangles = input.floats.size();
    if (how.threads != kPlainest.threads || how.target != kPlainest.target) {
      const auto [width, height] = at.scene->size;
      lab::Canvas plain(width, height), other(width, height);
      method.draw(input, plain, kPlainest);
      method.draw(input, other, how);
      if (!lab::same_picture(method, plain, other))
        prepared.error = "draws other pixels than its scalar form on one thread";
    }
    return [&at, &method, input, how] { method.draw(input, *at.canvas, how); };
  };
  return row;
}

std::vector<Row> method_rows(const lab::LabScene& info) {
  const auto scene = std::make_shared<MethodScene>(MethodScene{info});
  std::vector<Row> rows;
  for (const lab::CoverageMethod& method : lab::coverage_methods())
    for (const Execution& form : forms_of(method)) rows.push_back(method_row(scene, method, form));
  return rows;
}

std::string choice_name(const lab::ChoiceScene& scene, std::string_view method) {
  return fmt::format("choice/{}/method:{}/threads:1", scene.name, method);
}

std::vector<Row> choice_rows(const lab::ChoiceScene& scene) {
  const auto frame = std::make_shared<ChoiceFrame>(ChoiceFrame{scene});
  std::vector<const lab::CoverageMethod*> methods;
  for (const auto& method : lab::coverage_methods()) methods.push_back(&method);
  std::vector<Row> rows;
  for (const lab::ChoiceMethod& method : lab::choice_methods(methods)) {
    Row& row = rows.emplace_back();
    row.name = choice_name(scene, method.name);
    row.prepare = [frame, method](Row& prepared) -> TimedDraw {
      ChoiceFrame& at = *frame;
      if (!at.drawable) {
        at.drawable = at.scene.make(0);
        at.drawer.emplace(at.scene.size);
      }
      lab::FrameDrawer scalar(at.scene.size);
      scalar.draw(*at.drawable, method, Payload::colour, {.target = SimdTarget::scalar});
      at.drawer->draw(*at.drawable, method, Payload::colour);
      at.drawer->redraw(*at.drawable, method, Payload::colour);
      if (!lab::same_picture(*method.method, scalar.canvas(), at.drawer->canvas()))
        prepared.error = "draws other pixels than its scalar form";
      return [&at, method] { at.drawer->redraw(*at.drawable, method, Payload::colour); };
    };
  }
  return rows;
}

std::vector<Row> pipeline_rows(const std::string& file) {
  std::vector<Row> rows;
  for (const auto& scene : read_pipelines(file)) {
    const auto add = [&](const std::string& name, const lab::Pipeline& pipeline) {
      Row& row = rows.emplace_back();
      row.name = fmt::format("needs/{}/pipeline:{}/threads:1", scene->name, name);
      row.execution = {.threads = 1, .target = SimdTarget::scalar};
      row.prepare = [scene, pipeline](Row& prepared) { return prepare(*scene, pipeline, prepared); };
    };
    for (std::size_t i = 0; i < scene->minima.size(); ++i) add(std::to_string(i + 1), scene->minima[i]);
    if (!scene->minima.empty()) add("exact", lab::exact_pipeline());
  }
  return rows;
}

}  // namespace edgewise::bench
