// Screen triangles from a stream, whose positions are already in pixels. See stream.cpp.
#pragma once

#include "edgewise/simd_target.h"
#include "frontend/tasks.h"

namespace edgewise {

// Appends the visible pieces of triangles begin … end - 1 to the output, with the payload that the options
// select.
using StreamKernel = void (*)(const StreamTask& task, std::size_t begin, std::size_t end, ChunkOutput& out);

// `target` must be resolved.
StreamKernel stream_kernel(SimdTarget target);

}  // namespace edgewise
