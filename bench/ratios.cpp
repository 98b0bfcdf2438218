#include "ratios.h"

#include <fmt/format.h>

namespace edgewise::bench {

namespace {

// Of our rows that do the same work with as many threads, the fastest that was timed.
std::pair<const Row*, double> fastest_of_ours(const Row& peer, const std::vector<Row>& rows,
                                              const std::map<std::string, double>& median_ms) {
  std::pair<const Row*, double> best{nullptr, 0.0};
  for (const Row& row : rows) {
    const bool same = row.backend != nullptr && row.backend->fills && row.workload == peer.workload &&
                      row.timed == peer.timed && row.execution.threads == peer.execution.threads;
    const auto found = same ? median_ms.find(row.name) : median_ms.end();
    if (found != median_ms.end() && (best.first == nullptr || found->second < best.second))
      best = {&row, found->second};
  }
  return best;
}

}  // namespace

std::string ratio_table(const std::vector<Row>& rows, const std::map<std::string, double>& median_ms) {
  std::string lines;
  for (const Row& row : rows) {
    if (row.peer == nullptr || !median_ms.contains(row.name)) continue;
    const auto [ours, ours_ms] = fastest_of_ours(row, rows, median_ms);
    if (ours == nullptr) continue;
    const double peer_ms = median_ms.at(row.name);
    lines += fmt::format("{:<44} {:>10.3f} ms  {:<44} {:>10.3f} ms  {:>6.2f} times\n", row.name, peer_ms,
                         ours->name, ours_ms, peer_ms / ours_ms);
  }
  return lines.empty()
             ? lines
             : "\nHow many times longer a peer takes than the fastest of ours, by medians:\n" + lines;
}

}  // namespace edgewise::bench
