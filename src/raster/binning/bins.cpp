#include "raster/binning/bins.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <optional>
#include <stdexcept>

#include "core/parallel.h"
#include "edgewise/contract.h"

namespace edgewise {

using namespace contract;

void Bins::Slice::reset(std::size_t cells) {
  first.assign(cells, kNone);
  cursor.assign(cells, kNone);
  used = 0;
}

std::uint32_t Bins::Slice::begin_segment(std::size_t cell, std::uint32_t end_of_last) {
  if (used > kNone - kSlotsPerSegment)
    throw std::length_error("too many triangles over too many tiles for one frame");
  const std::uint32_t segment = used;
  used += kSlotsPerSegment;
  if (slots.size() < used) slots.resize(std::max<std::size_t>(used, slots.size() * 2));
  (end_of_last == kNone ? first[cell] : slots[end_of_last]) = segment;
  return segment;
}

inline void Bins::Slice::push(std::size_t cell, std::uint32_t index, bool is_candidate) {
  std::uint32_t slot = cursor[cell];
  // The segment is full, or there is none yet: kNone has the same low bits.
  if (slot % kSlotsPerSegment == kIndicesPerSegment) [[unlikely]] {
    if (!is_candidate) return;
    slot = begin_segment(cell, slot);
  }
  slots[slot] = index;
  cursor[cell] = slot + is_candidate;
}

inline void Bins::Slice::bin(const ScreenTriangle& triangle, std::uint32_t index, const CellBox& box,
                             int candidate_cells, const CellGrid& grid) {
  if (candidate_cells == 0) return bin_in_many(triangle, index, box, grid);
  const auto columns = static_cast<std::size_t>(grid.columns());
  const std::size_t upper = box.row0 * columns, lower = box.row1 * columns;
  if (candidate_cells == 0b0001) return push(upper + box.column0, index, true);
  push(upper + box.column0, index, candidate_cells & 0b0001);
  push(upper + box.column1, index, candidate_cells & 0b0010);
  push(lower + box.column0, index, candidate_cells & 0b0100);
  push(lower + box.column1, index, candidate_cells & 0b1000);
}

[[gnu::noinline]] void Bins::Slice::bin_in_many(const ScreenTriangle& triangle, std::uint32_t index,
                                                const CellBox& box, const CellGrid& grid) {
  const int column0 = box.column0, column1 = box.column1, row0 = box.row0, row1 = box.row1;
  const int columns = grid.columns();
  const auto cell_at = [&](int column, int row) { return static_cast<std::size_t>(row * columns + column); };
  const Oriented oriented = orient(triangle);
  if (oriented.area == 0) return;

  // An edge rejects a cell if it is negative at the corner sample where it is largest. The value at that
  // corner is stepped from cell to cell.
  const std::int32_t cell_w = 1 << grid.cell_w_log2, cell_h = 1 << grid.cell_h_log2;
  std::int64_t row_value[3], step_x[3], step_y[3];
  for (int i = 0; i < 3; ++i) {
    const Edge edge = make_edge(oriented, i);
    row_value[i] = edge.at(column0 * cell_w + (edge.a > 0 ? cell_w - 1 : 0),
                           row0 * cell_h + (edge.b > 0 ? cell_h - 1 : 0));
    step_x[i] = std::int64_t{edge.a} * kSub * cell_w;
    step_y[i] = std::int64_t{edge.b} * kSub * cell_h;
  }
  for (int row = row0; row <= row1; ++row) {
    std::int64_t value[3] = {row_value[0], row_value[1], row_value[2]};
    for (int column = column0; column <= column1; ++column) {
      if ((value[0] | value[1] | value[2]) >= 0) push(cell_at(column, row), index, true);
      for (int i = 0; i < 3; ++i) value[i] += step_x[i];
    }
    for (int i = 0; i < 3; ++i) row_value[i] += step_y[i];
  }
}

namespace {

// Replaces the masks of triangles that need more than two by cell boxes, so that they are binned as indices.
[[gnu::noinline]] void demote_to_boxes(SortedTriangles& sorted, const ScreenTriangle* packet,
                                       const CellGrid& grid) {
  std::size_t n = 0, kept = 0;
  for (std::uint64_t left = sorted.masked; left != 0; left &= left - 1, ++n) {
    if (std::popcount(sorted.quadrants[n]) > 2) {
      const auto k = static_cast<std::size_t>(std::countr_zero(left));
      sorted.masked ^= left & -left;
      sorted.boxed |= left & -left;
      sorted.boxes.set(k, box_in(grid, packet[k]), grid);
    } else {
      sorted.quadrants[kept] = sorted.quadrants[n];
      for (std::size_t w = 0; w < SortedTriangles::kQuadrants; ++w)
        sorted.first[w][kept] = sorted.first[w][n], sorted.second[w][kept] = sorted.second[w][n];
      ++kept;
    }
  }
}

// Calls sort(packet, index of its first triangle) for packets of kPacket triangles. Triangles without
// area fill up the last packet.
template <typename Sort>
void for_each_packet(std::span<const ScreenTriangle> triangles, Sort&& sort) {
  const std::size_t whole = triangles.size() / kPacket * kPacket;
  for (std::size_t i = 0; i < whole; i += kPacket) sort(triangles.data() + i, i);
  if (whole == triangles.size()) return;
  ScreenTriangle rest[kPacket] = {};
  std::copy(triangles.begin() + static_cast<std::ptrdiff_t>(whole), triangles.end(), rest);
  sort(rest, whole);
}

}  // namespace

// Bins the triangles of a packet whose bit in `boxed` is set, as indices. `begin`: index of the packet's
// first, ignored if triangles are kept.
void Bins::Slice::bin_boxed(const ScreenTriangle* packet, std::uint64_t boxed, const CellBoxes& boxes,
                            std::size_t begin, const CellGrid& grid) {
  for (std::uint64_t left = boxed; left != 0; left &= left - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(left));
    std::size_t index = begin + k;
    if (kept != nullptr) {
      kept[next_kept] = packet[k];
      index = next_kept++, ++kept_count;
    }
    bin(packet[k], static_cast<std::uint32_t>(index), boxes.box[k], boxes.candidate_cells[k], grid);
  }
}

