#include "bench/models/scaling.h"

#include <time.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <string_view>
#include <utility>

namespace edgewise::bench {

namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double longest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

// Assigns the tasks in order, each to the core that is free first (the top of a heap of the times at which
// cores become free), and returns when the last task ends.
double schedule_s(const std::vector<double>& tasks_s, int cores) {
  std::vector<double> free_at_s(
      std::min(static_cast<std::size_t>(cores), std::max<std::size_t>(1, tasks_s.size())), 0.0);
  const auto later = std::greater<>();
  for (const double task_s : tasks_s) {
    std::pop_heap(free_at_s.begin(), free_at_s.end(), later);
    free_at_s.back() += task_s;
    std::push_heap(free_at_s.begin(), free_at_s.end(), later);
  }
  return longest(free_at_s);
}

double thread_cpu_s() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

double FrameWork::work_s() const {
  double total_s = after_s;
  for (const Section& section : sections) total_s += section.before_s + sum(section.tasks_s);
  return total_s;
}

double FrameWork::path_s() const {
  double total_s = after_s;
  for (const Section& section : sections) total_s += section.before_s + longest(section.tasks_s);
  return total_s;
}

PathPart FrameWork::longest_part() const {
  std::map<std::string, double> parts;
  for (const Section& section : sections) {
    parts["serial code before " + section.name] += section.before_s;
    parts["the longest task of " + section.name] += longest(section.tasks_s);
  }
  parts["serial code after the last section"] += after_s;
  const auto found = std::max_element(parts.begin(), parts.end(),
                                      [](const auto& a, const auto& b) { return a.second < b.second; });
  return {found->first, found->second};
}

void FrameWork::take_minima(const FrameWork& other) {
  const auto same_tasks = [](const Section& a, const Section& b) {
    return a.name == b.name && a.tasks_s.size() == b.tasks_s.size();
  };
  if (!std::equal(sections.begin(), sections.end(), other.sections.begin(), other.sections.end(),
                  same_tasks)) {
    *this = other;
    return;
  }
  const auto take = [](double& minimum, double time_s) { minimum = std::min(minimum, time_s); };
  for (std::size_t i = 0; i < sections.size(); ++i) {
    take(sections[i].before_s, other.sections[i].before_s);
    for (std::size_t task = 0; task < sections[i].tasks_s.size(); ++task)
      take(sections[i].tasks_s[task], other.sections[i].tasks_s[task]);
  }
  take(after_s, other.after_s);
}

double FrameWork::time_s(int cores, double barrier_s) const {
  double total_s = after_s;
  for (const Section& section : sections) {
    total_s += section.before_s + schedule_s(section.tasks_s, cores);
    if (cores > 1 && section.tasks_s.size() > 1) total_s += barrier_s;
  }
  return total_s;
}

std::string section_name(const CallSite& where) {
  const std::string_view file = where.file;
  return where.function + (" in " + std::string(file.substr(file.find_last_of('/') + 1)));
}

FrameWork FrameRecorder::finish() {
  frame_.after_s = lap_s();
  return std::move(frame_);
}

// Reading the thread's CPU clock is a system call, so it happens outside the lap.
void FrameRecorder::start_lap() {
  cpu_s_at_lap_ = thread_cpu_s();
  lap_began_ = std::chrono::steady_clock::now();
}

double FrameRecorder::lap_s() {
  const auto now = std::chrono::steady_clock::now();
  const double lap_s =
      std::min(std::chrono::duration<double>(now - lap_began_).count(), thread_cpu_s() - cpu_s_at_lap_);
  start_lap();
  return lap_s;
}

void FrameRecorder::section_begins(const CallSite& where) {
  const double before_s = lap_s();
  frame_.sections.push_back({section_name(where), before_s, {}});
  start_lap();
}

void FrameRecorder::task_ends() {
  frame_.sections.back().tasks_s.push_back(lap_s());
}

void FrameRecorder::section_ends() {
  start_lap();
}

double measured_barrier_s() {
  constexpr double kTask_s = 20e-6;
  constexpr int kRepetitions = 2001;
  const auto now_s = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  std::vector<double> times_s;
  for (int i = 0; i < kRepetitions; ++i) {
    const double begin_s = now_s();
    parallel_for(2, 2, [&](int) {
      for (const double task_began_s = now_s(); now_s() < task_began_s + kTask_s;) {
      }
    });
    times_s.push_back(now_s() - begin_s - kTask_s);
  }
  std::nth_element(times_s.begin(), times_s.begin() + kRepetitions / 2, times_s.end());
  return times_s[kRepetitions / 2];
}

}  // namespace edgewise::bench
