// Binning: lists for every cell of the image the triangles that may cover a pixel of it, in submission order.
//
// The triangles are cut into consecutive slices (slice_ranges.h). Slices are binned in parallel, each into
// its own lists. A cell's triangles are its lists of the first slice, the second …, which is the order of
// submission (rule 7), no matter which thread binned which slice.
//
// If a source makes the triangles while they are binned (triangle_source.h), only those that are listed as
// indices are kept.
//
// A list holds indices of triangles, in chained segments of two cache lines that are reused from frame to
// frame. Small triangles may become coverage masks instead (packet_sorter.cpp), stored by value in lists of
// their own (mask_lists.h). Each mask stores its rank among its cell's indices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/buffer.h"
#include "core/triangle_source.h"
#include "edgewise/screen_triangle.h"
#include "edgewise/simd_target.h"
#include "raster/binning/cell_boxes.h"
#include "raster/binning/mask_lists.h"
#include "raster/binning/packet_sorter.h"
#include "raster/binning/slice_ranges.h"

namespace edgewise {

class Bins {
 public:
  // Replaces the previous contents. A triangle without a sample in its bounding box is dropped; one without
  // area may be listed in up to four cells. `with_masks` needs cells that are tiles, and makes no masks on
  // the scalar target. Throws std::length_error if a slice's lists exceed 2^32 entries, and what
  // TriangleSource::finish() throws. Returns false, with incomplete contents, if there was no room for the
  // kept triangles: about twice the inputs until this happened once, then always enough.
  [[nodiscard]] bool build(TriangleSource& source, const CellGrid& grid, int threads, SimdTarget target,
                           bool with_masks);

  // Whether a triangle's position is not on the coarse grid. If so, kernels draw on the fine one
  // (core/grid.h).
  bool fine() const { return fine_; }

  // Indices refer to these triangles: the stored ones of the source, or those that were kept of it.
  const ScreenTriangle* triangles() const { return triangles_; }

  bool empty(int cell) const {
    const auto c = static_cast<std::size_t>(cell);
    for (const Slice* slice : in_order_)
      if (slice->first[c] != kNone || (has_masks_ && !slice->masks.empty(c))) return false;
    return true;
  }

  // Whether the cell lists at most `most` <= kIndicesPerSegment triangles, and has no masks.
  bool few(int cell, std::uint32_t most) const {
    const auto c = static_cast<std::size_t>(cell);
    std::uint64_t listed = 0;  // more than `most` where a slice has several segments: slots ascend
    for (const Slice* slice : in_order_) {
      if (slice->first[c] != kNone) listed += slice->cursor[c] - slice->first[c];
      if (listed > most || (has_masks_ && !slice->masks.empty(c))) return false;
    }
    return true;
  }

  static constexpr std::uint32_t kIndicesPerSegment = 31;
  // Consecutive indices of a cell: one segment of a list. `first_slot`: the slot of the first in the slice.
  struct Segment {
    std::span<const std::uint32_t> indices;
    std::size_t slice;
    std::uint32_t first_slot;
  };

  // Calls visit(segment) for the segments of a cell, in submission order. Triangles are scattered in memory,
  // so each segment's are prefetched while the previous segment is visited: without it, small triangles are
  // drawn 1.1× to 1.7× slower.
  template <typename Visit>
  void for_each_segment(int cell, Visit&& visit) const {
    const auto c = static_cast<std::size_t>(cell);
    Segment before{};
    for (std::size_t i = 0; i < in_order_.size(); ++i) {
      const Slice& slice = *in_order_[i];
      for (std::uint32_t slot = slice.first[c]; slot != kNone;) {
        const std::uint32_t segment_end = slot + kIndicesPerSegment;
        const bool last = slice.cursor[c] <= segment_end && slice.cursor[c] > slot;
        const std::uint32_t end = last ? slice.cursor[c] : segment_end;
        const Segment segment{{&slice.slots[slot], end - slot}, i, slot};
        prefetch_triangles(segment.indices);
        if (!before.indices.empty()) visit(before);
        before = segment;
        slot = last ? kNone : slice.slots[segment_end];
      }
    }
    if (!before.indices.empty()) visit(before);
  }

