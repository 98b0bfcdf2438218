// Draws triangles by edge functions, in a tile's buffer. frame_spans draws light tiles (raster/policy.h).
//
// 1. Depth and payload of the tile live in a buffer of 32 KB. With its lists a tile uses about 46 KB, which
//    fits an L1 cache of 48 KB; with one of 32 KB, part of it lies in L2. The buffer is stored to the frame
//    once. Only the buffer's depths are cleared: pixels whose depth is still clear get the background.
//    A tile that is drawn over is read into the buffer instead.
// 2. The buffer is stored in blocks of 4 x 4 pixels, 16 consecutive integers: one AVX-512 vector, two of
//    AVX2, four of SSE4 or NEON. 4 x 4 wastes fewer lanes on small triangles than 16 x 1.
// 3. Triangles are set up for the tile, a vector at a time (tile_setup-inl.h). An edge that accepts the
//    triangle's whole box becomes the constant 0; the others are stepped in int32 lanes (rule 5). Where
//    these do not suffice, on the fine grid, values are pairs of them (LongEdges).
// 4. Coarse rejection tests a row of blocks (tile_candidates-inl.h) or, for small boxes, a square of blocks
//    (tile_blocks-inl.h) at a time, one lane per block. Blocks outside an edge are rejected; in rows of
//    blocks, so are occluded ones (HiZ, hiz-inl.h). Triangles that are occluded in the whole tile skip the
//    test.
// 5. Candidate blocks go into lists, which are drawn in submission order (tile_painter-inl.h).
// 6. Small triangles arrive as coverage masks, made by binning (packet_sorter.cpp), and are drawn without a
//    branch (tile_painter-inl.h).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/edges/tile_edges.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/kernel_table.h"
#include "raster/edges/tile_painter-inl.h"
#include "raster/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

void draw_edges_in_tile(const TileTask& task) {
  task.bins.fine() ? draw_tile_in<ContractNumbers<Fine>>(task) : draw_tile_in<ContractNumbers<Coarse>>(task);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(TileKernel, tile_edges, draw_edges_in_tile)
#endif
