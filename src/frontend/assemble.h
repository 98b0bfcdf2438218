// Triangles of a mesh from its transformed vertices. See assemble.cpp.
#pragma once

#include "edgewise/simd_target.h"
#include "frontend/tasks.h"

namespace edgewise {

// Appends what is visible of triangles begin … end - 1 to the output, with their index in the mesh as
// payload. Returns false and appends nothing if one of them names a vertex that the mesh lacks.
using AssembleKernel = bool (*)(const MeshTask& job, std::size_t begin, std::size_t end, RunOutput& out);

// `target` must be resolved.
AssembleKernel assemble_kernel(SimdTarget target);

}  // namespace edgewise
