// Joins pairs of triangles into faces of four vertices.
#pragma once

#include "edgewise/scene.h"

namespace edgewise {

// Joins triangles 0 and 1, 2 and 3, … of every mesh into faces with the colour of the first triangle. Each
// pair must be the halves p, q, s and q, r, s of a cell p, q, r, s, as in the built-in sphere and torus knot.
// The meshes must have no triangle flags.
void join_cells(Scene& scene);

}  // namespace edgewise
