// Triangle streams on disk (.tri), little endian: "TRI1", uint32 width, height, count, then per triangle nine
// float32 (x, y, z of three vertices) and a uint32 colour. Units as in StreamTriangle. Any thread may call
// either, but only one at a time write to one std::ostream.
#pragma once

#include "edgewise/cxx20.h"

#include <filesystem>
#include <iosfwd>

#include "edgewise/scene.h"

namespace edgewise {

// Throws std::runtime_error, naming the file and what is wrong with it, for a file that is missing,
// truncated, too long for its count, of another format, of a size outside 1 … contract::kMaxImageSide, or of
// more than kMaxTriangles.
// Vertices of any value, NaN included, are read as they are: the front end judges them.
TriangleStream read_tri(const std::filesystem::path& path);

// Throws std::invalid_argument for a stream that read_tri would refuse. A failure to write is left in the
// state of `out`, or thrown if `out` throws.
void write_tri(std::ostream& out, const TriangleStream& stream);

}  // namespace edgewise
