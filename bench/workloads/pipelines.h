// The least precise pipelines of a scene beside the exact one, as rows.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgewise/builtin.h"
#include "lab/needs/pipeline.h"

namespace edgewise::bench {

// A scene, its least precise pipelines, and what their rows share.
struct PipelineScene {
  std::string name;
  SceneRequest request;
  std::vector<lab::Pipeline> minima;
  std::uint64_t tolerance_px = 0;  // wrong pixels that each of them may draw
  // After a row is prepared:
  std::optional<lab::PipelineFrame> frame;
  std::vector<std::uint32_t> right;
  lab::PipelineMemory memory;
};

// Of a file with a list of what `edgewise needs --json` prints about built-in scenes. Throws FileError.
std::vector<std::shared_ptr<PipelineScene>> read_pipelines(const std::string& file);

struct PipelineDraw {
  std::shared_ptr<PipelineScene> scene;
  lab::Pipeline pipeline;

  // Returns the timed draw. `error` says that it draws more wrong pixels than are tolerated.
  std::function<void()> prepare(std::string& error) const;
};

}  // namespace edgewise::bench
