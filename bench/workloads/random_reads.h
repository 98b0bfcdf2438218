// Pointer chasing: the latency of reads that no prefetcher can predict. Other processes share the last-level
// cache (LLC). When they fill it, code that visits a frame in random order waits for memory, while arithmetic
// takes no longer. The benchmark therefore times these reads between its rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/buffer.h"

namespace edgewise::bench {

// A buffer whose cache lines form one random cycle: each line holds the index of the next.
class RandomReads {
 public:
  // At least one line.
  explicit RandomReads(std::size_t bytes);
  std::size_t lines() const { return lines_; }
  // Reads the next `count` lines, and returns the index of the line after them.
  std::uint64_t advance(std::size_t count);

 private:
  struct alignas(64) Line {
    std::uint64_t next;
  };
  std::size_t lines_;
  Buffer<Line> memory_;  // in huge pages, so that TLB misses hardly count
  std::uint64_t at_ = 0;
};

struct ReadRow {
  std::string_view name;
  std::size_t bytes;  // of the buffer
  bool fits_cache;    // the LLC, if no other process uses it
};

// A buffer half as large as the LLC, and one of which the LLC can hold little.
std::array<ReadRow, 2> random_read_rows();

}  // namespace edgewise::bench
