#include "support/cores.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
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

// "QUOTA PERIOD" or "max PERIOD", in microseconds.
double quota_of(const std::filesystem::path& group) {
  std::ifstream file(group / "cpu.max");
  double quota = 0.0, period = 0.0;
  return file >> quota >> period && quota > 0.0 && period > 0.0 ? quota / period : kUnlimited;
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
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("0::")) continue;
    // A container may see its own group as the root, under the path that the host knows.
    std::filesystem::path group = root;
    least = std::min(least, quota_of(group));
    for (const auto& part : std::filesystem::path(line.substr(3)).lexically_normal().relative_path())
      least = std::min(least, quota_of(group /= part));
  }
  return least;
}

}  // namespace edgewise::tools