  // Reads the masks of a cell in submission order. The callback draw(masks, rank) draws the leading masks
  // whose rank is at most `rank`, and returns their number.
  class MaskReader {
   public:
    MaskReader(const Bins& bins, int cell) : bins_(bins), cell_(static_cast<std::size_t>(cell)) {
      if (!bins_.has_masks_) return;
      reader_ = {bins_.in_order_[0]->masks, cell_};
    }
    // Draws the remaining masks that precede triangle `index` of a segment.
    template <typename Draw>
    void draw_before(const Segment& segment, std::size_t index, Draw&& draw) {
      advance_to(segment.slice, segment.first_slot + static_cast<std::uint32_t>(index) + 1, draw);
    }
    template <typename Draw>
    void draw_rest(Draw&& draw) {
      advance_to(bins_.in_order_.size() - 1, kNone, draw);
    }

   private:
    template <typename Draw>
    void advance_to(std::size_t slice, std::uint32_t rank, Draw&& draw) {
      if (!bins_.has_masks_) return;
      for (; slice_ != slice; reader_ = {bins_.in_order_[++slice_]->masks, cell_})
        draw_up_to_rank(kNone, draw);
      draw_up_to_rank(rank, draw);
    }
    template <typename Draw>
    void draw_up_to_rank(std::uint32_t rank, Draw&& draw) {
      for (auto ahead = reader_.ahead(); !ahead.empty() && ahead.front().rank <= rank;
           ahead = reader_.ahead())
        reader_.pass(draw(ahead, rank));
    }

    const Bins& bins_;
    std::size_t cell_, slice_ = 0;
    MaskLists::Reader reader_;
  };

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr std::uint32_t kSlotsPerSegment = kIndicesPerSegment + 1;  // the last links to the next

  // Always inline: GCC 12 takes a function that only prefetches for one without effect, and drops its calls.
  [[gnu::always_inline]] void prefetch_triangles(std::span<const std::uint32_t> indices) const {
    for (const std::uint32_t index : indices) {
      const auto* triangle = reinterpret_cast<const char*>(triangles_ + index);
      __builtin_prefetch(triangle);
      __builtin_prefetch(triangle + sizeof(ScreenTriangle) - 1);
    }
  }

  // Aligned, so that threads that write to different slices share no cache line.
  struct alignas(64) Slice {
    std::vector<std::uint32_t> slots;          // segments of kSlotsPerSegment
    std::vector<std::uint32_t> first, cursor;  // for each cell: slot of its first segment, next slot to write
    std::uint32_t used = 0;                    // slots in use
    MaskLists masks;
    ScreenTriangle* kept = nullptr;  // where triangles that are binned as indices are kept; null: nowhere
    std::size_t next_kept = 0, end_kept = 0;  // the slice's room there
    bool fine = false;                        // as Bins::fine(), of this slice

    void reset(std::size_t cells);
    // Appends a segment to a list, at higher slots. `end_of_last`: the link slot of its last one, or kNone.
    std::uint32_t begin_segment(std::size_t cell, std::uint32_t end_of_last);
    void push(std::size_t cell, std::uint32_t index);
    void bin(const ScreenTriangle& triangle, const CellBox& box, std::uint32_t index, const CellGrid& grid);
    void bin_in_many(const ScreenTriangle& triangle, const CellBox& box, std::uint32_t index,
                     const CellGrid& grid);
    void bin_packet(const ScreenTriangle* packet, const SortedPacket& sorted, std::size_t begin,
                    const CellGrid& grid);
    void append(const SortedPacket& sorted, std::size_t n, std::size_t end);
  };

  // What all workers need to bin slices.
  struct Work;
  // Bins all inputs of a slice, until there is no room for kept triangles.
  void bin_slice(Work& work, int worker, std::size_t slice);

  std::vector<Slice> slices_;
  SliceRanges ranges_;
  std::vector<const Slice*> in_order_;
  Buffer<ScreenTriangle> kept_;
  std::size_t kept_per_input_ = 2;  // room for kept triangles
  const ScreenTriangle* triangles_ = nullptr;
  bool has_masks_ = false, fine_ = false;
};

}  // namespace edgewise
