// Where the rows of peers are compared and timed.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "bench/suite.h"

namespace edgewise::bench {

class PeerStage {
 public:
  // Draws the row's scene twice, by triangle and by colour, and sets its near ties, and its error if another
  // pixel is drawn, or belongs to another triangle without a near tie, or has another colour. Keeps the scene
  // in the peer's memory. Needs the workload prepared.
  void compare(Row& row);

  // One frame of a row that was compared.
  void work(const Row& row) { loaded_.at(row.name)->draw(); }

 private:
  std::map<std::string, std::unique_ptr<PeerFrame>> loaded_;  // by row name
};

}  // namespace edgewise::bench
