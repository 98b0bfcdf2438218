// Tests the pixels of triangles' boxes by edge functions, in the frame itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/edges/frame_edges.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "core/grid.h"
#include "core/kernel_table.h"
#include "edgewise/contract.h"
#include "raster/frame_lanes-inl.h"
#include "raster/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// Shifted edge values (rule 5) of a vector of pixels, stepped from row to row; sign_bit() has their signs.
// `first`: at the pixels' position 0; a, b: the steps to the right and down.
//
// For steps of at most kShort, that is, on the coarse grid always, a first value may be clamped to kLimit. In
// a depth cell and a vector of pixels beside it, 79 px to the side and 32 down, values change by at most 111
// * 2^23 < 2^30, so a clamped one keeps its sign, and does not overflow.
constexpr std::int32_t kShort = 2 * Coarse::kGuardSub;
constexpr std::int64_t kLimit = 1 << 30;
struct ShortEdge {
  V value, down;
  HWY_INLINE ShortEdge(std::int64_t first, std::int32_t a, std::int32_t b, int px) : down(hn::Set(D{}, b)) {
    value =
        hn::Add(hn::Set(D{}, static_cast<std::int32_t>(first)), hn::Mul(counting_from(px), hn::Set(D{}, a)));
  }
  HWY_INLINE V sign_bit() const { return value; }
  HWY_INLINE void next() { value = hn::Add(value, down); }
};
// Any steps: a value is 2^31 high + low, 0 <= low < 2^31.
struct LongEdge {
  V high, low, down_high, down_low;
  HWY_INLINE LongEdge(std::int64_t first, std::int32_t a, std::int32_t b, int px)
      : down_high(hn::Set(D{}, b >> 31)), down_low(hn::Set(D{}, b & 0x7FFFFFFF)) {
    alignas(64) std::int32_t highs[kLanes], lows[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      const std::int64_t value = first + std::int64_t{a} * (px + i);
      highs[i] = static_cast<std::int32_t>(value >> 31),
      lows[i] = static_cast<std::int32_t>(value & 0x7FFFFFFF);
    }
    high = hn::Load(D{}, highs), low = hn::Load(D{}, lows);
  }
  HWY_INLINE V sign_bit() const { return high; }
  HWY_INLINE void next() {
    low = hn::Add(low, down_low);  // wraps if it exceeds 31 bits
    high = hn::Sub(hn::Add(high, down_high), hn::ShiftRight<31>(low));
    low = hn::And(low, hn::Set(D{}, 0x7FFFFFFF));
  }
};

template <class G>
struct FrameEdges : FrameBatch {
  struct {
    std::int64_t first[kBatch];    // biased value (rule 4) at the box's first sample
    std::int32_t clamped[kBatch];  // the same for ShortEdge: shifted (rule 5) and clamped, a vector at once
    std::int32_t a[kBatch], b[kBatch];  // steps of shifted values per pixel
  } edge[3];
  std::uint32_t is_long = 0;  // bit k: triangle k has an edge for LongEdge

  HWY_INLINE std::uint32_t set_up(const FrameTask& task, const std::uint32_t* indices, int k) {
    const auto t = load<G>(task.bins.triangles(), indices);
    const BoxLanes boxes(t, task.region);
    const Area area = area_of(t);
    V longest = hn::Zero(D{});  // unused on the coarse grid
    for (int i = 0; i < 3; ++i) {
      const EdgeLanes lanes(t, area, i, sample<G>(boxes.x0), sample<G>(boxes.y0));
      const V64 limit = hn::Set(D64{}, kLimit), shifted = hn::ShiftRight<G::kSubBits>(lanes.value);
      hn::StoreU(lanes.value, D64{}, edge[i].first + k);
      store(lower(hn::Min(hn::Max(shifted, hn::Neg(limit)), limit)), edge[i].clamped + k);
      store(lanes.a, edge[i].a + k), store(lanes.b, edge[i].b + k);
      longest = hn::Max(longest, hn::Max(hn::Abs(lanes.a), hn::Abs(lanes.b)));
    }
    if constexpr (std::is_same_v<G, Fine>) is_long |= lower_bits(hn::Gt(longest, hn::Set(D{}, kShort))) << k;
    return store_vector(t, boxes, area, task, indices, k);
  }

