// Wavefront OBJ meshes. Part of edgewise::files. Any thread may call this.
//
// Pixel (0, 0) is top left, its centre lies at (0.5, 0.5), and y points down. The smaller depth is nearer.
// The front of a triangle is the side whose vertices appear clockwise (camera.h).
#pragma once

#include "edgewise/cxx20.h"

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "edgewise/scene.h"

#pragma GCC visibility push(default)
namespace edgewise {

struct ObjOptions {
  // Leaves the mesh near 0: its origin stays 0. For coordinates of a survey, say.
  bool recentre = false;
};

struct ObjReport {
  glm::dvec3 offset{0.0};  // subtracted from all positions of the file; they are rounded to float after that
  // What a user should know though the file can be drawn, one line each, which starts with the file's name:
  // materials that are missing, faces that are skipped, colours that are scaled.
  std::vector<std::string> warnings;
};

// A scene of one mesh, with a camera placed by frame_camera.
// - Polygons of any size are triangulated; their triangles share one normal (face_normal). Faces of one or
//   two corners are skipped, and those whose filling would take too long:
//   the faces of a file share 200,000,000 steps (about 8 s), and 16 for each of their corners.
// - Negative (relative) indices are resolved.
// - Windings are reversed: the front is counter-clockwise in OBJ and clockwise here.
// - A face has the mean colour of its vertices if all have one (v x y z r g b, or v x y z w r g b), or else
//   its material's Kd, or else light grey. If all colours of the file are whole numbers of 0 to 255 and one
//   exceeds 1, they are divided by 255. Otherwise values outside 0 to 1 are clamped. The .mtl files are
//   regular files, sought in the folder of the OBJ file, or in the current one if that is read from a
//   descriptor. Their paths may have backslashes.
// - Objects (o) and groups (g) become Mesh::parts, for objects() in visible.h. A group's name is a word, an
//   object's or a material's the rest of the line. A '#' belongs to the name, as in "Paint #1".
// - Positions are read in double. If they are far from 0, more than 4 times the longest side of the box
//   around them, the mesh holds them relative to an offset near the box's centre, which is Mesh::origin: so
//   float keeps what the file says. `options` may ask for the offset without the origin.
// Throws std::runtime_error, with the file's name and the fault, if the file is missing, malformed, without
// a face that can be filled or larger than kMaxObjBytes, or if an index is out of range.
Scene read_obj(const std::filesystem::path& path, const ObjOptions& options = {},
               ObjReport* report = nullptr);

}  // namespace edgewise
#pragma GCC visibility pop
