// One row of the benchmark.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "bench/workloads/workload.h"
#include "lab/engine/engine.h"
#include "lab/peers/peer.h"

namespace edgewise::bench {

enum class Timed {
  raster,    // the draw of prepared screen triangles, clear included
  frontend,  // scene to screen triangles
  frame      // both
};

// Rows that take longer are not repeated: the comparison times them, by the faster of two draws.
inline constexpr double kTooSlowToRepeat_s = 0.3;
// Rows that take longer are drawn once. Whole frames that do are left out of the suite.
inline constexpr double kTooSlowToDrawTwice_s = 1.5;

using TimedDraw = std::function<void()>;

struct Row {
  // WHO/what/key:value…/threads:N, where WHO is BACKEND, frontend, BACKEND+frontend, a peer's name, cell,
  // lab, needs or choice
  std::string name;
  std::shared_ptr<Workload> workload;  // null for what the laboratory draws, which has this:
  // Draws and judges the picture, and returns the timed draw. Sets `error`, and of methods `triangles`.
  std::function<TimedDraw(Row&)> prepare;
  std::optional<std::size_t> triangles;
  Timed timed = Timed::raster;
  const BackendInfo* backend = nullptr;  // null for front end rows, peers and rows without a workload
  const lab::PeerInfo* peer = nullptr;
  std::string peer_version;   // empty: it did not start
  bool device_clock = false;  // a peer's frame by its device's clock
  Execution execution;
  std::optional<lab::EngineArithmetic> arithmetic;  // if set, the laboratory's engine draws, not `backend`
  double many_rounds_up_to_s = 0.0;  // a shorter draw is repeated more often than other rows are
  double once_s = 0.0;               // duration of the compared draw
  std::uint64_t depth_ties = 0;      // peers: depth ties within tolerance, px
  // If the row may draw another picture: pixels of another colour; peers: that show another triangle.
  std::optional<std::uint64_t> wrong_px;
  std::string error;  // why the row must not be timed
};

// One of the frames that differ in one factor at a time.
inline bool is_cell(const Row& row) {
  return row.name.starts_with("cell/");
}

// A frame of the chart for choosing a method.
inline bool is_choice(const Row& row) {
  return row.name.starts_with("choice/");
}

}  // namespace edgewise::bench
