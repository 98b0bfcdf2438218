// Where rows are compared and timed: the frames and the backends that rows share.
#pragma once

#include <map>
#include <memory>
#include <utility>

#include "bench/peers/stage.h"
#include "bench/suite.h"

namespace edgewise::bench {

class Stage {
 public:
  // Draws the row once, compares every bit with the reference, and sets the row's once_s, and its error if
  // they differ, and the floor under it where that is wanted; records its tasks, if it is to be scheduled.
  // Needs the workload prepared.
  void compare(Row& row);

  // Does once what the row times.
  void work(const Row& row);

 private:
  void compare_ours(Row& row);
  Backend& backend(const Row& row);
  Framebuffer& frame(const Row& row);
  double timed_work_s(const Row& row);
  double recorded_work_s(Row& row);

  std::map<const BackendInfo*, std::unique_ptr<Backend>> backends_;
  // One for each size, to the end: interleaved repetitions come back to all of them, and a fresh frame would
  // put its page faults into a row's time.
  std::map<std::pair<int, int>, Framebuffer> frames_;
  Frontend frontend_;
  PeerStage peers_;
  CostModel limit_;
};

}  // namespace edgewise::bench
