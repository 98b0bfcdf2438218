// Compiles the methods' cover() with plots in lanes, once per SIMD target.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lab/coverage/simd/forms.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/kernel_table.h"
#include "lab/coverage/methods/dda_16_16.h"
#include "lab/coverage/methods/dda_float.h"
#include "lab/coverage/methods/dda_rounded.h"
#include "lab/coverage/simd/edges-inl.h"
#include "lab/coverage/simd/forms.h"
#include "lab/coverage/simd/lane_plot-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise::lab {
namespace HWY_NAMESPACE {

// Flattened, so that the code of a method, which is written once for all targets, is compiled for this one.
template <class Method>
HWY_FLATTEN void draw(const CoverageInput& input, Canvas& canvas) {
  draw_with<Method, LanePlot>(input, canvas);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise::lab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise::lab {

template <class Method>
DrawForm simd_forms(SimdTarget target) {
  return EDGEWISE_KERNEL(draw<Method>, target);
}

template DrawForm simd_forms<FloatLe>(SimdTarget);
template DrawForm simd_forms<FloatLt>(SimdTarget);
template DrawForm simd_forms<FloatTopLeft>(SimdTarget);
template DrawForm simd_forms<FloatSnapped>(SimdTarget);
template DrawForm simd_forms<FloatIncremental>(SimdTarget);
template DrawForm simd_forms<DoubleTopLeft>(SimdTarget);
template DrawForm simd_forms<FixedEdges<0, std::int64_t>>(SimdTarget);
template DrawForm simd_forms<FixedEdges<4, std::int64_t>>(SimdTarget);
template DrawForm simd_forms<FixedEdges<8, std::int64_t>>(SimdTarget);
template DrawForm simd_forms<FixedEdges<12, std::int64_t>>(SimdTarget);
template DrawForm simd_forms<FixedEdges<16, std::int64_t>>(SimdTarget);
template DrawForm simd_forms<FixedEdges<4, std::int32_t>>(SimdTarget);
template DrawForm simd_forms<FixedEdges<8, std::int32_t>>(SimdTarget);
template DrawForm simd_forms<DdaFloat>(SimdTarget);
template DrawForm simd_forms<Dda1616>(SimdTarget);
template DrawForm simd_forms<DdaRounded>(SimdTarget);

}  // namespace edgewise::lab
#endif
