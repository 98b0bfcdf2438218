#include "raster/binning/bins.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "core/parallel.h"
#include "edgewise/contract.h"

namespace edgewise {

using namespace contract;

void Bins::Chunk::reset(std::size_t cells) {
  first.assign(cells, kNone);
  cursor.assign(cells, kNone);
  used = 0;
}

std::uint32_t Bins::Chunk::begin_block(std::size_t cell, std::uint32_t end_of_last) {
  if (used > kNone - kBlock) throw std::length_error("too many triangles over too many tiles for one frame");
  const std::uint32_t block = used;
  used += kBlock;
  if (slots.size() < used) slots.resize(std::max<std::size_t>(used, slots.size() * 2));
  (end_of_last == kNone ? first[cell] : slots[end_of_last]) = block;
  return block;
}

inline void Bins::Chunk::push(std::size_t cell, std::uint32_t index, bool wanted) {
  std::uint32_t slot = cursor[cell];
  if (slot % kBlock == kRun) [[unlikely]] {  // a full block, or none yet (kNone ends in the same bits)
    if (!wanted) return;
    slot = begin_block(cell, slot);
  }
  slots[slot] = index;
  cursor[cell] = slot + wanted;
}

inline void Bins::Chunk::bin(const ScreenTriangle& triangle, std::uint32_t index, const CellBox& box,
                             int of_four, const CellGrid& grid) {
  if (of_four == 0) return bin_in_many(triangle, index, box, grid);
  const auto columns = static_cast<std::size_t>(grid.columns());
  const std::size_t upper = box.row0 * columns, lower = box.row1 * columns;
  if (of_four == 0b0001) return push(upper + box.column0, index, true);
  push(upper + box.column0, index, of_four & 0b0001);
  push(upper + box.column1, index, of_four & 0b0010);
  push(lower + box.column0, index, of_four & 0b0100);
  push(lower + box.column1, index, of_four & 0b1000);
}

[[gnu::noinline]] void Bins::Chunk::bin_in_many(const ScreenTriangle& triangle, std::uint32_t index,
                                                const CellBox& box, const CellGrid& grid) {
  const int column0 = box.column0, column1 = box.column1, row0 = box.row0, row1 = box.row1;
  const int columns = grid.columns();
  const auto cell_at = [&](int column, int row) { return static_cast<std::size_t>(row * columns + column); };
  const Oriented oriented = orient(triangle);
  if (oriented.area == 0) return;

  // An edge rejects a cell if even the sample where it is largest is outside. That corner's value steps
  // linearly.
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

// Takes back what was resolved of triangles that need more than two patches.
[[gnu::noinline]] void keep_short(SortedTriangles& sorted, const ScreenTriangle* some, const CellGrid& grid) {
  std::size_t n = 0, kept = 0;
  for (std::uint64_t left = sorted.masked; left != 0; left &= left - 1, ++n) {
    if (std::popcount(sorted.windows[n]) > 2) {
      const auto k = static_cast<std::size_t>(std::countr_zero(left));
      sorted.masked ^= left & -left;
      sorted.boxed |= left & -left;
      sorted.boxes.set(k, pixel_box(some[k], grid.width, grid.height), grid);
    } else {
      sorted.windows[kept] = sorted.windows[n];
      for (std::size_t w = 0; w < SortedTriangles::kQuadrants; ++w)
        sorted.first[w][kept] = sorted.first[w][n], sorted.second[w][kept] = sorted.second[w][n];
      ++kept;
    }
  }
}

// Calls sort(triangles + i, i) for every kBoxesAtOnce of them; empty triangles fill up what is missing.
template <typename Sort>
void in_batches(std::span<const ScreenTriangle> triangles, Sort&& sort) {
  const std::size_t whole = triangles.size() / kBoxesAtOnce * kBoxesAtOnce;
  for (std::size_t i = 0; i < whole; i += kBoxesAtOnce) sort(triangles.data() + i, i);
  if (whole == triangles.size()) return;
  ScreenTriangle rest[kBoxesAtOnce] = {};
  std::copy(triangles.begin() + static_cast<std::ptrdiff_t>(whole), triangles.end(), rest);
  sort(rest, whole);
}

}  // namespace

// Bins those of some triangles that `boxed` selects. `begin`: index of the first.
void Bins::Chunk::bin_boxed(const ScreenTriangle* some, std::uint64_t boxed, const CellBoxes& boxes,
                            std::size_t begin, const CellGrid& grid) {
  for (std::uint64_t left = boxed; left != 0; left &= left - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(left));
    bin(some[k], static_cast<std::uint32_t>(begin + k), boxes.box[k], boxes.of_four[k], grid);
  }
}

// `begin`: index of the first triangle.
void Bins::Chunk::bin_as_indices(std::span<const ScreenTriangle> triangles, std::size_t begin,
                                 const CellGrid& grid, bool prefetch, CellBoxKernel find_boxes) {
  CellBoxes boxes;
  in_batches(triangles, [&](const ScreenTriangle* some, std::size_t at) {
    bin_boxed(some, find_boxes(some, grid, prefetch, boxes), boxes, begin + at, grid);
  });
}

