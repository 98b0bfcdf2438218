// What two threads lose: divides the time of two threads that draw a frame, paired with the same frame on one
// thread.
#pragma once

#include <array>
#include <functional>

#include "core/parallel.h"

namespace edgewise::bench {

// The waits of both threads in a frame. The rest of their time is spent in tasks and serial code.
struct Waits {
  double serial_s = 0;   // for serial code, which includes sections that run on one thread
  double start_s = 0;    // from a section's start to the thread's first task, or to its end if there is none
  double between_s = 0;  // between two tasks
  double turn_s = 0;     // in tasks, for another task (TimeWait)
  double end_s = 0;      // from the thread's last task to the section's end
};

// Measures the waits in the sections of a frame. Two threads must draw it between construction and finish().
class WaitTimer final : public ParallelTimer {
 public:
  explicit WaitTimer(double (*now_s)() = steady_now_s);
  Waits finish();

  void section_begins() override;
  void task_begins(int thread) override;
  void wait_begins(int thread) override;
  void wait_ends(int thread) override;
  void task_ends(int thread) override;
  void section_ends() override;

 private:
  // Its alignment keeps two threads from writing the same pair of cache lines.
  struct alignas(128) Thread {
    double idle_since_s = 0;
    bool has_begun = false;  // its first task of the section
    Waits waits;
  };
  static double steady_now_s();

  double (*now_s_)();
  double serial_since_s_, serial_s_ = 0;
  std::array<Thread, 2> threads_;
};

// One frame on each number of threads, drawn next to each other.
struct ThreadRound {
  double one_s = 0, two_s = 0;
  Waits waits;  // on two
};

// Draws the frame by calls of draw(threads). If it is short, an untimed draw before each timed one wakes the
// second thread and fills the caches.
ThreadRound time_round(const std::function<void(int threads)>& draw, bool is_short, bool two_first);

}  // namespace edgewise::bench