  HWY_INLINE void draw(const FrameTask& task, int k, const ScreenTriangle& triangle) const {
    count(Part::frame_edges);
    if constexpr (std::is_same_v<G, Fine>)
      if (is_long >> k & 1) return draw_cells<LongEdge>(task, k, triangle.payload);
    draw_cells<ShortEdge>(task, k, triangle.payload);
  }

 private:
  // Draws the parts of the triangle's box that lie in one depth cell (rule 6) each.
  template <class EdgeOfPixels>
  HWY_INLINE void draw_cells(const FrameTask& task, int k, std::uint32_t payload) const {
    for (int x = x0[k], end; x < x1[k]; x = end) {
      end = std::min(x1[k], (x & -kDepthCell) + kDepthCell);
      draw_cell<EdgeOfPixels>(task, k, x, end, payload);
    }
  }
  // The first value of edge i at pixel x.
  template <class EdgeOfPixels>
  HWY_INLINE std::int64_t first_at(int i, int k, int x) const {
    constexpr bool kClamps = std::is_same_v<EdgeOfPixels, ShortEdge>;
    if (kClamps && x == x0[k]) return edge[i].clamped[k];
    const std::int64_t value = (edge[i].first[k] >> G::kSubBits) + std::int64_t{edge[i].a[k]} * (x - x0[k]);
    return kClamps ? std::clamp(value, -kLimit, kLimit) : value;
  }
  // Draws pixels begin … end - 1 of the box's rows, column by column of vectors.
  template <class EdgeOfPixels>
  HWY_INLINE void draw_cell(const FrameTask& task, int k, int begin, int end, std::uint32_t payload) const {
    const D d;
    const V lane = hn::Iota(d, 0), payloads = set(payload), z_right = hn::Set(d, zx[k]),
            z_down = hn::Set(d, zy[k]);
    const V z_in_first = set(z_in_cell(k, begin, y0[k])), cell_x = hn::Set(d, begin & -kDepthCell);
    std::int64_t first[3];
    for (int i = 0; i < 3; ++i) first[i] = first_at<EdgeOfPixels>(i, k, begin);
    for (int x = begin; x < end; x += kLanes) {
      const int at = vector_from(x, task.region.x1);
      const V px = hn::Add(lane, hn::Set(d, at));
      const auto in_range = between(x, px, end);
      const auto edge_at = [&](int i) {
        return EdgeOfPixels(first[i], edge[i].a[k], edge[i].b[k], at - begin);
      };
      EdgeOfPixels value[3] = {edge_at(0), edge_at(1), edge_at(2)};
      V z = hn::Add(z_in_first, hn::Mul(hn::Sub(px, cell_x), z_right));
      FrameRow row(task.frame, y0[k]);
      for (int y = y0[k]; y < y1[k]; ++y) {
        const V any_negative = hn::Or(hn::Or(value[0].sign_bit(), value[1].sign_bit()), value[2].sign_bit());
        const auto covered = hn::And(in_range, hn::Gt(any_negative, hn::Set(d, -1)));
        write(row.depth + at, row.payload + at, covered, z, payloads);
        for (EdgeOfPixels& v : value) v.next();
        z = hn::Add(z, z_down);
        row.depth += task.frame.stride, row.payload += task.frame.stride;
      }
    }
  }
};

void draw_edges_in_frame(const FrameTask& task) {
  task.bins.fine() ? draw_in_batches<FrameEdges<Fine>>(task) : draw_in_batches<FrameEdges<Coarse>>(task);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(FrameKernel, frame_edges, draw_edges_in_frame)
#endif
