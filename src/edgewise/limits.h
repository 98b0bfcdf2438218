// Limits on counts and sizes. contract.h has those of images and coordinates. Functions check these limits
// before they allocate.
#pragma once

#include "edgewise/cxx20.h"

#include <cstddef>
#include <cstdint>

namespace edgewise {

inline constexpr int kMaxThreads = 256;  // per call of a front end or a backend
// Per frame, both before and after clipping.
inline constexpr std::size_t kMaxTriangles = std::size_t{1} << 30;

// Bytes. Vertex indices have 31 bits, and a vertex takes at least the 8 bytes of "v 0 0 0\n".
inline constexpr std::uint64_t kMaxObjBytes = std::uint64_t{8} << 31;

}  // namespace edgewise
