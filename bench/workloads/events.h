// Counts events of the calling thread, such as instructions, by Linux's perf_event_open.
#pragma once

#include <cstdint>
#include <string>

namespace edgewise::bench {

class EventCounter {
 public:
  // Counts in user space from now on. <linux/perf_event.h> has the types and their configs.
  EventCounter(std::uint32_t type, std::uint64_t config);
  ~EventCounter();
  EventCounter(const EventCounter&) = delete;
  EventCounter& operator=(const EventCounter&) = delete;

  // The events so far; NaN where the kernel or the processor does not count them.
  double count() const;
  // Why it cannot count; empty if it can.
  const std::string& error() const { return error_; }

 private:
  int file_;
  std::string error_;
};

}  // namespace edgewise::bench
