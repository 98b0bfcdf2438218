// The machine and the build that a result comes from.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace edgewise::app {

// CPU model, features, cores, caches, memory, kernel, compiler and flags, build type, commit (read from the
// source tree's git at run time, "-dirty" appended), package versions, SIMD targets. No host name.
nlohmann::json machine_description();

// As the system tells, and where it tells them with CPUID's family and model, since virtual machines have one
// name for many: "AMD EPYC (family 25, model 17)".
std::string cpu_model(const std::string& cpuinfo = "/proc/cpuinfo");

// The folder below results/ for this machine, for example "amd-epyc-family-25-model-17-2-cores": CPU model
// and core count, lower case.
std::string machine_name();

}  // namespace edgewise::app