// `begin`: index of the first triangle, ignored if triangles are kept.
void Bins::Slice::bin_as_indices(std::span<const ScreenTriangle> triangles, std::size_t begin,
                                 const CellGrid& grid, bool prefetch, CellBoxKernel find_boxes) {
  CellBoxes boxes;
  for_each_packet(triangles, [&](const ScreenTriangle* packet, std::size_t at) {
    bin_boxed(packet, find_boxes(packet, grid, prefetch, boxes), boxes, begin + at, grid);
  });
}

// Appends the masks of masked triangles n … end - 1 of a packet. One loop goes over the quadrants of eight
// triangles: a loop per triangle would be mispredicted, because the number of quadrants varies.
void Bins::Slice::append(const SortedTriangles& sorted, std::size_t n, std::size_t end) {
  for (; n < end; n += 8)
    for (std::uint32_t left = sorted.quadrants_of_eight(n, end); left != 0; left &= left - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(left));
      const std::size_t triangle = n + bit / SortedTriangles::kQuadrants,
                        w = bit % SortedTriangles::kQuadrants;
      const std::uint32_t cell = sorted.second[w][triangle].field[3];
      masks.append(cell, cursor[cell] + 1, sorted.first[w][triangle], sorted.second[w][triangle]);
    }
}

// `max_mask_bytes`: once masks take more, triangles that need more than two masks are binned as indices,
// which are slower to draw but take less memory.
void Bins::Slice::bin_with_masks(std::span<const ScreenTriangle> triangles, std::size_t begin,
                                 const CellGrid& grid, bool prefetch, MaskFinder find_masks,
                                 std::size_t max_mask_bytes) {
  SortedTriangles sorted;
  for_each_packet(triangles, [&](const ScreenTriangle* packet, std::size_t at) {
    find_masks(packet, grid, prefetch, sorted);
    // Scenes of large triangles skip the merge.
    if (sorted.masked == 0) return bin_boxed(packet, sorted.boxed, sorted.boxes, begin + at, grid);
    if (masks.used_bytes() > max_mask_bytes) [[unlikely]]
      demote_to_boxes(sorted, packet, grid);
    // Consecutive masked and consecutive boxed triangles, in turn, to keep the order of submission.
    std::size_t n = 0;
    const auto below_lowest = [](std::uint64_t bits) { return (bits & -bits) - 1; };  // all, if none is set
    for (std::uint64_t boxed = sorted.boxed, masked = sorted.masked; (boxed | masked) != 0;) {
      const std::uint64_t next_masked = masked & below_lowest(boxed);
      const std::size_t end = n + static_cast<std::size_t>(std::popcount(next_masked));
      append(sorted, n, end);
      n = end;
      masked ^= next_masked;
      const std::uint64_t next_boxed = boxed & below_lowest(masked);
      bin_boxed(packet, next_boxed, sorted.boxes, begin + at, grid);
      boxed ^= next_boxed;
    }
  });
}

struct Bins::Work {
  TriangleSource& source;
  const CellGrid& grid;
  const CellBoxKernel find_boxes;
  const MaskFinder find_masks;            // null: no masks
  const std::size_t cells, slices;        // of the grid; at first
  std::atomic<std::size_t> next_kept{0};  // the first free place in kept_
  std::atomic<bool> all_fit{true};
};

