#include "bench/workloads/memory.h"

#include <malloc.h>

#include <fstream>
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

// From here on VmHWM is the highest that VmRSS has been.
void forget_earlier_peaks() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

}  // namespace

std::optional<double> peak_bytes(const Row& row) {
  malloc_trim(0);  // else the frame would live in what others left behind, and seem to need nothing
  forget_earlier_peaks();
  const auto before = status_bytes("VmRSS:"), peak_before = status_bytes("VmHWM:");
  Workload& workload = *row.workload;
  {
    Frontend frontend;
    const auto triangles = workload.run(frontend, row.execution.threads);
    Framebuffer frame(workload.width(), workload.height());
    row.backend->make()->draw(triangles, frame.view(), kBackground, row.execution);
  }
  const auto peak = status_bytes("VmHWM:");
  constexpr double kOthers = 1 << 20;  // what other threads take meanwhile, and how coarsely Linux counts
  if (!before || !peak_before || !peak || *peak_before > *before + kOthers) return std::nullopt;
  return *peak - *before;
}

}  // namespace edgewise::bench
