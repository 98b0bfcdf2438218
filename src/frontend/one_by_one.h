// Handles a single triangle in any condition. The kernels process the common case in vectors and call
// add_one() for the rest:
// - all triangles of a vector in which one needs clipping or is not finite,
// - the last triangles of a chunk, too few for a vector,
// - every triangle with keep_unsnapped or keep_states.
#pragma once

#include "frontend/tasks.h"

namespace edgewise {

// Appends the visible pieces of a triangle to the output and counts them in its statistics. A mesh triangle's
// payload is its id, task.first_id plus its index in the mesh; a stream triangle's is the one that the
// options select.
void add_one(const MeshTask& task, std::size_t triangle, ChunkOutput& out);
void add_one(const StreamTask& task, std::size_t triangle, ChunkOutput& out);

}  // namespace edgewise
