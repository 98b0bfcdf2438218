// OpenGL contexts of Mesa's software drivers without a window, one per driver and thread count.
#pragma once

#include <string>
#include <string_view>

namespace edgewise::lab {

enum class MesaDriver { llvmpipe, softpipe };
std::string_view name_of(MesaDriver driver);

// Makes a driver's context current, and checks at each call that it is this driver's: llvmpipe's for 1 or 2
// threads, or softpipe's for 1. Throws std::runtime_error if EGL or the driver is missing.
void use_mesa(MesaDriver driver, int threads);

// The version of Mesa, and how the driver computes: "Mesa 22.3.6 (branch of 2022), LLVM
// 15.0.6, 256 bits". Throws as use_mesa
// does.
std::string mesa_version(MesaDriver driver);

}  // namespace edgewise::lab