bool Bins::bin_slice(Work& work, int worker, std::size_t index) {
  // Together with triangles and frame, less than 100 bytes per small triangle and 16 per pixel.
  constexpr std::size_t kMaskBytesPerTriangle = 40, kMaskBytesPerPixel = 8;
  constexpr std::size_t kKeptAtOnce = 4 * TriangleSource::kInputsAtOnce;
  const CellGrid& grid = work.grid;
  const bool stored = work.source.stored() != nullptr;
  Slice& slice = slices_[index];
  slice.reset(work.cells);
  slice.kept = stored ? nullptr : kept_.data();
  slice.next_kept = slice.end_kept = slice.kept_count = 0;
  if (work.find_masks != nullptr) slice.masks.reset(work.cells, work.source.size() / work.slices);
  const std::size_t pixels = static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height);
  std::size_t max_mask_bytes = pixels * kMaskBytesPerPixel / slices_.size();
  while (const auto inputs = ranges_.next(index)) {
    const auto triangles = work.source.make(worker, inputs->begin, inputs->end);
    if (!stored && triangles.size() > slice.end_kept - slice.next_kept) {
      const std::size_t room = std::max(kKeptAtOnce, triangles.size());
      slice.next_kept = work.next_kept.fetch_add(room, std::memory_order_relaxed);
      slice.end_kept = slice.next_kept + room;
      if (slice.end_kept > kept_.capacity()) return false;
    }
    max_mask_bytes += (inputs->end - inputs->begin) * kMaskBytesPerTriangle;
    // Made triangles are still cached, so they are not prefetched.
    if (work.find_masks != nullptr)
      slice.bin_with_masks(triangles, inputs->begin, grid, stored, work.find_masks, max_mask_bytes);
    else
      slice.bin_as_indices(triangles, inputs->begin, grid, stored, work.find_boxes);
  }
  return true;
}

bool Bins::build(TriangleSource& source, const CellGrid& grid, int threads, SimdTarget target, Small small) {
  // Triangles per slice: a thousand large ones are worth two threads, but short lists leave SIMD lanes of the
  // tile kernel empty.
  constexpr std::size_t kMinSlice = 500;
  // List heads of all slices: 128 MB, or 384 MB with masks.
  constexpr std::size_t kMaxHeads = std::size_t{1} << 24;
  // Each further list of a cell costs a lookup and a partly filled segment.
  constexpr std::size_t kSlicesPerThread = 4;
  const std::size_t count = source.size(), workers = static_cast<std::size_t>(threads);
  const auto cells = static_cast<std::size_t>(grid.cells());
  const std::size_t affordable = std::max<std::size_t>(1, kMaxHeads / cells);
  const std::size_t first = std::clamp<std::size_t>(count / kMinSlice, 1, std::min(workers, affordable));
  const std::size_t most = first == 1 ? 1 : std::min(first * kSlicesPerThread, affordable);
  // Short enough to balance the slices.
  constexpr std::size_t kLongest = TriangleSource::kInputsAtOnce, kShortest = 4 * kPacket;
  const std::size_t share = count / (16 * first) / kPacket * kPacket,
                    at_once = first == 1 ? kLongest : std::clamp(share, kShortest, kLongest);
  if (slices_.size() < most) slices_.resize(most);
  ranges_.start(count, at_once, first, most);
  // Clipping may double the triangles. The memory is not touched before it is used.
  if (source.stored() == nullptr) kept_.reserve(2 * count + most * 7 * TriangleSource::kInputsAtOnce);
  triangles_ = source.stored() != nullptr ? source.stored() : kept_.data();
  const bool masks = small == Small::as_masks;
  Work work{source, grid, cell_box_kernel(target), masks ? mask_finder(target) : nullptr, cells, first};
  parallel_for(threads, static_cast<int>(first), [&](int worker) {
    for (std::optional slice{static_cast<std::size_t>(worker)}; slice; slice = ranges_.split())
      if (!bin_slice(work, worker, *slice)) {
        work.all_fit = false;
        return;
      }
  });
  if (!work.all_fit) return false;
  source.finish();
  in_order_.clear();
  in_order_.reserve(slices_.size());
  std::size_t records = source.stored() != nullptr ? count : 0;
  read_bytes_ = 0, has_masks_ = false;
  for (const std::size_t i : ranges_.in_order()) {
    const Slice& slice = slices_[i];
    in_order_.push_back(&slice);
    records += slice.kept_count;
    if (work.find_masks == nullptr) continue;
    has_masks_ |= slice.masks.any();
    read_bytes_ += slice.masks.used_bytes();
  }
  read_bytes_ += records * sizeof(ScreenTriangle);
  return true;
}

void Bins::build(std::span<const ScreenTriangle> triangles, const CellGrid& grid, int threads,
                 SimdTarget target, Small small) {
  StoredTriangles stored(triangles);
  (void)build(stored, grid, threads, target, small);
}

}  // namespace edgewise
