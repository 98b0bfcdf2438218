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

inline void Bins::Slice::push(std::size_t cell, std::uint32_t index) {
  std::uint32_t slot = cursor[cell];
  static_assert(kNone % kSlotsPerSegment == kIndicesPerSegment);  // so no segment yet counts as a full one
  if (slot % kSlotsPerSegment == kIndicesPerSegment) [[unlikely]]
    slot = begin_segment(cell, slot);
  slots[slot] = index;
  cursor[cell] = slot + 1;
}

// Tests the cells of large boxes only: testing 2 x 2 cells takes as long as the tiles' own rejection.
inline void Bins::Slice::bin(const ScreenTriangle& triangle, const CellBox& box, std::uint32_t index,
                             const CellGrid& grid) {
  if (box.column1 - box.column0 > 1 || box.row1 - box.row0 > 1)
    return bin_in_many(triangle, box, index, grid);
  for (int row = box.row0; row <= box.row1; ++row)
    for (int column = box.column0; column <= box.column1; ++column)
      push(static_cast<std::size_t>(row * grid.columns() + column), index);
}

// Inlined, it slows grid4 down 1.02x.
[[gnu::noinline]] void Bins::Slice::bin_in_many(const ScreenTriangle& triangle, const CellBox& box,
                                                std::uint32_t index, const CellGrid& grid) {
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
    step_x[i] = std::int64_t{edge.a} * kPixel_q15 * cell_w;
    step_y[i] = std::int64_t{edge.b} * kPixel_q15 * cell_h;
  }
  for (int row = row0; row <= row1; ++row) {
    std::int64_t value[3] = {row_value[0], row_value[1], row_value[2]};
    for (int column = column0; column <= column1; ++column) {
      if ((value[0] | value[1] | value[2]) >= 0) push(cell_at(column, row), index);
      for (int i = 0; i < 3; ++i) value[i] += step_x[i];
    }
    for (int i = 0; i < 3; ++i) row_value[i] += step_y[i];
  }
}

// Appends the masks of masked triangles n … end - 1 of a packet.
void Bins::Slice::append(const SortedPacket& sorted, std::size_t n, std::size_t end) {
  for (; n < end; ++n)
    for (unsigned left = sorted.quadrants[n]; left != 0; left &= left - 1) {
      const auto quadrant = static_cast<std::size_t>(std::countr_zero(left));
      const std::uint32_t cell = sorted.second[quadrant][n].field[3];
      masks.append(cell, cursor[cell] + 1, sorted.first[quadrant][n], sorted.second[quadrant][n]);
    }
}

namespace {

// Calls call(packet, index of its first triangle) for packets of kPacket triangles. Triangles without area
// fill up the last packet.
template <typename Call>
void for_each_packet(std::span<const ScreenTriangle> triangles, Call&& call) {
  const std::size_t whole = triangles.size() / kPacket * kPacket;
  for (std::size_t i = 0; i < whole; i += kPacket) call(triangles.data() + i, i);
  if (whole == triangles.size()) return;
  ScreenTriangle rest[kPacket] = {};
  std::copy(triangles.begin() + static_cast<std::ptrdiff_t>(whole), triangles.end(), rest);
  call(rest, whole);
}

}  // namespace

// Bins a packet. Runs of masked triangles and runs of boxed ones take turns, in order of submission, so that
// masks get their ranks. `begin`: index of its first triangle, ignored if triangles are kept.
void Bins::Slice::bin_packet(const ScreenTriangle* packet, const SortedPacket& sorted, std::size_t begin,
                             const CellGrid& grid) {
  std::size_t n = 0;                                                                // masked triangles so far
  const auto below_lowest = [](std::uint64_t bits) { return (bits & -bits) - 1; };  // all, if none is set
  for (std::uint64_t boxed = sorted.boxed, masked = sorted.masked; (boxed | masked) != 0;) {
    const std::uint64_t next_masked = masked & below_lowest(boxed);
    const std::size_t end = n + static_cast<std::size_t>(std::popcount(next_masked));
    append(sorted, n, end);
    n = end;
    masked ^= next_masked;
    const std::uint64_t next_boxed = boxed & below_lowest(masked);
    for (std::uint64_t left = next_boxed; left != 0; left &= left - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(left));  // in the packet
      std::size_t index = begin + k;
      if (kept != nullptr) {
        kept[next_kept] = packet[k];
        index = next_kept++;
      }
      bin(packet[k], sorted.box[k], static_cast<std::uint32_t>(index), grid);
    }
    boxed ^= next_boxed;
  }
}

namespace {

SliceRanges::Slicing slicing_of(std::size_t inputs, std::size_t cells, std::size_t threads) {
  // Triangles per slice: a thousand large ones are worth two threads (with 2000 here, large is drawn 1.25×
  // slower), but short lists leave SIMD lanes of the tile kernel empty.
  constexpr std::size_t kMinSlice = 500;
  // List heads of all slices: 128 MB, or 384 MB with masks.
  constexpr std::size_t kMaxHeads = std::size_t{1} << 24;
  // On two threads, terrain is drawn 1.35× slower without splits. But each further list of a cell costs a
  // lookup and a partly filled segment: if all rests are split, medium is drawn 1.06× slower. The more
  // threads share that cost, the shorter the rests that are worth it.
  constexpr std::size_t kSlicesPerThread = 4, kLeastRestPerCell = 16;
  // Short enough to balance the slices.
  constexpr std::size_t kLongest = TriangleSource::kInputsAtOnce, kShortest = 4 * kPacket;
  const std::size_t affordable = std::max<std::size_t>(1, kMaxHeads / cells);
  const std::size_t first = std::clamp<std::size_t>(inputs / kMinSlice, 1, std::min(threads, affordable));
  if (first == 1) return {1, 1, kLongest, 0};
  return {first, std::min(first * kSlicesPerThread, affordable),
          std::clamp(inputs / (16 * first) / kPacket * kPacket, kShortest, kLongest),
          kLeastRestPerCell * cells / first};
}

// A slice claims room for so many kept triangles at once. Of each claim but the last, less than a
// packet stays empty.
constexpr std::size_t kKeptAtOnce = 8192;

}  // namespace

struct Bins::Work {
  TriangleSource& source;
  const CellGrid& grid;
  const PacketSorter sort;
  const bool with_masks, stored;  // stored: not made, so not kept either
  const SliceRanges::Slicing slicing;
  std::atomic<std::size_t> next_kept{0};  // the first free place in kept_
  std::atomic<bool> all_fit{true};
};

void Bins::bin_slice(Work& work, int worker, std::size_t index) {
  // Together with triangles and frame, less than 100 bytes per small triangle and 16 per pixel.
  constexpr std::size_t kMaskBytesPerTriangle = 40, kMaskBytesPerPixel = 8;
  const CellGrid& grid = work.grid;
  const auto cells = static_cast<std::size_t>(grid.cells());
  const bool stored = work.stored;
  Slice& slice = slices_[index];
  slice.reset(cells);
  slice.kept = stored ? nullptr : kept_.data();
  slice.next_kept = slice.end_kept = 0;
  if (work.with_masks) slice.masks.reset(cells, work.source.size() / work.slicing.first);
  const std::size_t pixels = static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height);
  std::size_t max_mask_bytes = pixels * kMaskBytesPerPixel / work.slicing.most;
  SortedPacket sorted;
  while (const auto inputs = work.all_fit ? ranges_.next(index) : std::nullopt) {
    const auto triangles = work.source.make(worker, inputs->begin, inputs->end);
    max_mask_bytes += (inputs->end - inputs->begin) * kMaskBytesPerTriangle;
    for_each_packet(triangles, [&](const ScreenTriangle* packet, std::size_t at) {
      const bool with_masks = work.with_masks && slice.masks.used_bytes() <= max_mask_bytes;
      work.sort(packet, grid, with_masks, sorted);
      const auto boxed = static_cast<std::size_t>(std::popcount(sorted.boxed));
      if (!stored && boxed > slice.end_kept - slice.next_kept) {
        slice.next_kept = work.next_kept.fetch_add(kKeptAtOnce, std::memory_order_relaxed);
        slice.end_kept = slice.next_kept + kKeptAtOnce;
      }
      if (slice.end_kept <= kept_.capacity())
        slice.bin_packet(packet, sorted, inputs->begin + at, grid);
      else
        work.all_fit = false;
    });
  }
  slice.fine = sorted.fine;
}

bool Bins::build(TriangleSource& source, const CellGrid& grid, int threads, SimdTarget target,
                 bool with_masks) {
  const std::size_t count = source.size();
  const auto slicing =
      slicing_of(count, static_cast<std::size_t>(grid.cells()), static_cast<std::size_t>(threads));
  if (slices_.size() < slicing.most) slices_.resize(slicing.most);
  ranges_.start(count, slicing);
  const bool stored = source.stored() != nullptr || count == 0;
  // The memory is not touched before it is used.
  if (!stored) kept_.reserve(kept_per_input_ * count + slicing.most * kKeptAtOnce);
  triangles_ = stored ? source.stored() : kept_.data();
  Work work{source, grid, packet_sorter(target), with_masks, stored, slicing};
  parallel_for(threads, static_cast<int>(slicing.first), [&](int worker) {
    for (std::optional slice{static_cast<std::size_t>(worker)}; slice && work.all_fit;
         slice = ranges_.split())
      bin_slice(work, worker, *slice);
  });
  if (!work.all_fit) {
    kept_per_input_ = 8;  // clipping makes at most 7
    return false;
  }
  source.finish();
  in_order_.clear();
  in_order_.reserve(slices_.size());
  has_masks_ = fine_ = false;
  for (const std::size_t i : ranges_.in_order()) {
    in_order_.push_back(&slices_[i]);
    has_masks_ |= with_masks && slices_[i].masks.any();
    fine_ |= slices_[i].fine;
  }
  return true;
}

}  // namespace edgewise
