#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lab/engine/engine_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <stdexcept>

#include "core/kernel_table.h"
#include "lab/engine/engine.h"
#include "lab/engine/other_arithmetic-inl.h"
#include "raster/edges/tile_painter-inl.h"
#include "raster/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

TileKernel engine_tile(lab::EngineArithmetic arithmetic) {
  switch (arithmetic) {
    case lab::EngineArithmetic::int32:
      return draw_tile_in<OtherNumbers<Int32Numbers>>;
    case lab::EngineArithmetic::int64:
      return draw_tile_in<OtherNumbers<WideNumbers<std::int64_t>>>;
    case lab::EngineArithmetic::float64:
      return draw_tile_in<OtherNumbers<WideNumbers<double>>>;
    case lab::EngineArithmetic::float32:
      return draw_tile_in<OtherNumbers<FloatNumbers>>;
    case lab::EngineArithmetic::float32_rebased:
      return draw_tile_in<OtherNumbers<FloatNumbers, true>>;
    default:
      throw std::invalid_argument("not another arithmetic of the engine");
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

TileKernel lab::engine_kernel(EngineArithmetic arithmetic, SimdTarget target) {
  return arithmetic == EngineArithmetic::exact ? tile_edges(target)
                                               : EDGEWISE_KERNEL(engine_tile, target)(arithmetic);
}

}  // namespace edgewise
#endif
