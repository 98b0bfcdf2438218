// Triangle streams on disk (.tri). The format is little endian: "TRI1", then uint32 width, height and count,
// then per triangle nine float32 (x, y, z of three vertices) and a uint32 colour. "TRI2" is the same with
// nine float64. Units are those of StreamTriangle. Any thread may call these functions, but two threads must
// not write to one std::ostream at once.
//
// Pixel (0, 0) is top left, its centre lies at (0.5, 0.5), and y points down. The smaller depth is nearer.
// The front of a triangle is the side whose vertices appear clockwise (camera.h).
#pragma once

#include "edgewise/cxx20.h"

#include <filesystem>
#include <iosfwd>

#include "edgewise/scene.h"

#pragma GCC visibility push(default)
namespace edgewise {

// Reads vertices of any value, NaN included, unchanged: the front end drops those it cannot draw. Throws
// std::runtime_error, with the file's name and the fault, if the file
// - cannot be opened or read, is truncated or of another format,
// - is longer than its count of triangles says,
// - has a width or height outside 1 … contract::kMaxImageSide,
// - or has more than kMaxTriangles triangles.
TriangleStream read_tri(const std::filesystem::path& path);

// Writes TRI1, or TRI2 if the stream has `exact` triangles. Throws std::invalid_argument for a stream that
// read_tri would reject, or with triangles of both kinds. A failed write sets the error state of `out`, and
// throws if `out` is set to throw.
void write_tri(std::ostream& out, const TriangleStream& stream);

}  // namespace edgewise
#pragma GCC visibility pop
