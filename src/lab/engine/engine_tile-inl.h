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

// The contract's numbers have no kReadsFloats.
template <class Numbers>
constexpr bool reads_floats() {
  if constexpr (requires { Numbers::kReadsFloats; })
    return Numbers::kReadsFloats;
  else
    return false;
}

template <class Numbers>
lab::EngineKernel kernel_of() {
  return {draw_engine_tile<Numbers>, Numbers::kMargin, reads_floats<Numbers>()};
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif
