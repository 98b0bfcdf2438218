// Assembles a mesh's triangles from its transformed vertices. See assemble.cpp.
#pragma once

#include "edgewise/simd_target.h"
#include "frontend/mesh_clusters.h"
#include "frontend/tasks.h"

namespace edgewise {

// Appends the visible pieces of triangles begin … end - 1 to the output, with ids as payloads: task.first_id
// plus the triangle's index in the mesh. Returns false and appends nothing if a triangle names a vertex that
// is not `allowed`.
using AssembleKernel = bool (*)(const MeshTask& task, std::size_t begin, std::size_t end, VertexRange allowed,
                                ChunkOutput& out);

// `target` must be resolved.
AssembleKernel assemble_kernel(SimdTarget target);

}  // namespace edgewise
