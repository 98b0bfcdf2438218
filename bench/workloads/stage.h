// Compares and times rows. Owns the frames and backends that rows share.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "bench/row.h"
#include "bench/workloads/peers.h"
#include "lab/cases/backend_comparison.h"

namespace edgewise::bench {

class Stage {
 public:
  // Draws the row and compares every bit with the reference. Sets once_s, and `error` if a bit differs.
  // Requires a prepared workload, if the row has one.
  void compare(Row& row);

  // Drops the engine's memory, so that it gets the same addresses with every arithmetic. Others can change a
  // row's time by 10 %. Returns whether the row needs a warm-up.
  bool renew_memory(const Row& row);

  // Performs the row's timed work once.
  void work(const Row& row);
  // The same, and its duration, by the device's clock if the row has it.
  double timed_work_s(const Row& row);

 private:
  void compare_ours(Row& row);
  Framebuffer& frame(const Row& row);
  Backend& backend(const Row& row);

  lab::BackendCache backends_;
  // One per size, kept to the end: interleaved repetitions use all of them again, and a fresh frame's page
  // faults would count in a row's time.
  std::map<std::pair<int, int>, Framebuffer> frames_;
  Frontend frontend_;
  std::map<lab::EngineArithmetic, std::unique_ptr<Backend>> engines_;
  PeerStage peers_;
  std::map<std::string, std::function<void()>> draws_;  // of methods and pipelines, by row name
};

}  // namespace edgewise::bench
