// The soak itself: case after case of a shard, several at once, until told to stop.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "cli/soak/check.h"
#include "cli/soak/record.h"

namespace edgewise::soak {

struct Campaign {
  Judged judged;
  std::optional<double> seconds;       // begins no case later than that; none: no limit
  std::optional<std::uint64_t> cases;  // at most so many more
  // Cases drawn at once. No result depends on it, but for one: where there are more findings than
  // kMostFindings, which of them are described.
  int jobs = 1;
  std::string program = "edgewise";  // see Evidence, as for
  std::filesystem::path failure_folder;
  // Asked before each case, and while a finding's triangles are reduced, on any thread.
  std::function<bool()> stop = [] { return false; };

  // Called a few times a second and at the end, on the caller's thread, with a record that is whole: all
  // cases up to its last one are in it.
  std::function<void(const Record&)> on_progress = [](const Record&) {};
  // Called on the caller's thread before run() throws, with a record of what had been done by then.
  std::function<void(const Record&)> on_failure = [](const Record&) {};
};

// Goes on from `record`, which has one shard, and returns what it has become. Case by case it takes on what
// was found in the sequence's order, so that where it stops it can go on. Throws what a backend throws, with
// the case's number.
Record run(const Campaign& campaign, Record record);

}  // namespace edgewise::soak
