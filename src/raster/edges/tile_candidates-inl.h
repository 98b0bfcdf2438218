// Draws large triangles. Coarse rejection tests a row of blocks at once and lists the candidates, the blocks
// that are neither outside an edge nor occluded. Then the list is drawn: the number of blocks per triangle is
// hard to predict for a branch predictor, but a loop over a list is not.
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "edgewise/contract.h"
#include "raster/edges/tile_blocks-inl.h"
#include "raster/edges/tile_setup-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_TILE_CANDIDATES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_CANDIDATES_INL_H
#undef EDGEWISE_TILE_CANDIDATES_INL_H
#else
#define EDGEWISE_TILE_CANDIDATES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// Whether triangle k may cover a whole block: inside a triangle an edge value lies between 0 and twice the
// area, so its range over the block must not exceed that (claim may_fill_blocks in proofs/tile_reject.smt2).
template <class Numbers>
HWY_INLINE bool may_fill_blocks(const Batch<Numbers>& batch, int k) {
  const auto* edges = batch.coarse_edges(k);
  return std::none_of(edges, edges + 3, [&](const auto& edge) {
    if constexpr (Numbers::kHasLongEdges)
      if (batch.is_long(k)) return ContractNumbers<Coarse>::exceeds(edge.range[k], batch.twice_area_px2[k]);
    return Numbers::exceeds(edge.range[k], batch.twice_area_px2[k]);
  });
}

// A linear function of the pixel position, at the first pixels of a row of blocks, in kWidth vectors.
template <class Numbers, int kWidth>
struct Row {
  using Value = typename Numbers::Value;
  typename Numbers::Vector v[std::size_t{kWidth}], step;
  HWY_INLINE Row(const Linear<Value>& f, int k, typename Numbers::Vector first) {
    for (int p = 0; p < kWidth; ++p)
      v[p] = Numbers::add(first, Numbers::times(hn::ShiftLeft<2>(counting_from(p * kLanes)), f.x[k]));
    step = Numbers::times(hn::Set(D{}, kBlockSide), f.y[k]);
  }
  HWY_INLINE void next() {
    for (auto& value : v) value = Numbers::add(value, step);
  }
};

// The candidate blocks of triangle k of a batch, in the order of the tile's blocks. Offsets count blocks of
// the tile from the first block of the triangle's box.
struct Candidates {
  alignas(64) std::int32_t offset[kMaxBlocks * kMaxBlocks + kLanes];
  int length, k;
};

// Lists the candidate blocks of triangle k, whose box is at most kWidth vectors of blocks wide. With HiZ,
// also lowers the zmax of the blocks that it covers: there no pixel stays farther than its farthest depth.
template <class Numbers, bool kHiZ, int kWidth>
void find_candidates(Tile& tile, const Batch<Numbers>& batch, int k, Candidates& out) {
  const D d;
  const auto largest_in_block = [&](const auto& edge) {
    return Row<Numbers, kWidth>(edge, k,
                                Numbers::add(Numbers::set(edge.first[k]), Numbers::set(edge.rise[k])));
  };
  const auto* edges = batch.coarse_edges(k);
  Row<Numbers, kWidth> edge[3] = {largest_in_block(edges[0]), largest_in_block(edges[1]),
                                  largest_in_block(edges[2])};
  Row<Int32Numbers, kWidth> farthest(
      batch.depth, k, hn::Add(hn::Set(d, batch.depth.first[k]), hn::Set(d, batch.depth_rise[k])));
  Row<Int32Numbers, kWidth> nearest(batch.nearest, k, hn::Set(d, batch.nearest.first[k]));

  const V last_column = hn::Set(d, batch.bx1[k] - batch.bx0[k]);
  std::int32_t* zmax = tile.hiz.at(batch.bx0[k], batch.by0[k]);
  V row_offset = hn::Zero(d);
  List list{out.offset};
  for (int row = batch.by0[k]; row <= batch.by1[k]; ++row) {
    for (int p = 0; p < kWidth; ++p) {
      const V column = counting_from(p * kLanes), before_end = hn::Sub(last_column, column);
      const auto in_box = [&](V negative) { return not_negative(hn::Or(negative, before_end)); };
      auto candidate = in_box(Numbers::any_negative(edge[0].v[p], edge[1].v[p], edge[2].v[p]));
      if constexpr (kHiZ) {
        const auto smallest_in_block = [&](int i) {
          return Numbers::subtract(edge[i].v[p], Numbers::set(edges[i].range[k]));
        };
        const auto covered =
            in_box(Numbers::any_negative(smallest_in_block(0), smallest_in_block(1), smallest_in_block(2)));
        const V old_zmax = hn::LoadU(d, zmax + p * kLanes), own_zmax = farthest.v[p];
        hn::StoreU(hn::IfThenElse(covered, hn::Min(old_zmax, own_zmax), old_zmax), d, zmax + p * kLanes);
        candidate = hn::And(candidate, hn::Lt(nearest.v[p], old_zmax));
      }
      list.append(hn::Add(row_offset, column), candidate);
    }
    for (auto& e : edge) e.next();
    if constexpr (kHiZ) farthest.next(), nearest.next();
    zmax += kMaxBlocks, row_offset = hn::Add(row_offset, hn::Set(d, kMaxBlocks));
  }
  out.length = list.length, out.k = k;
}

