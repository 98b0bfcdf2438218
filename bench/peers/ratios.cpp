#include "bench/peers/ratios.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/workloads/ablation.h"

namespace edgewise::bench {

namespace {

// Whether our row draws what the peer's does, with as many threads and the switches that users get.
bool is_comparable(const Row& ours, const Row& peer) {
  return ours.backend != nullptr && ours.backend->name == kAblationBackend && !ours.step && ours.cores == 0 &&
         ours.execution.target == SimdTarget::best && ours.workload == peer.workload &&
         ours.timed == peer.timed && ours.execution.threads == peer.execution.threads;
}

}  // namespace

std::string ratio_table(const std::vector<Row>& rows, const std::map<std::string, double>& median_ms) {
  std::string lines;
  for (const Row& row : rows) {
    if (row.peer == nullptr || !median_ms.contains(row.name)) continue;
    const auto ours = std::find_if(rows.begin(), rows.end(), [&](const Row& other) {
      return is_comparable(other, row) && median_ms.contains(other.name);
    });
    if (ours == rows.end()) continue;
    const double peer_ms = median_ms.at(row.name), ours_ms = median_ms.at(ours->name);
    lines += fmt::format("{:<44} {:>10.3f} ms  {:<44} {:>10.3f} ms  {:>6.2f}×\n", row.name, peer_ms,
                         ours->name, ours_ms, peer_ms / ours_ms);
  }
  return lines.empty()
             ? lines
             : fmt::format("\nHow many times faster {} is than a peer, by medians:\n", kAblationBackend) +
                   lines;
}

}  // namespace edgewise::bench
