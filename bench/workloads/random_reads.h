// Pointer chasing: how long reads take that no prefetcher can guess. A processor's last cache is everybody's:
// where others run beside us and fill it, whoever goes over a frame in no order waits for memory, while
// arithmetic is as fast as ever. So this is timed beside the rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/buffer.h"

namespace edgewise::bench {

// A buffer whose cache lines are read one after the other: each tells which is next, and all are in one cycle
// of random order.
class RandomReads {
 public:
  // At least one line.
  explicit RandomReads(std::size_t bytes);
  std::size_t lines() const { return lines_; }
  // Reads `count` lines more, and returns which is next.
  std::uint64_t go_on(std::size_t count);

 private:
  struct alignas(64) Line {
    std::uint64_t next;
  };
  std::size_t lines_;
  Buffer<Line> memory_;  // in huge pages, so that looking up pages hardly counts
  std::uint64_t at_ = 0;
};

struct ReadRow {
  std::string_view name;
  std::size_t bytes;  // of the buffer
  bool fits_cache;    // the last one, if nobody else uses it
};

// A buffer half as large as the last cache, and one that it can hold little of.
std::array<ReadRow, 2> random_read_rows();

}  // namespace edgewise::bench
