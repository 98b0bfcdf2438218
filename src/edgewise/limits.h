// How large things may be, apart from what memory holds; contract.h has the limits of images and coordinates.
// Whoever allocates checks before it does.
#pragma once

#include "edgewise/cxx20.h"

#include <cstddef>
#include <cstdint>

namespace edgewise {

inline constexpr int kMaxThreads = 256;                             // of a draw or a front end
inline constexpr std::size_t kMaxTriangles = std::size_t{1} << 30;  // submitted to a frame, or drawn in one

// tinyobjloader counts vertices in an int, and a vertex takes at least the eight bytes of "v 0 0 0\n".
inline constexpr std::uint64_t kMaxObjBytes = std::uint64_t{8} << 31;

}  // namespace edgewise
