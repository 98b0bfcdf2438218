// The judge: does every backend, in every configuration, write the bits that the reference writes, and does
// the reference write those of the oracle? Those that don't fill have a reference of their own, the first of
// them, and an oracle.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edgewise/frontend.h"
#include "raster/ablation.h"
#include "support/options.h"

namespace edgewise::app {

struct VerifyPlan {
  std::vector<std::string> scenes;    // names or paths
  std::vector<BackendInfo> backends;  // the first of those that fill is their reference, and so of others
  std::vector<int> threads{1, 2, 3};
  std::optional<Size> size;  // none: one that nothing divides; for .tri files their own
  bool full = false;         // 1920×1080, and built-in streams with all their triangles
  bool fit = false;          // see load_source
  std::filesystem::path
      failure_folder;  // for pictures of differences; made when needed; empty: none are written
  std::function<void(double, std::string_view)> on_progress;  // fraction done, scene
};

struct PixelValue {
  std::string drawn_by;
  std::uint32_t depth, payload;
};

// A configuration that differs from what it is judged by.
struct Mismatch {
  Cull cull;
  Payload payload;
  int width, height;
  std::string judge;  // the reference's name, or "oracle"
  std::string backend;
  AblatedExecution how;
  std::uint64_t pixels;   // that differ
  std::uint64_t outside;  // words written beside the image
  int x, y;               // the first pixel that differs; -1 if none does
  std::vector<PixelValue>
      values;  // there: the judge's, this configuration's, then each backend's on one thread
  std::vector<std::string> files;
  std::string file_error;  // why `files` is not whole
};

struct HitCount {
  std::string backend;
  std::uint64_t not_once;  // pixels that were not drawn exactly once
};

struct SceneVerdict {
  std::string scene;
  int width, height;
  std::uint64_t triangles = 0;         // submitted, in one culling mode
  std::uint64_t emitted = 0;           // by the front end, over all culling modes
  std::uint64_t configurations = 0;    // compared with the reference
  std::uint64_t differing_pixels = 0;  // over all of them
  std::uint64_t written_outside = 0;   // words beside the image, over all frames
  int oracle_width = 0, oracle_height = 0;
  std::uint64_t oracle_configurations = 0, oracle_differences = 0;
  std::vector<HitCount> hits;        // built-in grids only
  std::vector<Mismatch> mismatches;  // the first of each backend and judge
  double seconds = 0;

  bool ok() const;
};

// One scene of the plan; `progress` is called with the fraction done. Throws what load_source throws.
SceneVerdict verify_scene(const VerifyPlan& plan, const std::string& name,
                          const std::function<void(double)>& progress);

struct VerifyReport {
  std::vector<SceneVerdict> scenes;
  bool ok() const;
};

// All scenes of the plan, in order; `on_scene` is called after each.
VerifyReport verify(const VerifyPlan& plan, const std::function<void(const SceneVerdict&)>& on_scene);

}  // namespace edgewise::app
