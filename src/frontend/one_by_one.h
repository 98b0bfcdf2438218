// The way of a single triangle from clip space to the screen, whatever is wrong with it. The kernels take the
// common case by the vector, and come here for the rest: triangles that need clipping, the last few of a run,
// and all of them when the unsnapped positions are kept.
#pragma once

#include "frontend/tasks.h"

namespace edgewise {

void add_one(const MeshTask& job, std::size_t triangle, RunOutput& out);
void add_one(const StreamTask& job, std::size_t triangle, RunOutput& out);

}  // namespace edgewise