// The values of triangle k's linear function at the pixels of kLanes blocks of a list at a time.
template <class Numbers>
class ValuesInBlocks {
 public:
  HWY_INLINE ValuesInBlocks(const Linear<typename Numbers::Value>& f, int k)
      : f_(f), k_(k), in_block_(f, k) {}
  // Goes on to the blocks that begin at pixels (x, y). Through memory: from AVX2 on, a load broadcasts a
  // value to all lanes without the execution units for arithmetic and shuffles, which are the bottleneck.
  HWY_INLINE void set_blocks(V x, V y) {
    const auto steps = Numbers::add(Numbers::times(x, f_.x[k_]), Numbers::times(y, f_.y[k_]));
    Numbers::store_values(Numbers::add(Numbers::set(f_.first[k_]), steps), first_);
  }
  struct Block {
    typename Numbers::Vector first;
    const Values16<Numbers>& in_block;
    HWY_INLINE auto at(int p) const { return Numbers::add(first, in_block.v[p]); }
  };
  HWY_INLINE Block block(int n) const { return {Numbers::set(first_[n]), in_block_}; }

 private:
  const Linear<typename Numbers::Value>& f_;
  const int k_;
  const Values16<Numbers> in_block_;
  alignas(64) typename Numbers::Value first_[kLanes];
};

// The same for edge i, where it is long.
class LongValuesInBlocks {
 public:
  HWY_INLINE LongValuesInBlocks(const LongEdges& edges, int i, int k)
      : upper_(edges.upper[i], k), lower_(edges.lower[i], k) {}
  HWY_INLINE void set_blocks(V x, V y) { upper_.set_blocks(x, y), lower_.set_blocks(x, y); }
  struct Block {
    ValuesInBlocks<Int32Numbers>::Block upper, lower;
    // Rounded down, so it has the value's sign.
    HWY_INLINE V at(int p) const {
      return hn::Add(upper.at(p), hn::ShiftRight<LongEdges::kLowerBits>(lower.at(p)));
    }
  };
  HWY_INLINE Block block(int n) const { return {upper_.block(n), lower_.block(n)}; }

 private:
  ValuesInBlocks<Int32Numbers> upper_, lower_;
};

// Draws a list of candidate blocks. `edge`: ValuesInBlocks of each edge.
template <class Numbers, class EdgeValues>
HWY_INLINE void draw_candidates(Tile& tile, const Batch<Numbers>& batch, const Candidates& candidates,
                                EdgeValues (&&edge)[3]) {
  const int length = candidates.length, k = candidates.k;
  const D d;
  ValuesInBlocks<Int32Numbers> depth(batch.depth, k);
  const V payload = hn::Set(d, batch.payload[k]);
  const int first_block = batch.by0[k] * kMaxBlocks + batch.bx0[k];
  for (int begin = 0; begin < length; begin += kLanes) {
    const V offset = hn::Load(d, candidates.offset + begin);
    static_assert(kMaxBlocks == 1 << 4);
    const V x = hn::ShiftLeft<2>(hn::And(offset, hn::Set(d, kMaxBlocks - 1)));
    const V y = hn::ShiftLeft<2>(hn::ShiftRight<4>(offset));
    for (EdgeValues& values : edge) values.set_blocks(x, y);
    depth.set_blocks(x, y);
    const int count = std::min(kLanes, length - begin);
    for (int n = 0; n < count; ++n) {
      const int block = first_block + candidates.offset[begin + n];
      const auto edge0 = edge[0].block(n), edge1 = edge[1].block(n), edge2 = edge[2].block(n);
      const auto z = depth.block(n);
      for (int p = 0; p < kVectors; ++p)
        depth_test(tile, block * kBlockPixels + p * kLanes,
                   not_negative(Numbers::any_negative(edge0.at(p), edge1.at(p), edge2.at(p))), z.at(p),
                   payload);
    }
  }
}

template <class Numbers>
void draw_candidates(Tile& tile, const Batch<Numbers>& batch, const Candidates& candidates) {
  const int k = candidates.k;
  if (candidates.length == 0) return;
  if constexpr (Numbers::kHasLongEdges)
    if (batch.is_long(k)) [[unlikely]] {
      const LongEdges& edges = batch.long_edges;
      return draw_candidates<Numbers, LongValuesInBlocks>(tile, batch, candidates,
                                                          {{edges, 0, k}, {edges, 1, k}, {edges, 2, k}});
    }
  draw_candidates<Numbers, ValuesInBlocks<Numbers>>(
      tile, batch, candidates, {{batch.edge[0], k}, {batch.edge[1], k}, {batch.edge[2], k}});
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif
