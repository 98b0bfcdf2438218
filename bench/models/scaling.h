// Estimates a frame's time on N cores, more than the machine has. The frame is drawn as if for N threads, but
// task by task on one thread. Its tasks are then scheduled on N imagined cores.
//
// Each task goes to the core that is free first (Graham, "Bounds for certain multiprocessing anomalies",
// 1966). This takes at most work / cores + critical path, and no schedule takes less than the larger of the
// two (Brent, 1974). The model ignores shared memory bandwidth, shared caches and clock rate.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "core/parallel.h"

namespace edgewise::bench {

// Serial work, then tasks that may run in parallel. The next section starts when all of them have ended.
struct Section {
  std::string name;  // "function in file"
  double before_s = 0.0;
  std::vector<double> tasks_s;
};

// A part of the critical path: serial work, or the longest tasks of the sections of one name.
struct PathPart {
  std::string name;
  double time_s = 0.0;
};

struct FrameWork {
  std::vector<Section> sections;
  double after_s = 0.0;  // serial work after the last section

  double work_s() const;
  double path_s() const;  // the critical path: the time with one core per task
  PathPart longest_part() const;

  // Takes the minimum of each task and serial part of two recordings of one frame, since interruptions hit
  // different tasks each time. Replaces this recording by `other` if their sections or task counts differ.
  void take_minima(const FrameWork& other);

  // The frame's time on `cores`. On more than one, each section of several tasks costs barrier_s in addition.
  double time_s(int cores, double barrier_s) const;
};

// "draw in bins.cpp".
std::string section_name(const CallSite& where);

// Records the frame that is drawn between its construction and finish().
class FrameRecorder final : public ParallelObserver {
 public:
  FrameRecorder() { start_lap(); }
  FrameWork finish();

  void section_begins(const CallSite& where) override;
  void task_ends() override;
  void section_ends() override;

 private:
  double lap_s();  // seconds since the last lap: wall time, or this thread's CPU time if that is less
  void start_lap();

  FrameWork frame_;
  std::chrono::steady_clock::time_point lap_began_;
  double cpu_s_at_lap_ = 0.0;
};

// The time for starting and joining two threads on this machine: the duration of a section of two short tasks
// minus that of one task, the median of many. If other processes use a core, it includes waiting for them.
double measured_barrier_s();

}  // namespace edgewise::bench
