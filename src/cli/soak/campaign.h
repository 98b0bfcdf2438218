// Runs a soak test: draws the cases of a shard on several threads until a limit or a stop request.
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
  std::optional<double> seconds;       // no case begins later than this; none: no limit
  std::optional<std::uint64_t> cases;  // the most new cases; none: no limit
  // Cases drawn concurrently. The results don't depend on it, except for the choice of the findings that are
  // described if there are more than kMostFindings.
  int jobs = 1;
  std::string program = "edgewise";      // Evidence::program
  std::filesystem::path failure_folder;  // Evidence::folder
  // Called before each case and during the reduction of a finding, on any thread.
  std::function<bool()> stop = [] { return false; };

  // Called a few times per second and at the end, on the caller's thread, with a consistent record: it
  // contains all cases up to its last one.
  std::function<void(const Record&)> on_progress = [](const Record&) {};
  // Called on the caller's thread before run() throws, with the record of all cases done until then.
  std::function<void(const Record&)> on_failure = [](const Record&) {};
};

// Continues `record`, which has one shard, and returns the extended record. Cases enter the record in the
// order of the sequence, so a stopped run can be continued. Throws what a backend throws, with the case's
// number.
Record run(const Campaign& campaign, Record record);

}  // namespace edgewise::soak
