// How many cores the machine has, and how many of them this process may use.
#pragma once

#include <filesystem>

namespace edgewise::tools {

int machine_cores();  // online

// At least 1: those in the process's affinity mask, which cpusets restrict too, but no more than the whole
// cores of the CPU quotas of its cgroups.
int usable_cores();

// The least CPU quota, in cores, of the cgroup (version 2) that /proc/self/cgroup names and of its parents,
// by their files cpu.max below `root`. Infinite if there is none.
double cpu_quota(const std::filesystem::path& membership = "/proc/self/cgroup",
                 const std::filesystem::path& root = "/sys/fs/cgroup");

}  // namespace edgewise::tools
