// Assembles a vector of mesh triangles at a time. The kernel loads and transposes their vertices, tests them
// against the sides of the view, and culls them by the sign of their area. If any triangle of the vector must
// be clipped or is not finite, one_by_one.cpp handles the whole vector.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "frontend/assemble.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// This needs Highway first.
#include "frontend/lanes-inl.h"

#include <algorithm>

#include "core/kernel_table.h"
#include "frontend/tasks.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

// Returns false and appends nothing if add_one() must handle these triangles.
HWY_INLINE bool assemble_vector(const MeshTask& task, std::size_t first, const Corners& corners,
                                std::size_t offset, ChunkOutput& out) {
  if (task.one_by_one()) return false;
  const D d;
  const std::uint32_t* index = &corners.indices[offset].x;
  const auto corner = [&](int k) HWY_ATTR {
    return load_words([&](int lane) { return corners.at(index[lane * 3 + k]); });
  };
  const Words a = corner(0), b = corner(1), c = corner(2);
  const V common = hn::And(a.word[3], hn::And(b.word[3], c.word[3]));
  const auto outside = hn::Ne(hn::And(common, hn::Set(d, kInvisible)), hn::Zero(d));
  const V any = hn::Or(a.word[3], hn::Or(b.word[3], c.word[3]));
  const auto special = hn::Ne(hn::And(any, hn::Set(d, kMustClip | kNotFinite)), hn::Zero(d));
  if (!hn::AllFalse(d, hn::AndNot(outside, special))) return false;
  cull_and_append({{a.word[0], b.word[0], c.word[0]},
                   {a.word[1], b.word[1], c.word[1]},
                   {a.word[2], b.word[2], c.word[2]},
                   counting_from(static_cast<int>(task.first_id + first))},
                  outside, task.options, out, task.mesh.flags.empty() ? nullptr : &task.mesh.flags[first]);
  return true;
}

void assemble(const MeshTask& task, std::size_t begin, std::size_t end, const Corners& corners,
              ChunkOutput& out) {
  const auto one_by_one = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const glm::uvec3 t = corners.indices[i - begin];
      add_one(task, i, {*corners.at(t.x), *corners.at(t.y), *corners.at(t.z)}, out);
    }
  };
  std::size_t i = begin;
  for (; i + kLanes <= end; i += kLanes)
    if (!assemble_vector(task, i, corners, i - begin, out)) one_by_one(i, i + kLanes);
  one_by_one(i, end);
}

IndexRange index_range(const Mesh& mesh, std::size_t begin, std::size_t end) {
  const hn::RebindToUnsigned<D> d;
  const std::uint32_t* index = &mesh.triangles[begin].x;
  const std::size_t count = 3 * (end - begin);
  auto least = hn::Set(d, index[0]), most = least;
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const auto indices = hn::LoadU(d, index + i);
    least = hn::Min(least, indices), most = hn::Max(most, indices);
  }
  std::uint32_t leasts[kLanes], mosts[kLanes];
  hn::StoreU(least, d, leasts), hn::StoreU(most, d, mosts);
  std::uint32_t first = *std::min_element(leasts, leasts + kLanes),
                last = *std::max_element(mosts, mosts + kLanes);
  for (; i < count; ++i) first = std::min(first, index[i]), last = std::max(last, index[i]);
  return {first, last};
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(AssembleKernel, assemble_kernel, assemble)
EDGEWISE_DEFINE_KERNEL(IndexRangeKernel, index_range_kernel, index_range)
#endif
