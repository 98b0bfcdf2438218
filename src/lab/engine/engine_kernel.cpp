#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lab/engine/engine_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <stdexcept>

#include "core/kernel_table.h"
#include "lab/engine/engine_kernel.h"
#include "lab/engine/fixed_numbers-inl.h"
#include "lab/engine/real_numbers-inl.h"
#include "raster/tiled/tile_painter-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

using FloatLt = RealNumbers<FloatLanes, OnEdge::rejected, false>;
using FloatLe = RealNumbers<FloatLanes, OnEdge::accepted, false>;
using FloatTopLeft = RealNumbers<FloatLanes, OnEdge::top_left, false>;
using FloatRebased = RealNumbers<FloatLanes, OnEdge::top_left, true>;
using DoubleTopLeft = RealNumbers<DoubleLanes, OnEdge::top_left, false>;

template <class Numbers>
void draw_engine_tile(const lab::EngineTask& task) {
  draw_tile_in<Numbers>(task);
}

template <class Numbers>
constexpr bool kReadsFloats = false;
template <class Lanes, OnEdge kOnEdge, bool kRebased>
constexpr bool kReadsFloats<RealNumbers<Lanes, kOnEdge, kRebased>> = true;
template <class Numbers>
constexpr lab::EngineKernel kKernel{draw_engine_tile<Numbers>, Numbers::kMargin, kReadsFloats<Numbers>};

lab::EngineKernel kernel_with(lab::EngineNumbers numbers) {
  switch (numbers) {
    case lab::EngineNumbers::exact:
      return kKernel<ContractNumbers>;
    case lab::EngineNumbers::float_lt:
      return kKernel<FloatLt>;
    case lab::EngineNumbers::float_le:
      return kKernel<FloatLe>;
    case lab::EngineNumbers::float_top_left:
      return kKernel<FloatTopLeft>;
    case lab::EngineNumbers::float_rebased:
      return kKernel<FloatRebased>;
    case lab::EngineNumbers::fixed_4_int32:
      return kKernel<WrappingNumbers<4>>;
    case lab::EngineNumbers::fixed_8_int32:
      return kKernel<WrappingNumbers<8>>;
    case lab::EngineNumbers::fixed_8_int64:
      return kKernel<Int64Numbers>;
    case lab::EngineNumbers::double_top_left:
      return kKernel<DoubleTopLeft>;
  }
  throw std::invalid_argument("not numbers of the engine");
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

lab::EngineKernel lab::engine_kernel(EngineNumbers numbers, SimdTarget target) {
  return EDGEWISE_KERNEL(kernel_with, target)(numbers);
}

}  // namespace edgewise
#endif
