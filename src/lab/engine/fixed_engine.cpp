#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lab/engine/fixed_engine.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/kernel_table.h"
#include "lab/engine/depth_numbers-inl.h"
#include "lab/engine/engine_kernel.h"
#include "lab/engine/engine_tile-inl.h"
#include "lab/engine/fixed_numbers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

lab::EngineKernel fixed_engine(lab::EngineNumbers numbers) {
  switch (numbers) {
    case lab::EngineNumbers::exact:
      return kernel_of<ContractNumbers>();
    case lab::EngineNumbers::fixed_4_int32:
      return kernel_of<WrappingNumbers<4>>();
    case lab::EngineNumbers::fixed_8_int32:
      return kernel_of<WrappingNumbers<8>>();
    case lab::EngineNumbers::fixed_8_int64:
      return kernel_of<Int64Numbers>();
    case lab::EngineNumbers::depth_float:
      return kernel_of<DepthNumbers<FloatDepth>>();
    case lab::EngineNumbers::depth_24:
      return kernel_of<DepthNumbers<DepthOfBits<24>>>();
    case lab::EngineNumbers::depth_16:
      return kernel_of<DepthNumbers<DepthOfBits<16>>>();
    default:
      return {};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

lab::EngineKernel lab::fixed_engine_kernel(EngineNumbers numbers, SimdTarget target) {
  return EDGEWISE_KERNEL(fixed_engine, target)(numbers);
}

}  // namespace edgewise
#endif