// Appends the patches of the n-th patched triangle to the one before the end-th. One loop for all of eight
// triangles, since no branch could guess how many windows each has.
void Bins::Chunk::append(const SortedTriangles& sorted, std::size_t n, std::size_t end) {
  for (; n < end; n += 8)
    for (std::uint32_t left = sorted.quadrants_of_eight(n, end); left != 0; left &= left - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(left));
      const std::size_t triangle = n + bit / SortedTriangles::kQuadrants,
                        w = bit % SortedTriangles::kQuadrants;
      const std::uint32_t cell = sorted.second[w][triangle].field[3];
      patches.append(cell, cursor[cell] + 1, sorted.first[w][triangle], sorted.second[w][triangle]);
    }
}

// `most_mask_bytes`: when patches have taken that much, triangles that need more than two become indices,
// which are slower to draw, but shorter.
void Bins::Chunk::bin_with_masks(std::span<const ScreenTriangle> triangles, std::size_t begin,
                                 const CellGrid& grid, bool prefetch, MaskFinder find_masks,
                                 std::size_t most_mask_bytes) {
  SortedTriangles sorted;
  in_batches(triangles, [&](const ScreenTriangle* some, std::size_t at) {
    find_masks(some, grid, prefetch, sorted);
    // A scene of large triangles shall not pay for patches.
    if (sorted.masked == 0) return bin_boxed(some, sorted.boxed, sorted.boxes, begin + at, grid);
    if (patches.used_bytes() > most_mask_bytes) [[unlikely]]
      keep_short(sorted, some, grid);
    // Runs of one kind and of the other, in turns.
    std::size_t n = 0;
    const auto below_lowest = [](std::uint64_t bits) { return (bits & -bits) - 1; };  // all, if none is set
    for (std::uint64_t boxed = sorted.boxed, masked = sorted.masked; (boxed | masked) != 0;) {
      const std::uint64_t patch_run = masked & below_lowest(boxed);
      const std::size_t end = n + static_cast<std::size_t>(std::popcount(patch_run));
      append(sorted, n, end);
      n = end;
      masked ^= patch_run;
      const std::uint64_t boxed_run = boxed & below_lowest(masked);
      bin_boxed(some, boxed_run, sorted.boxes, begin + at, grid);
      boxed ^= boxed_run;
    }
  });
}

void Bins::build(std::span<const ScreenTriangle> triangles, const CellGrid& grid, int threads,
                 SimdTarget target, Small small, bool prefetch) {
  // Triangles. A thousand large ones are worth sharing; but the shorter a cell's lists, the emptier the
  // vectors of who draws it.
  constexpr std::size_t kLeastChunk = 500;
  constexpr std::size_t kMaxHeads = std::size_t{1} << 24;  // of all chunks: 128 MB, 384 with patches
  // With the triangles themselves and the frame, less than 100 bytes a small triangle and 16 a pixel.
  constexpr std::size_t kPatchBytes = 40, kPatchBytesPerPixel = 8;
  const auto cells = static_cast<std::size_t>(grid.cells());
  // A chunk a thread: the more lists a cell has, the more of them have to be found, begun and left half full.
  const auto most = static_cast<std::size_t>(threads);
  const std::size_t pixels = static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height);
  const std::size_t affordable = std::max<std::size_t>(1, kMaxHeads / cells);
  used_chunks_ = std::clamp<std::size_t>(triangles.size() / kLeastChunk, 1, std::min(most, affordable));
  if (chunks_.size() < used_chunks_) chunks_.resize(used_chunks_);

  const CellBoxKernel find_boxes = cell_box_kernel(target);
  const MaskFinder find_masks = small == Small::as_masks ? mask_finder(target) : nullptr;
  if (find_masks != nullptr)
    partition_.cut_by_work(triangles, grid.width, grid.height, used_chunks_);
  else
    partition_.cut_equally(triangles.size(), used_chunks_);
  parallel_for(threads, static_cast<int>(used_chunks_), [&](int i) {
    const auto c = static_cast<std::size_t>(i);
    Chunk& chunk = chunks_[c];
    chunk.reset(cells);
    const std::size_t begin = partition_.bounds()[c];
    const auto some = triangles.subspan(begin, partition_.bounds()[c + 1] - begin);
    if (find_masks != nullptr) {
      chunk.patches.reset(cells, some.size());
      const std::size_t most_mask_bytes =
          some.size() * kPatchBytes + pixels * kPatchBytesPerPixel / used_chunks_;
      chunk.bin_with_masks(some, begin, grid, prefetch, find_masks, most_mask_bytes);
    } else {
      chunk.bin_as_indices(some, begin, grid, prefetch, find_boxes);
    }
  });
  has_masks_ = find_masks != nullptr &&
               std::any_of(chunks_.begin(), chunks_.begin() + static_cast<std::ptrdiff_t>(used_chunks_),
                           [](const Chunk& chunk) { return chunk.patches.any(); });
}

}  // namespace edgewise
