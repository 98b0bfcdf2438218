// Selects the kernel for a SIMD target from the copies of a function that foreach_target compiled.
#pragma once

#include <hwy/highway.h>

#include "edgewise/simd_target.h"

#ifdef __AVX__
#error "CMakeLists.txt must compile this file with kernel_options"
#endif

// The kernel for a resolved target, as a function pointer. Use where HWY_ONCE is set, in the namespace that
// encloses HWY_NAMESPACE. It is never null: supported_targets() lists only targets that were compiled, and a
// build without the scalar kernels doesn't compile.
#define EDGEWISE_KERNEL(function, target)                                 \
  ((target) == ::edgewise::SimdTarget::avx512 ? HWY_CHOOSE_AVX3(function) \
   : (target) == ::edgewise::SimdTarget::avx2 ? HWY_CHOOSE_AVX2(function) \
   : (target) == ::edgewise::SimdTarget::sse4 ? HWY_CHOOSE_SSE4(function) \
   : (target) == ::edgewise::SimdTarget::neon ? HWY_CHOOSE_NEON(function) \
                                              : &N_SCALAR::function)

// Defines the function `name`, which returns the kernel for a resolved target. Use where HWY_ONCE is set,
// outside of namespaces.
#define EDGEWISE_DEFINE_KERNEL(Kernel, name, function) \
  namespace edgewise {                                 \
  Kernel name(SimdTarget target) {                     \
    return EDGEWISE_KERNEL(function, target);          \
  }                                                    \
  }
