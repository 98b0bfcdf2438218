// Cells of two triangles → faces of four vertices.
#pragma once

#include "edgewise/scene.h"

namespace edgewise {

// Makes each two triangles in a row of the scene's meshes one face, of the first one's colour. They must be
// the halves p, q, s and q, r, s of a cell p, q, r, s, as those of the built-in sphere and torus knot are,
// and have no marks.
void join_cells(Scene& scene);

}  // namespace edgewise
