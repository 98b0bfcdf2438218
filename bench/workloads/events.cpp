#include "bench/workloads/events.h"

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>

namespace edgewise::bench {

EventCounter::EventCounter(std::uint32_t type, std::uint64_t config) {
  perf_event_attr attributes{};
  attributes.size = sizeof attributes;
  attributes.type = type;
  attributes.config = config;
  attributes.pinned = 1;  // to a counter of its own: without one, reads fail
  attributes.exclude_kernel = attributes.exclude_hv = 1;
  file_ = static_cast<int>(syscall(SYS_perf_event_open, &attributes, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
  if (file_ < 0) error_ = std::strerror(errno);
}

EventCounter::~EventCounter() {
  if (file_ >= 0) close(file_);
}

double EventCounter::count() const {
  std::uint64_t events = 0;
  return read(file_, &events, sizeof events) == sizeof events ? static_cast<double>(events)
                                                              : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace edgewise::bench
