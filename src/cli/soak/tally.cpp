#include "cli/soak/tally.h"

namespace edgewise::soak {

Tally& Tally::operator+=(const Tally& o) {
  cases += o.cases;
  frames += o.frames, triangles += o.triangles, pixels += o.pixels, oracle_frames += o.oracle_frames;
  frontend_lists += o.frontend_lists;
  frames_differ += o.frames_differ, frontend_lists_differ += o.frontend_lists_differ;
  for (const auto& [category, counts] : o.by)
    for (const auto& [label, count] : counts) {
      Count& sum = by[category][label];
      sum.compared += count.compared, sum.differ += count.differ;
    }
  return *this;
}

}  // namespace edgewise::soak
