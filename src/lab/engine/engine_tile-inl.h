// The tile kernel with a policy of this folder.
#include <hwy/highway.h>

#include "lab/engine/engine_kernel.h"
#include "raster/tiled/tile_painter-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_ENGINE_TILE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_ENGINE_TILE_INL_H
#undef EDGEWISE_ENGINE_TILE_INL_H
#else
#define EDGEWISE_ENGINE_TILE_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

template <class Numbers>
void draw_engine_tile(const lab::EngineTask& task) {
  draw_tile_in<Numbers>(task);
}

template <class Numbers>
lab::EngineKernel kernel_of(bool reads_floats) {
  return {draw_engine_tile<Numbers>, Numbers::kMargin, reads_floats};
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif
