// Triangles of a stream, whose positions are pixels already. See stream.cpp.
#pragma once

#include "edgewise/simd_target.h"
#include "frontend/tasks.h"

namespace edgewise {

// Appends what is visible of triangles begin … end - 1 to the output, with its payload.
using StreamKernel = void (*)(const StreamTask& job, std::size_t begin, std::size_t end, RunOutput& out);

// `target` must be resolved.
StreamKernel stream_kernel(SimdTarget target);

}  // namespace edgewise
