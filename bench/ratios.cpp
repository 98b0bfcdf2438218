#include "bench/ratios.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/workloads/ablation.h"

namespace edgewise::bench {

namespace {

// Whether our row does the peer row's work on as many threads, with the default switches.
bool is_comparable(const Row& ours, const Row& peer) {
  return ours.backend != nullptr && ours.backend->name == kAblationBackend && is_plain(ours) &&
         ours.workload == peer.workload && ours.timed == peer.timed &&
         ours.execution.threads == peer.execution.threads;
}

// Our speed relative to the peer's: "7.50× faster" or "2.00× slower".
std::string speed_ratio(double peer_ms, double ours_ms) {
  return ours_ms <= peer_ms ? fmt::format("{:>6.2f}× faster", peer_ms / ours_ms)
                            : fmt::format("{:>6.2f}× slower", ours_ms / peer_ms);
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
    lines += fmt::format("{:<44} {:>10.3f} ms  {:<44} {:>10.3f} ms  {}\n", row.name, peer_ms, ours->name,
                         ours_ms, speed_ratio(peer_ms, ours_ms));
  }
  return lines.empty()
             ? lines
             : fmt::format("\nSpeed of {} relative to each peer, by medians:\n", kAblationBackend) + lines;
}

}  // namespace edgewise::bench
