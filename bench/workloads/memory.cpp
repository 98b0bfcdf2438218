#include "bench/workloads/memory.h"

#include <malloc.h>

#include <fstream>
#include <optional>
#include <string>

namespace edgewise::bench {

namespace {

std::optional<double> status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kibibytes = 0.0;
    if (word == key && status >> kibibytes) return kibibytes * 1024.0;
  }
  return std::nullopt;
}

// Resets VmHWM, the peak of VmRSS (proc(5), clear_refs).
void reset_peak() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

}  // namespace

std::optional<double> peak_bytes_of_first_frame(const Row& row) {
  malloc_trim(0);  // otherwise the frame would use freed memory that is still resident, and appear free
  reset_peak();
  const auto before = status_bytes("VmRSS:"), peak_before = status_bytes("VmHWM:");
  Workload& workload = *row.workload;
  {
    Frontend frontend;
    Framebuffer frame(workload.width(), workload.height());
    workload.draw(frontend, *row.backend->make(), frame.view(), row.execution);
  }
  const auto peak = status_bytes("VmHWM:");
  constexpr double kTolerance = 1 << 20;  // bytes: other threads' allocations, and Linux's coarse counters
  if (before && peak_before && peak && *peak_before <= *before + kTolerance) return *peak - *before;
  return std::nullopt;
}

}  // namespace edgewise::bench
