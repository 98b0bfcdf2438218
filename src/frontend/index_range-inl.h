// The range of the vertices that a mesh's triangles name.
//
// Compiled once per SIMD target, like lanes-inl.h.
#if defined(EDGEWISE_FRONTEND_INDEX_RANGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_FRONTEND_INDEX_RANGE_INL_H
#undef EDGEWISE_FRONTEND_INDEX_RANGE_INL_H
#else
#define EDGEWISE_FRONTEND_INDEX_RANGE_INL_H
#endif

#include <algorithm>

#include "frontend/lanes-inl.h"
#include "frontend/mesh_clusters.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

// Of triangles begin … end - 1, at least one.
HWY_INLINE IndexRange index_range(const Mesh& mesh, std::size_t begin, std::size_t end) {
  const hn::RebindToUnsigned<DI> d;
  const std::uint32_t* index = &mesh.triangles[begin].x;
  const std::size_t count = 3 * (end - begin);
  auto least = hn::Set(d, index[0]), most = least;
  std::size_t i = 0;
  for (; i + kBatch <= count; i += kBatch) {
    const auto indices = hn::LoadU(d, index + i);
    least = hn::Min(least, indices), most = hn::Max(most, indices);
  }
  std::uint32_t leasts[kBatch], mosts[kBatch];
  hn::StoreU(least, d, leasts), hn::StoreU(most, d, mosts);
  IndexRange range{*std::min_element(leasts, leasts + kBatch), *std::max_element(mosts, mosts + kBatch)};
  for (; i < count; ++i) range = range.with({index[i], index[i]});
  return range;
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif
