// Describes the machine and the build of a result.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace edgewise::tools {

// CPU model, features, cores and those that this process may use, caches, memory, kernel, compiler and flags,
// build type, commit (read from the source tree's git at run time, "-dirty" appended), package versions, SIMD
// targets. No host name.
nlohmann::json machine_description();

// The system's model name without "(R)" and the like, with CPUID family and model if known, because virtual
// machines use one name for many CPUs: "AMD EPYC (family 25, model 17)". ARM processors have numbers only:
// "ARM (implementer 0x41, part 0xd0c)".
std::string cpu_model(const std::string& cpuinfo = "/proc/cpuinfo");

// The folder below results/ for this machine, for example "amd-epyc-family-25-model-17-2-cores": CPU model
// and core count, lower case. A process that may use only some of the cores has results of its own:
// "…-1-of-2-cores".
std::string machine_name();

}  // namespace edgewise::tools
