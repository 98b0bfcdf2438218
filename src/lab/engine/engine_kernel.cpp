#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lab/engine/engine_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <stdexcept>

#include "core/kernel_table.h"
#include "lab/engine/engine.h"
#include "lab/engine/other_numbers-inl.h"
#include "raster/tile_task.h"
#include "raster/tiled/tile_painter-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

TileKernel engine_tile(lab::EngineNumbers numbers) {
  switch (numbers) {
    case lab::EngineNumbers::int32:
      return draw_tile_in<OtherNumbers<Int32Arithmetic>>;
    case lab::EngineNumbers::int64:
      return draw_tile_in<OtherNumbers<WideLanes<std::int64_t>>>;
    case lab::EngineNumbers::float64:
      return draw_tile_in<OtherNumbers<WideLanes<double>>>;
    case lab::EngineNumbers::float32:
      return draw_tile_in<OtherNumbers<FloatLanes>>;
    case lab::EngineNumbers::float32_rebased:
      return draw_tile_in<OtherNumbers<FloatLanes, true>>;
    default:
      throw std::invalid_argument("not other numbers of the engine");
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

TileKernel lab::engine_kernel(EngineNumbers numbers, SimdTarget target) {
  return numbers == EngineNumbers::exact ? tile_kernel(target)
                                         : EDGEWISE_KERNEL(engine_tile, target)(numbers);
}

}  // namespace edgewise
#endif
