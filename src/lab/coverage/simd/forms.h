// The SIMD forms of coverage methods.
#pragma once

#include "lab/coverage/plot.h"

namespace edgewise::lab {

// A method's form for a resolved target. forms.cpp instantiates it for each method with a SIMD form.
template <class Method>
DrawForm simd_forms(SimdTarget target);

}  // namespace edgewise::lab
