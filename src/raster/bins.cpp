#include "raster/bins.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "raster/contract.h"
#include "raster/parallel.h"

namespace edgewise {

using namespace contract;

void Bins::Chunk::reset(std::size_t cells) {
  first.assign(cells, kNone);
  cursor.assign(cells, kNone);
  used = 0;
}

void Bins::Chunk::push(std::size_t cell, std::uint32_t index) {
  std::uint32_t slot = cursor[cell];
  if (slot % kBlock == kRun) {  // a full block, or none yet (kNone ends in the same bits)
    if (used > kNone - kBlock)
      throw std::length_error("too many triangles over too many tiles for one frame");
    const std::uint32_t block = used;
    used += kBlock;
    if (slots.size() < used) slots.resize(std::max<std::size_t>(used, slots.size() * 2));
    (slot == kNone ? first[cell] : slots[slot]) = block;
    slot = block;
  }
  slots[slot] = index;
  cursor[cell] = slot + 1;
}

void Bins::bin(const ScreenTriangle& triangle, std::uint32_t index, const CellBox& box, const CellGrid& grid,
               Chunk& chunk) {
  const int column0 = box.column0, column1 = box.column1, row0 = box.row0, row1 = box.row1;
  const int columns = grid.columns();
  const auto cell_at = [&](int column, int row) { return static_cast<std::size_t>(row * columns + column); };

  // One or two cells: the tile's own test is as cheap as one here.
  if (column1 - column0 + row1 - row0 <= 1) {
    chunk.push(cell_at(column0, row0), index);
    if (column1 - column0 + row1 - row0 == 1) chunk.push(cell_at(column1, row1), index);
    return;
  }
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
      if ((value[0] | value[1] | value[2]) >= 0) chunk.push(cell_at(column, row), index);
      for (int i = 0; i < 3; ++i) value[i] += step_x[i];
    }
    for (int i = 0; i < 3; ++i) row_value[i] += step_y[i];
  }
}

void Bins::build(std::span<const ScreenTriangle> triangles, const CellGrid& grid, int threads,
                 SimdTarget target, const TiledIdeas& ideas) {
  // Triangles. A thousand large ones are worth sharing; but the shorter a cell's lists, the emptier the
  // vectors of who draws it.
  constexpr std::size_t kLeastChunk = 500;
  constexpr std::size_t kChunksPerThread = 4;
  constexpr std::size_t kMaxHeads = std::size_t{1} << 24;  // list heads of all chunks together: 128 MB
  const auto cells = static_cast<std::size_t>(grid.cells());
  const std::size_t most = threads == 1 ? 1 : kChunksPerThread * static_cast<std::size_t>(threads);
  const std::size_t affordable = std::max<std::size_t>(1, kMaxHeads / cells);
  used_chunks_ = std::clamp<std::size_t>(triangles.size() / kLeastChunk, 1, std::min(most, affordable));
  if (chunks_.size() < used_chunks_) chunks_.resize(used_chunks_);

  const CellBoxKernel find_boxes = cell_box_kernel(ideas.vector_setup ? target : SimdTarget::scalar);
  parallel_for(threads, static_cast<int>(used_chunks_), [&](int i) {
    const auto c = static_cast<std::size_t>(i);
    Chunk& chunk = chunks_[c];
    chunk.reset(cells);
    const std::size_t begin = triangles.size() * c / used_chunks_;
    const std::size_t end = triangles.size() * (c + 1) / used_chunks_;
    CellBox boxes[kBoxesAtOnce];
    for (std::size_t first = begin; first < end; first += kBoxesAtOnce) {
      const auto some = triangles.subspan(first, std::min<std::size_t>(kBoxesAtOnce, end - first));
      for (std::uint64_t left = find_boxes(some, grid, ideas.prefetch, boxes); left != 0; left &= left - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(left));
        bin(some[k], static_cast<std::uint32_t>(first + k), boxes[k], grid, chunk);
      }
    }
  });
}

}  // namespace edgewise
