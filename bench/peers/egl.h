// OpenGL contexts of Mesa's llvmpipe without any window (EGL_MESA_platform_surfaceless), one for each number
// of threads.
#pragma once

#include <string>

namespace edgewise::bench {

// Makes the context of a number of threads (1 or 2) the current one. llvmpipe reads its thread count where a
// display is opened, once for each; so the two counts live on the two displays that EGL has without a window:
// the surfaceless platform, and the software device. Throws std::runtime_error where EGL or llvmpipe is
// missing.
void use_llvmpipe(int threads);

// Mesa's and LLVM's versions.
std::string llvmpipe_version();

}  // namespace edgewise::bench
