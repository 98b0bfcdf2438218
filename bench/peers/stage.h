// Compares and times the peers' rows.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "bench/row.h"

namespace edgewise::bench {

class PeerStage {
 public:
  // Draws the row's scene twice, with triangle ids and with colours. Sets the row's depth_ties, and its error
  // if the coverage differs, or a visible triangle beyond a depth tie within tolerance, or a colour. Keeps
  // the scene loaded in the peer. Requires a prepared workload.
  void compare(Row& row);

  // Draws one frame of a row that compare() has loaded.
  void work(const Row& row) { loaded_.at(row.name)->draw(); }

 private:
  std::map<std::string, std::unique_ptr<PeerFrame>> loaded_;  // by row name
};

}  // namespace edgewise::bench
