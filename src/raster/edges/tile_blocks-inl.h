// The tile's buffer, and the drawing of small triangles and of coverage masks.
//
// The buffer stores blocks of 4 x 4 pixels, each as 16 consecutive integers: one AVX-512 vector, two of AVX2,
// four of SSE4 or NEON.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "edgewise/contract.h"
#include "raster/binning/mask_lists.h"
#include "raster/edges/tile_setup-inl.h"
#include "raster/fill_counts.h"
#include "raster/simd/hiz-inl.h"
#include "raster/tile_store-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_TILE_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_BLOCKS_INL_H
#undef EDGEWISE_TILE_BLOCKS_INL_H
#else
#define EDGEWISE_TILE_BLOCKS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

constexpr int kVectors = kBlockPixels / kLanes;  // per block
static_assert(kMaxBlocks == kBlockPixels);       // a row of blocks fills as many vectors as a block

alignas(64) constexpr std::int32_t kLaneX[kBlockPixels] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr std::int32_t kLaneY[kBlockPixels] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

struct Tile {
  // A coverage mask at the end of a plane also reads and writes back blocks behind the plane.
  static constexpr int kSpare = (kMaxBlocks + 1) * kBlockPixels;
  static constexpr int kPixels = kMaxBlocks * kMaxBlocks * kBlockPixels + kSpare;
  alignas(64) std::int32_t depth[kPixels];  // block by block
  alignas(64) std::int32_t payload[kPixels];
  HiZ<kMaxBlocks, kMaxBlocks> hiz;
};

HWY_INLINE hn::Mask<D> not_negative(V v) {
  return hn::Gt(v, hn::Set(D{}, -1));
}

// Depth-tests a vector of a block's pixels and writes those that are covered and nearer. Stores whole
// vectors: in a mesh, the next small triangle often loads the same block, and a load cannot be forwarded from
// a masked store.
HWY_INLINE void write(Tile& tile, int at, hn::Mask<D> covered, V z, V payload) {
  const D d;
  const V old_z = hn::Load(d, tile.depth + at), old_payload = hn::Load(d, tile.payload + at);
  const auto wins = hn::And(covered, hn::Lt(z, old_z));
  hn::Store(hn::IfThenElse(wins, z, old_z), d, tile.depth + at);
  hn::Store(hn::IfThenElse(wins, payload, old_payload), d, tile.payload + at);
}

// The values of a linear function at the 16 pixels of a block, relative to the block's first pixel.
template <class Numbers>
struct Values16 {
  typename Numbers::Vector v[kVectors];
  HWY_INLINE Values16(typename Numbers::Value x, typename Numbers::Value y) {
    for (int p = 0; p < kVectors; ++p)
      v[p] = Numbers::add(Numbers::times(hn::Load(D{}, kLaneX + p * kLanes), x),
                          Numbers::times(hn::Load(D{}, kLaneY + p * kLanes), y));
  }
};

// A list to which the selected lanes of a vector are appended. The memory needs kLanes spare entries.
struct List {
  std::int32_t* at;
  int length = 0;
  HWY_INLINE void append(V v, hn::Mask<D> mask) {
    hn::StoreU(Selection(mask)(v), D{}, at + length);
    length += static_cast<int>(hn::CountTrue(D{}, mask));
  }
};

// Triangles whose boxes are at most 4 x 4 blocks. All blocks of a triangle are tested at once, one lane per
// block. The candidate blocks of many triangles go into one list: the number per triangle is hard to predict
// for a branch predictor, but a loop over a list is not.
template <class Numbers>
class SmallTriangles {
 public:
  static constexpr int kSide = 4;  // blocks
  explicit SmallTriangles(Tile& tile) : tile_(tile) {}

  HWY_INLINE void add(const Batch<Numbers>& batch, int k) {
    const D d;
    if (used_ == kSlots) draw();
    const int slot = used_++ * kBlockPixels;
    const V last_column = hn::Set(d, batch.bx1[k] - batch.bx0[k]),
            last_row = hn::Set(d, batch.by1[k] - batch.by0[k]);
    const auto in_block = [&](int i) { return Values16<Numbers>(batch.edge[i].x[k], batch.edge[i].y[k]); };
    const Values16<Numbers> edge_in[3] = {in_block(0), in_block(1), in_block(2)};
    const Values16<Int32Numbers> depth_in(batch.depth.x[k], batch.depth.y[k]);
    const int first_block = batch.by0[k] * kMaxBlocks + batch.bx0[k];
    for (int p = 0; p < kVectors; ++p) {
      const int lane = p * kLanes;
      // The blocks of the square are arranged like the pixels of a block, at four times the distance.
      const auto store_values = [&](auto numbers, auto offset, auto first, auto& values) {
        const auto at = numbers.add(numbers.set(first), numbers.four_times(offset));
        numbers.store_values(offset, values.in_block + slot + lane);
        numbers.store_values(at, values.at_block + slot + lane);
        return at;
      };
      const auto largest = [&](int i) {
        const auto at = store_values(Numbers{}, edge_in[i].v[p], batch.edge[i].first[k], edge_[i]);
        return Numbers::add(at, Numbers::set(batch.edge[i].rise[k]));
      };
      store_values(Int32Numbers{}, depth_in.v[p], batch.depth.first[k], depth_);
      const V column = hn::Load(d, kLaneX + lane), row = hn::Load(d, kLaneY + lane);
      const auto beside = hn::Or(hn::Gt(column, last_column), hn::Gt(row, last_row));
      const auto candidate = not_negative(Numbers::any_negative(largest(0), largest(1), largest(2)));
      const V block = hn::Add(hn::Mul(row, hn::Set(d, kMaxBlocks)), column);
      const V entry = hn::Add(hn::ShiftLeft<16>(block), counting_from(lane));
      list_.append(hn::Add(entry, hn::Set(d, first_block << 16 | slot)), hn::AndNot(beside, candidate));
    }
    payload_[slot / kBlockPixels] = batch.payload[k];
  }

