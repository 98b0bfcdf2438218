// What a frame's work and critical path allow on more cores than there are. The frame is drawn as if for that
// many threads, but task by task on one thread; its tasks are then handed out to imagined cores.
//
// Handing the next task to the core that is free first (Graham, "Bounds for certain multiprocessing
// anomalies", 1966) takes at most work / cores + critical path, and no schedule takes less than the larger of
// the two (Brent, 1974). Not in the model: cores that share memory bandwidth, caches and clock rate.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "core/parallel.h"

namespace edgewise::bench {

// Serial work, then tasks that may run at the same time; the next section waits for all of them.
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
  double after_s = 0.0;  // serial work behind the last section

  double work_s() const;
  double path_s() const;  // the critical path: what is left with a core for each task
  PathPart longest_part() const;

  // Each piece as short as in the shorter of two recordings of one frame: what interrupts a core falls on
  // another piece each time. Recordings of other sections or tasks are taken as they are.
  void take_least(const FrameWork& other);

  // On so many cores, if starting and ending a section costs barrier_s where there is more than one.
  double time_s(int cores, double barrier_s) const;
};

// "draw in bins.cpp".
std::string section_name(const CallSite& where);

// Records the frame that is drawn from its making to finish().
class FrameRecorder final : public ParallelObserver {
 public:
  FrameRecorder() { start_lap(); }
  FrameWork finish();

  void section_begins(const CallSite& where) override;
  void task_ends() override;
  void section_ends() override;

 private:
  double lap_s();  // since the last lap ended: the time, or this thread's own if others took some of it
  void start_lap();

  FrameWork frame_;
  std::chrono::steady_clock::time_point lap_began_;
  double own_s_at_lap_ = 0.0;
};

// What a section of two short tasks takes longer, on two threads of this machine, than one of them: starting
// and waiting. The median of many; where others use a core, it has what waiting for them costs.
double measured_barrier_s();

}  // namespace edgewise::bench
