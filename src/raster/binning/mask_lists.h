// For each cell of the image a list of coverage masks, in the order in which they were appended.
//
// Lists store masks by value, in chained segments, so a tile reads consecutive cache lines. Longer lists have
// larger segments, because each step to the next segment costs a memory latency. Memory is kept from frame to
// frame, and grows without moving masks.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/buffer.h"

namespace edgewise {

inline constexpr int kMaskSide = 8;  // px

// The pixels that a small triangle covers in 8 x 8 px of one tile and one depth cell, aligned to 4 px. Found
// during binning.
struct alignas(16) CoverageMask {
  std::uint32_t covered[2];  // pixels: bit 8 y + x, for the upper and the lower four rows
  std::uint32_t block;       // position of the first pixel in the tile: 16 y + x, in blocks of 4 x 4 px
  std::uint32_t payload;
  std::uint32_t z, zx, zy;  // depth (rule 6) at the first pixel, and steps per pixel
  // The next slot of its cell's indices (bins.h) when it was appended, plus 1; 0 if there were none. It is
  // drawn before the index in slot s if rank <= s + 1.
  std::uint32_t rank;
};
static_assert(sizeof(CoverageMask) == 32);

class MaskLists {
  struct Header;

 public:
  // Empties all lists. `masks`: expected number of masks, for the segment size.
  void reset(std::size_t cells, std::size_t masks);
  // Appends a mask given in two halves. `rank` replaces the last field of the second.
  template <typename Half>
  void append(std::size_t cell, std::uint32_t rank, const Half& first, const Half& second) {
    List& list = lists_[cell];
    CoverageMask* at = list.end;
    if ((reinterpret_cast<std::uintptr_t>(at) & (segment_bytes_ - 1)) == 0)
      at = add_segment(list);  // full, or none yet
    std::memcpy(at, &first, sizeof first);
    std::memcpy(reinterpret_cast<char*>(at) + sizeof first, &second, sizeof second);
    at->rank = rank;
    // Without it, grid4 is drawn 1.04x slower.
    __builtin_prefetch(reinterpret_cast<const char*>(at) + kCacheLine, 1);
    list.end = at + 1;
  }

  bool any() const { return used_ != 0; }
  std::size_t used_bytes() const { return used_; }
  bool empty(std::size_t cell) const { return lists_[cell].end == nullptr; }

  // Reads a list, a segment at a time.
  class Reader {
   public:
    Reader() = default;
    Reader(const MaskLists& lists, std::size_t cell) : lists_(&lists), list_end_(lists.lists_[cell].end) {
      if (list_end_ != nullptr) enter(lists.lists_[cell].first);
    }
    // The unread masks of the current segment; none at the end of the list.
    std::span<const CoverageMask> ahead() const { return {at_, segment_end_}; }
    void pass(std::size_t count) {
      at_ += count;
      if (at_ == segment_end_ && at_ != list_end_) enter(lists_->segment_of(at_)->next);
    }

   private:
    void enter(const Header* segment) {
      at_ = begin_of(segment);
      segment_end_ = lists_->segment_of(list_end_) == segment ? list_end_ : lists_->end_of(segment);
    }

    const MaskLists* lists_ = nullptr;
    const CoverageMask *at_ = nullptr, *segment_end_ = nullptr, *list_end_ = nullptr;
  };

 private:
  static constexpr std::size_t kSmallestSegment = 256, kLargestSegment = 4096;  // bytes, powers of two
  static constexpr std::size_t kCacheLine = 64;
  // At the beginning of a segment, which is aligned to its size.
  struct alignas(sizeof(CoverageMask)) Header {
    Header* next;
  };
  struct alignas(kLargestSegment) Page {  // of a slab
    std::byte bytes[kLargestSegment];
  };
  struct List {
    Header* first = nullptr;
    CoverageMask* end = nullptr;
  };
  // The segment of the mask before `at`, which must not be null.
  Header* segment_of(const CoverageMask* at) const {
    return reinterpret_cast<Header*>((reinterpret_cast<std::uintptr_t>(at) - 1) & ~(segment_bytes_ - 1));
  }
  static const CoverageMask* begin_of(const Header* segment) {
    return reinterpret_cast<const CoverageMask*>(segment + 1);
  }
  const CoverageMask* end_of(const Header* segment) const {
    return reinterpret_cast<const CoverageMask*>(reinterpret_cast<const std::byte*>(segment) +
                                                 segment_bytes_);
  }

  CoverageMask* add_segment(List& list);

  std::array<Buffer<Page>, 40> slabs_;                       // slab i has first_slab_ << i pages
  std::size_t first_slab_ = 1;                               // a power of two
  std::size_t segment_bytes_ = kSmallestSegment, used_ = 0;  // bytes; used_ counts over all slabs in order
  std::vector<List> lists_;
};

}  // namespace edgewise
