// For each cell of the image a list of coverage masks, in the order in which they were appended.
//
// Lists store masks by value, in chained blocks, so a tile reads consecutive cache lines. Longer lists have
// larger blocks, because each step to the next block costs a memory latency. Memory is kept from frame to
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
#include "raster/binning/coverage_mask.h"

namespace edgewise {

class MaskLists {
  struct Header;

 public:
  // Empties all lists. `masks`: expected number of masks, for the block size.
  void reset(std::size_t cells, std::size_t masks);
  // Appends a mask given in two halves. `rank` replaces the last field of the second.
  template <typename Half>
  void append(std::size_t cell, std::uint32_t rank, const Half& first, const Half& second) {
    List& list = lists_[cell];
    CoverageMask* at = list.end;
    if ((reinterpret_cast<std::uintptr_t>(at) & (block_bytes_ - 1)) == 0)
      at = add_block(list);  // full, or none yet
    std::memcpy(at, &first, sizeof first);
    std::memcpy(reinterpret_cast<char*>(at) + sizeof first, &second, sizeof second);
    at->rank = rank;
    __builtin_prefetch(reinterpret_cast<const char*>(at) + kCacheLine, 1);
    list.end = at + 1;
  }

  bool any() const { return used_ != 0; }
  std::size_t used_bytes() const { return used_; }
  bool empty(std::size_t cell) const { return lists_[cell].end == nullptr; }

  // Reads a list, a block at a time.
  class Reader {
   public:
    Reader() = default;
    Reader(const MaskLists& lists, std::size_t cell) : lists_(&lists), list_end_(lists.lists_[cell].end) {
      if (list_end_ != nullptr) enter(lists.lists_[cell].first);
    }
    // The unread masks of the current block; none at the end of the list.
    std::span<const CoverageMask> ahead() const { return {at_, block_end_}; }
    void pass(std::size_t count) {
      at_ += count;
      if (at_ == block_end_ && at_ != list_end_) enter(lists_->block_of(at_)->next);
    }

   private:
    // Also prefetches the block after the next.
    void enter(const Header* block) {
      at_ = begin_of(block);
      block_end_ = lists_->block_of(list_end_) == block ? list_end_ : lists_->end_of(block);
      if (block->next != nullptr && block->next->next != nullptr)
        prefetch_block(block->next->next, std::min(lists_->block_bytes_, kReadAhead));
    }

    const MaskLists* lists_ = nullptr;
    const CoverageMask *at_ = nullptr, *block_end_ = nullptr, *list_end_ = nullptr;
  };
  // Prefetches the beginning of a list.
  void prefetch_first(std::size_t cell) const {
    if (const Header* first = lists_[cell].first) prefetch_block(first, std::min(block_bytes_, kReadAhead));
  }

 private:
  static constexpr std::size_t kSmallestBlock = 256, kLargestBlock = 4096;  // bytes, powers of two
  static constexpr std::size_t kCacheLine = 64, kReadAhead = 1024;
  // At the beginning of a block, which is aligned to its size.
  struct alignas(sizeof(CoverageMask)) Header {
    Header* next;
  };
  struct alignas(kLargestBlock) Page {  // of a slab
    std::byte bytes[kLargestBlock];
  };
  struct List {
    Header* first = nullptr;
    CoverageMask* end = nullptr;
  };
  // The block of the mask before `at`, which must not be null.
  Header* block_of(const CoverageMask* at) const {
    return reinterpret_cast<Header*>((reinterpret_cast<std::uintptr_t>(at) - 1) & ~(block_bytes_ - 1));
  }
  static const CoverageMask* begin_of(const Header* block) {
    return reinterpret_cast<const CoverageMask*>(block + 1);
  }
  const CoverageMask* end_of(const Header* block) const {
    return reinterpret_cast<const CoverageMask*>(reinterpret_cast<const std::byte*>(block) + block_bytes_);
  }
  static void prefetch_block(const Header* block, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; i += kCacheLine)
      __builtin_prefetch(reinterpret_cast<const std::byte*>(block) + i);
  }

  CoverageMask* add_block(List& list);

  std::array<Buffer<Page>, 40> slabs_;                   // slab i has first_slab_ << i pages
  std::size_t first_slab_ = 1;                           // a power of two
  std::size_t block_bytes_ = kSmallestBlock, used_ = 0;  // bytes; used_ counts over all slabs in order
  std::vector<List> lists_;
};

}  // namespace edgewise
