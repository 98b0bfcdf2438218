#include "bench/models/second_thread.h"

#include <chrono>

namespace edgewise::bench {

double WaitTimer::steady_now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

WaitTimer::WaitTimer(double (*now_s)()) : now_s_(now_s), serial_since_s_(now_s()) {}

Waits WaitTimer::finish() {
  Waits sum{.serial_s = serial_s_ + now_s_() - serial_since_s_};
  for (const Thread& thread : threads_) {
    sum.start_s += thread.waits.start_s;
    sum.between_s += thread.waits.between_s;
    sum.turn_s += thread.waits.turn_s;
    sum.end_s += thread.waits.end_s;
  }
  return sum;
}

void WaitTimer::section_begins() {
  const double now_s = now_s_();
  serial_s_ += now_s - serial_since_s_;
  for (Thread& thread : threads_) {
    thread.idle_since_s = now_s;
    thread.has_begun = false;
  }
}

void WaitTimer::task_begins(int thread) {
  Thread& t = threads_[static_cast<std::size_t>(thread)];
  (t.has_begun ? t.waits.between_s : t.waits.start_s) += now_s_() - t.idle_since_s;
  t.has_begun = true;
}

void WaitTimer::wait_begins(int thread) {
  threads_[static_cast<std::size_t>(thread)].idle_since_s = now_s_();
}

void WaitTimer::wait_ends(int thread) {
  Thread& t = threads_[static_cast<std::size_t>(thread)];
  t.waits.turn_s += now_s_() - t.idle_since_s;
}

void WaitTimer::task_ends(int thread) {
  threads_[static_cast<std::size_t>(thread)].idle_since_s = now_s_();
}

void WaitTimer::section_ends() {
  const double now_s = now_s_();
  for (Thread& t : threads_) (t.has_begun ? t.waits.end_s : t.waits.start_s) += now_s - t.idle_since_s;
  serial_since_s_ = now_s;
}

ThreadRound time_round(const std::function<void(int threads)>& draw, bool is_short, bool two_first) {
  ThreadRound round;
  const auto draw_s = [&](int threads) {
    const auto begin = std::chrono::steady_clock::now();
    draw(threads);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const auto on_one = [&] {
    if (is_short) draw(1);
    round.one_s = draw_s(1);
  };
  const auto on_two = [&] {
    if (is_short) draw(2);
    WaitTimer timer;
    const TimeParallel scope(timer);
    round.two_s = draw_s(2);
    round.waits = timer.finish();
  };
  if (two_first) on_two();
  on_one();
  if (!two_first) on_two();
  return round;
}

}  // namespace edgewise::bench
