// The counts of a soak test. Merging and resuming add them up.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace edgewise::soak {

struct Count {
  std::uint64_t compared = 0, differ = 0;  // frames, or triangle lists of the front end
  bool operator==(const Count&) const = default;
};

struct Tally {
  std::uint64_t cases = 0;
  std::uint64_t frames = 0;          // drawn, and compared bit for bit
  std::uint64_t triangles = 0;       // in them
  std::uint64_t pixels = 0;          // in them
  std::uint64_t oracle_frames = 0;   // of these frames, those that the oracle judged
  std::uint64_t frontend_lists = 0;  // made by the front end, and compared bit for bit
  std::uint64_t frames_differ = 0, frontend_lists_differ = 0;
  // "family", "backend_simd_target", … → "tiled, avx2", … → how many frames or lists
  std::map<std::string, std::map<std::string, Count>> by;

  std::uint64_t differences() const { return frames_differ + frontend_lists_differ; }
  void count(const std::string& category, const std::string& label, bool differs) {
    Count& counted = by[category][label];
    ++counted.compared;
    if (differs) ++counted.differ;
  }
  Tally& operator+=(const Tally& other);
  bool operator==(const Tally&) const = default;
};

}  // namespace edgewise::soak
