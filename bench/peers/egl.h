// OpenGL contexts of Mesa's llvmpipe without a window, one per thread count.
#pragma once

#include <string>

namespace edgewise::bench {

// Makes the context for 1 or 2 threads current. llvmpipe reads its thread count once per display, so each
// count has one of the two displays that EGL offers without a window: the software device (1), and the
// surfaceless platform (2, EGL_MESA_platform_surfaceless). Throws std::runtime_error if EGL or llvmpipe is
// missing.
void use_llvmpipe(int threads);

// Mesa's and LLVM's versions. Throws as use_llvmpipe does.
std::string llvmpipe_version();

}  // namespace edgewise::bench
