// Which rows there are: scenes × backends × threads, and the sweeps. Nothing is loaded or drawn here.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/models/scaling.h"
#include "bench/peers/peer.h"
#include "bench/workloads/workload.h"
#include "raster/ablation.h"

namespace edgewise::bench {

enum class Timed {
  raster,    // the draw of prepared screen triangles, clear included
  frontend,  // scene to screen triangles
  frame      // both
};

// A row whose one draw takes longer is not drawn again: the compared draw is the timed one.
inline constexpr double kTooSlowToRepeat_s = 1.5;

struct Row {
  // WHO/what/key:value…/threads:N, WHO being BACKEND, frontend or BACKEND+frontend, and a peer a BACKEND
  std::string name;
  std::shared_ptr<Workload> workload;
  Timed timed = Timed::raster;
  const BackendInfo* backend = nullptr;  // null for front end rows and peers
  const PeerInfo* peer = nullptr;
  Execution execution;
  Ablation ablation{};
  double repeat_below_s = kTooSlowToRepeat_s;
  int cores = 0;          // if set, estimated for so many, not timed; execution.threads is the same
  FrameWork recorded;     // what is scheduled then
  double peak_bytes = 0;  // of a first frame; 0 where it was not measured
  bool wants_cost = false;
  bool step = false;               // of the ablation
  double once_s = 0.0;             // what it took when it was compared
  std::optional<FrameCost> floor;  // if wanted
  std::uint64_t near_ties = 0;     // peers: pixels where another triangle is as near up to rounding
  std::string error;               // why it must not be timed
};

struct SuiteOptions {
  bool quick = false;
  int width = 1920, height = 1080;       // px
  bool size_asked = false;               // else a .tri file is drawn at the size it was made for
  std::vector<std::string> scenes;       // names or files; empty: the whole suite
  std::vector<std::string> more_scenes;  // beside the whole suite
  bool fit = false;                      // for meshes in `scenes` and `more_scenes`
  bool peers = true;                     // those that were built
};

// Throws what load_source throws for a name or file that cannot be used, and std::invalid_argument for two
// whose rows would bear the same names.
std::vector<Row> make_suite(const SuiteOptions& options);

}  // namespace edgewise::bench
