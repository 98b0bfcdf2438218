#include "support/cores.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace edgewise::tools {

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

int cores_in_affinity_mask() {
  std::vector<cpu_set_t> mask(64);  // 65,536 cores
  const std::size_t bytes = mask.size() * sizeof(cpu_set_t);
  return sched_getaffinity(0, bytes, mask.data()) == 0 ? CPU_COUNT_S(bytes, mask.data()) : machine_cores();
}

// `period` is a number in the first file, after the quota, or else in the second.
double quota_in(const std::filesystem::path& quota_file, const std::filesystem::path& period_file) {
  std::ifstream quota_from(quota_file), period_from(period_file);
  double quota = 0.0, period = 0.0;
  if (!(quota_from >> quota)) return kUnlimited;  // "max", or no such file
  if (!(quota_from >> period) && !(period_from >> period)) return kUnlimited;
  return quota > 0.0 && period > 0.0 ? quota / period : kUnlimited;  // version 1 has -1 for none
}

double quota_of(const std::filesystem::path& group) {
  return std::min(quota_in(group / "cpu.max", ""),
                  quota_in(group / "cpu.cfs_quota_us", group / "cpu.cfs_period_us"));
}

}  // namespace

int machine_cores() {
  return static_cast<int>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
}

int usable_cores() {
  const int allowed = std::clamp(cores_in_affinity_mask(), 1, machine_cores());
  return std::max(1, static_cast<int>(std::min<double>(allowed, cpu_quota())));
}

double cpu_quota(const std::filesystem::path& membership, const std::filesystem::path& root) {
  double least = kUnlimited;
  std::ifstream file(membership);
  // "0::/path" (version 2), or "4:cpu,cpuacct:/path"
  for (std::string line; std::getline(file, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (!controllers.empty() && ("," + controllers + ",").find(",cpu,") == std::string::npos) continue;
    // A container may see its own group as the root, under the path that the host knows.
    const auto path = std::filesystem::path(line.substr(second + 1)).lexically_normal().relative_path();
    // Version 2 is mounted at the root; version 1 at "cpu,cpuacct", at "cpu", or at both.
    for (const std::string& mount : std::set<std::string>{controllers, controllers.empty() ? "" : "cpu"}) {
      std::filesystem::path group = root / mount;
      least = std::min(least, quota_of(group));
      for (const auto& part : path) least = std::min(least, quota_of(group /= part));
    }
  }
  return least;
}

}  // namespace edgewise::tools
