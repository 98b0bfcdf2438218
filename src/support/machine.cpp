#include "support/machine.h"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include "edgewise/simd_target.h"
#include "support/cores.h"

namespace edgewise::tools {

namespace {

constexpr const char* kUnknown = "unknown";

// The standard output of a shell command, without the last newline; none if the command fails.
std::optional<std::string> output_of(const std::string& command) {
  FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  std::array<char, 4096> part;
  for (std::size_t n; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;) text.append(part.data(), n);
  if (pclose(pipe) != 0) return std::nullopt;
  if (text.ends_with('\n')) text.pop_back();
  return text;
}

std::string quoted_for_shell(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string first_line(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

// Reads "key<separator>value" lines; of repeated keys, the first counts.
std::map<std::string, std::string> read_pairs(const std::string& path, char separator) {
  std::map<std::string, std::string> pairs;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const auto at = line.find(separator);
    if (at == std::string::npos) continue;
    const auto trimmed = [](std::string text) {
      const auto kept = [](char c) { return c != ' ' && c != '\t' && c != '"'; };
      text.erase(std::find_if(text.rbegin(), text.rend(), kept).base(), text.end());
      text.erase(text.begin(), std::find_if(text.begin(), text.end(), kept));
      return text;
    };
    pairs.emplace(trimmed(line.substr(0, at)), trimmed(line.substr(at + 1)));
  }
  return pairs;
}

// The CPU features that affect the choice and speed of kernels.
nlohmann::json cpu_features() {
  constexpr std::array kRelevant = {"sse4_1",   "sse4_2",   "avx",         "f16c",        "fma",
                                    "bmi2",     "avx2",     "avx512f",     "avx512bw",    "avx512dq",
                                    "avx512vl", "avx512cd", "avx512_vnni", "avx512_bf16", "gfni"};
  const std::string flags = ' ' + read_pairs("/proc/cpuinfo", ':')["flags"] + ' ';
  nlohmann::json features = nlohmann::json::array();
  for (const std::string name : kRelevant)
    if (flags.find(' ' + name + ' ') != std::string::npos) features.push_back(name);
  return features;
}

nlohmann::json caches() {
  nlohmann::json sizes = nlohmann::json::object();
  for (int index = 0;; ++index) {
    const std::string folder = fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}/", index);
    const std::string level = first_line(folder + "level"), type = first_line(folder + "type");
    if (level.empty()) return sizes;
    const std::string suffix = type == "Data" ? "d" : type == "Instruction" ? "i" : "";
    sizes["L" + level + suffix] = first_line(folder + "size");
  }
}

double memory_gib() {
  const double bytes =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return static_cast<double>(static_cast<long>(bytes / double(1 << 30) * 10.0 + 0.5)) / 10.0;
}

std::string kernel() {
  utsname names{};
  return uname(&names) == 0 ? std::string(names.sysname) + " " + names.release : kUnknown;
}

std::string compiler() {
#if defined(__clang__)
  return "Clang " __VERSION__;
#else
  return "GCC " __VERSION__;
#endif
}

// The commit of the source tree, or "unknown" for an installed program, whose source tree may have changed.
// Changes below results/ don't count as dirty, because results are written during measurements.
std::string commit() {
  namespace fs = std::filesystem;
  std::error_code failed;
  const fs::path self = fs::read_symlink("/proc/self/exe", failed);
  const fs::path build = fs::weakly_canonical(EDGEWISE_BINARY_DIR, failed);
  if (self.lexically_relative(build).string().starts_with("..")) return kUnknown;
  const std::string git = "git --no-optional-locks -C " + quoted_for_shell(EDGEWISE_SOURCE_DIR) + " ";
  const auto hash = output_of(git + "rev-parse --short=12 HEAD");
  if (!hash || hash->empty()) return kUnknown;
  const auto changes = output_of(git + "status --porcelain -- ':/' ':(top,exclude)results'");
  return *hash + (changes && changes->empty() ? "" : "-dirty");
}

nlohmann::json packages() {
  const auto list = output_of(
      "dpkg-query -W -f='${Package} ${Version}\\n' libtbb-dev libbenchmark-dev libglm-dev libhwy-dev "
      "libxxhash-dev libpng-dev "
      "libcli11-dev nlohmann-json3-dev libfmt-dev python3-matplotlib libgl1-mesa-dri; "
      "true");
  nlohmann::json versions = nlohmann::json::object();
  std::istringstream lines(list.value_or(""));
  for (std::string name, version; lines >> name && std::getline(lines >> std::ws, version);)
    versions[name] = version;
  return versions;
}

}  // namespace

std::string cpu_model(const std::string& cpuinfo) {
  auto pairs = read_pairs(cpuinfo, ':');
  std::string model = pairs["model name"];
  for (const std::string_view filler : {"(R)", "(TM)", " CPU", " Processor"})
    for (std::size_t at; (at = model.find(filler)) != std::string::npos;) model.erase(at, filler.size());
  const std::string family = pairs["cpu family"], number = pairs["model"];
  const std::string implementer = pairs["CPU implementer"], part = pairs["CPU part"];
  if (model.empty())
    return implementer.empty() ? kUnknown : fmt::format("ARM (implementer {}, part {})", implementer, part);
  return family.empty() || number.empty() ? model
                                          : fmt::format("{} (family {}, model {})", model, family, number);
}

nlohmann::json machine_description() {
  nlohmann::json json;
  json["cpu_model"] = cpu_model();
  json["cpu_features"] = cpu_features();
  json["cores"] = machine_cores();
  json["usable_cores"] = usable_cores();
  const std::string max_khz = first_line("/sys/devices/system/cpu/cpu0/cpufreq/cpuinfo_max_freq");
  if (!max_khz.empty()) json["cpu_mhz_max"] = std::strtol(max_khz.c_str(), nullptr, 10) / 1000;
  json["caches"] = caches();
  json["memory_gib"] = memory_gib();
  const std::string os = read_pairs("/etc/os-release", '=')["PRETTY_NAME"];
  json["os"] = os.empty() ? kUnknown : os;
  json["kernel"] = kernel();
  json["compiler"] = compiler();
  json["flags"] = EDGEWISE_FLAGS;
  json["build_type"] = EDGEWISE_BUILD_TYPE;
  json["edgewise_version"] = EDGEWISE_VERSION;
  json["commit"] = commit();
  json["packages"] = packages();
  for (const SimdTarget target : supported_targets()) json["simd_targets"].push_back(name_of(target));
  json["simd_best"] = name_of(resolve(SimdTarget::best));
  return json;
}

std::string machine_name() {
  const int all = machine_cores(), usable = usable_cores();
  const std::string part = usable == all ? "" : fmt::format("{} of ", usable);
  std::string name;
  for (const char c : fmt::format("{} {}{} {}", cpu_model(), part, all, all == 1 ? "core" : "cores")) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u))
      name += static_cast<char>(std::tolower(u));
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  return name;
}

}  // namespace edgewise::tools
