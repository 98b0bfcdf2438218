#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lab/engine/real_engine.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/kernel_table.h"
#include "lab/engine/engine_kernel.h"
#include "lab/engine/engine_tile-inl.h"
#include "lab/engine/real_numbers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

lab::EngineKernel real_engine(lab::EngineNumbers numbers) {
  switch (numbers) {
    case lab::EngineNumbers::float_lt:
      return kernel_of<RealNumbers<FloatLanes, OnEdge::rejected, Vertices::unsnapped>>();
    case lab::EngineNumbers::float_le:
      return kernel_of<RealNumbers<FloatLanes, OnEdge::accepted, Vertices::unsnapped>>();
    case lab::EngineNumbers::float_snapped:
      return kernel_of<RealNumbers<FloatLanes, OnEdge::top_left, Vertices::snapped>>();
    case lab::EngineNumbers::float_top_left:
      return kernel_of<RealNumbers<FloatLanes, OnEdge::top_left, Vertices::unsnapped>>();
    case lab::EngineNumbers::float_rebased:
      return kernel_of<RealNumbers<FloatLanes, OnEdge::top_left, Vertices::rebased>>();
    case lab::EngineNumbers::double_top_left:
      return kernel_of<RealNumbers<DoubleLanes, OnEdge::top_left, Vertices::unsnapped>>();
    default:
      return {};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

lab::EngineKernel lab::real_engine_kernel(EngineNumbers numbers, SimdTarget target) {
  return EDGEWISE_KERNEL(real_engine, target)(numbers);
}

}  // namespace edgewise
#endif
