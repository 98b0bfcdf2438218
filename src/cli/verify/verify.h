// Checks that every backend writes the same bits as the reference in every configuration, and the same bits
// as the oracle in one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edgewise/frontend.h"
#include "lab/cases/backend_comparison.h"
#include "support/options.h"

namespace edgewise::tools {

struct VerifyPlan {
  std::vector<std::string> scenes;    // names or paths
  std::vector<BackendInfo> backends;  // the first is the reference
  std::vector<int> threads{1, 2, 3};
  std::optional<Size> size;  // none: prime sides, or the size of a .tri file
  bool full = false;         // 1920×1080, and built-in streams with all their triangles
  bool fit = false;          // see load_source
  int subpixel_bits = FrontendOptions().subpixel_bits;
  std::filesystem::path
      failure_folder;  // for pictures of differences; created when needed; empty: no pictures
  std::function<void(double, std::string_view)> on_progress;  // fraction done, scene
};

struct PixelValue {
  std::string drawn_by;
  std::uint32_t depth, payload;
};

// How a frame is drawn. A whole frame is drawn by draw(drawable, …), which includes the front end.
struct Configuration {
  lab::DrawOptions how;
  bool whole_frame = false;
};

// A configuration whose frame differs from the expected one.
struct Mismatch {
  FrontendOptions frontend;
  std::string judge;  // the reference's name, or "oracle"
  std::string backend;
  Configuration drawn;
  lab::FrameDifference found;
  // At the first pixel that differs: the judge's, this configuration's, then each backend's on one thread.
  std::vector<PixelValue> values = {};
  std::vector<std::string> files = {};
  std::string file_error = {};  // why `files` is incomplete
};

struct HitCount {
  std::string backend;
  std::uint64_t not_once;  // pixels that were not drawn exactly once
};

struct SceneVerdict {
  std::string scene;
  int width, height;
  std::uint64_t triangles = 0;         // submitted, in one culling mode
  std::uint64_t configurations = 0;    // compared with the reference
  std::uint64_t differing_pixels = 0;  // in all configurations
  std::uint64_t written_outside = 0;   // words outside the image, in all frames
  int oracle_width = 0, oracle_height = 0;
  std::uint64_t oracle_configurations = 0, oracle_differences = 0;
  std::vector<HitCount> hits;        // built-in grids only
  std::vector<Mismatch> mismatches;  // the first per backend and judge

  bool ok() const;
};

struct VerifyReport {
  std::vector<SceneVerdict> scenes;
  bool ok() const;
};

// Checks all scenes of the plan in order; calls `on_scene` after each. Throws as load_source does.
VerifyReport verify(const VerifyPlan& plan, const std::function<void(const SceneVerdict&)>& on_scene);

// One line per scene, of at most 80 columns.
std::string verify_header();
std::string verify_line(const SceneVerdict& verdict);

// "2 threads, avx2, tile 64, no coverage masks"
std::string describe(const lab::DrawOptions& how);

// The differences of a scene in detail; empty if there are none.
std::string explain(const SceneVerdict& verdict);

// The number of comparisons and the result.
std::string summary(const VerifyReport& report, const VerifyPlan& plan);

nlohmann::json report_json(const VerifyReport& report, const VerifyPlan& plan);

}  // namespace edgewise::tools