  HWY_INLINE void draw() {
    for (int n = 0; n < list_.length; ++n) {
      const int block = list_.at[n] >> 16, in_slots = list_.at[n] & 0xFFFF, slot = in_slots / kBlockPixels;
      for (int p = 0; p < kVectors; ++p) {
        const auto value = [&](auto numbers, const auto& values) {
          return numbers.add(numbers.set(values.at_block[in_slots]),
                             numbers.load_values(values.in_block + slot * kBlockPixels + p * kLanes));
        };
        const auto edge = [&](int i) { return value(Numbers{}, edge_[i]); };
        write(tile_, block * kBlockPixels + p * kLanes,
              not_negative(Numbers::any_negative(edge(0), edge(1), edge(2))), value(Int32Numbers{}, depth_),
              hn::Set(D{}, payload_[slot]));
      }
    }
    used_ = list_.length = 0;
  }

 private:
  static constexpr int kSlots = 16;
  template <typename Value>
  struct alignas(64) SlotValues {
    Value at_block[kSlots * kBlockPixels], in_block[kSlots * kBlockPixels];
  };
  Tile& tile_;
  int used_ = 0;
  SlotValues<typename Numbers::Value> edge_[3];
  SlotValues<std::int32_t> depth_;
  std::int32_t payload_[kSlots];
  // the block in the tile << 16 | slot * 16 + the block's index in the square
  std::int32_t candidates_[(kSlots + 1) * kBlockPixels];
  List list_{candidates_};
};

// The bit of each pixel of a mask's left blocks in CoverageMask::covered.
alignas(64) constexpr auto kMaskBits = [] {
  std::array<std::int32_t, kBlockPixels> bits{};
  for (int i = 0; i < kBlockPixels; ++i)
    bits[static_cast<std::size_t>(i)] = 1 << (i / kBlockSide * kMaskSide + i % kBlockSide);
  return bits;
}();

constexpr std::ptrdiff_t kMasksAhead = 32;  // prefetch distance

// Draws masks up to the first with a rank above `last`, and returns their number. Writes all four blocks of
// every mask: a branch that skips blocks without a covered pixel would be mispredicted too often.
HWY_NOINLINE inline std::size_t draw_masks(Tile& tile, std::span<const CoverageMask> masks,
                                           std::uint32_t last) {
  const D d;
  static_assert(kMaskSide == 2 * kBlockSide);
  std::size_t n = 0;
  for (; n != masks.size() && masks[n].rank <= last; ++n) {
    const CoverageMask& mask = masks[n];
    hwy::Prefetch(&mask + kMasksAhead);
    const V zx = hn::Set(d, wrap(mask.zx)), zy = hn::Set(d, wrap(mask.zy));
    const V z0 = hn::Set(d, wrap(mask.z)), payload = hn::Set(d, wrap(mask.payload));
    const V right = hn::ShiftLeft<2>(zx), down = hn::ShiftLeft<2>(zy);
    const V rows[2] = {hn::Set(d, wrap(mask.covered[0])), hn::Set(d, wrap(mask.covered[1]))};
    for (int p = 0; p < kBlockPixels; p += kLanes) {
      const V left_bits = hn::Load(d, kMaskBits.data() + p),
              right_bits = hn::ShiftLeft<kBlockSide>(left_bits);
      V z = hn::Add(z0, hn::Add(hn::Mul(hn::Load(d, kLaneX + p), zx), hn::Mul(hn::Load(d, kLaneY + p), zy)));
      int at = static_cast<int>(mask.block) * kBlockPixels + p;
      for (int y = 0; y < 2; ++y) {
        write(tile, at, hn::TestBit(rows[y], left_bits), z, payload);
        write(tile, at + kBlockPixels, hn::TestBit(rows[y], right_bits), hn::Add(z, right), payload);
        z = hn::Add(z, down);
        at += kMaxBlocks * kBlockPixels;
      }
    }
  }
  count(Part::masks, n);
  return n;
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif
