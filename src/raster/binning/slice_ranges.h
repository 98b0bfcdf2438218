// Cuts inputs into consecutive slices that workers make and bin at the same time. A worker that has finished
// its slice splits another one, so that all end at about the same time, unless the rests are short.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace edgewise {

class SliceRanges {
 public:
  struct Inputs {
    std::size_t begin, end;
  };

  struct Slicing {
    std::size_t first, most;  // slices at first, of equal length, and after all splits
    std::size_t at_once;      // inputs that a worker takes of a slice at once
    std::size_t least_rest;   // the fewest inputs that a slice must have left to be split
  };

  // Cuts `count` inputs, less than 2^32 pieces of `at_once`.
  void start(std::size_t count, const Slicing& slicing);
  // Takes the next inputs of a slice, up to `at_once`. Returns nothing at its end. A slice has one worker.
  std::optional<Inputs> next(std::size_t slice);
  // Makes a slice of the second half of the longest rest of a slice, and returns it. Returns nothing if all
  // rests are too short, or there are `most` slices.
  std::optional<std::size_t> split();
  // The slices, by the order of their inputs. Call it when all workers are done.
  std::span<const std::size_t> in_order();

 private:
  // Pieces begin … end - 1 are left, 32 bits each. The alignment is that of Bins::Slice.
  struct alignas(64) Slice {
    std::atomic<std::uint64_t> left{0};
    std::size_t begin = 0;
    bool used = false;
  };
  void use(std::size_t slice, std::size_t begin, std::size_t end);

  std::vector<Slice> slices_;
  std::vector<std::size_t> order_;
  std::size_t next_ = 0;  // the next slice, if it is less than `most`; accessed atomically
  std::size_t count_ = 0;
  Slicing slicing_{};
};

}  // namespace edgewise
