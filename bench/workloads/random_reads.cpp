#include "bench/workloads/random_reads.h"

#include <algorithm>
#include <utility>

#include "core/random.h"
#include "raster/llc.h"

namespace edgewise::bench {

RandomReads::RandomReads(std::size_t bytes) : lines_(std::max<std::size_t>(1, bytes / sizeof(Line))) {
  memory_.reserve(lines_);
  Line* lines = memory_.data();
  for (std::size_t i = 0; i < lines_; ++i) lines[i].next = i;
  // Sattolo, "An algorithm to generate a random cyclic permutation", 1986.
  Random random(1);
  for (std::size_t i = lines_ - 1; i > 0; --i) std::swap(lines[i].next, lines[random.below(i)].next);
}

std::uint64_t RandomReads::advance(std::size_t count) {
  const Line* lines = memory_.data();
  for (std::size_t i = 0; i < count; ++i) at_ = lines[at_].next;
  return at_;
}

std::array<ReadRow, 2> random_read_rows() {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 30;
  return {{{"random_read/half_last_cache", llc_bytes() / 2, true},
           {"random_read/memory", std::min(llc_bytes() * 4, kMaxBytes), false}}};
}

}  // namespace edgewise::bench
