// What a frame shows: its visible triangles, how many pixels they have, and whether a box would be seen. A
// pixel is background if its depth is contract::kDepthClear; its payload does not count then. Ids are those
// of Payload::id. Any thread may call these functions.
//
// Those that take a frame throw std::invalid_argument if a plane that they read is null, if a side is outside
// 1 … contract::kMaxImageSide, or if the stride is below the width.
//
// Pixel (0, 0) is top left, its centre lies at (0.5, 0.5), and y points down. The smaller depth is nearer.
// The front of a triangle is the side whose vertices appear clockwise (camera.h).
#pragma once

#include "edgewise/cxx20.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "edgewise/framebuffer.h"
#include "edgewise/scene.h"

#pragma GCC visibility push(default)
namespace edgewise {

// The visible triangles: each id that a pixel has, once, in ascending order. Needs one bit of memory per id
// up to the highest one. Throws std::invalid_argument for an id of kMaxTriangles or more.
std::vector<std::uint32_t> visible_triangles(const ConstFrameView& ids);

// The number of pixels of each triangle, by id. `triangles` is the number of submitted triangles. Throws
// std::invalid_argument for an id that is not below it.
std::vector<std::uint32_t> pixels_per_triangle(const ConstFrameView& ids, std::size_t triangles);

// Ids count through the instances in order, here from 0 on. One entry per instance: the id of its first
// triangle. Then one more: the number of triangles of the scene. Throws std::invalid_argument for an instance
// whose mesh index the scene lacks.
std::vector<std::size_t> first_ids(const Scene& scene);

// The ids of the triangles of each named part (Mesh::parts), by name and ascending, through all instances.
// An object's mask is the set of pixels whose id is in its list. Ids begin at 0 here, too. Throws
// what first_ids() throws, and std::invalid_argument for a part that its mesh lacks, or if the scene or its
// parts together have more than kMaxTriangles.
std::map<std::string, std::vector<std::uint32_t>> objects(const Scene& scene);

// The number of pixels of each instance, or of all instances of each mesh, in a frame of this scene alone,
// whose ids begin at 0. If it shows several draws, sum pixels_per_triangle() between the first ids. Throws
// what first_ids() throws, and std::invalid_argument for an id that the scene lacks.
std::vector<std::uint32_t> pixels_per_instance(const ConstFrameView& ids, const Scene& scene);
std::vector<std::uint32_t> pixels_per_mesh(const ConstFrameView& ids, const Scene& scene);

// Whether a triangle whose vertices lie in a box could win a pixel of a frame, drawn after what the frame
// shows, seen by the scene's camera or matrices. False is certain if the triangle's instance keeps to rule
// 10: its origin is at most 2^24 times as far from the camera as its vertices are. True is not certain: the
// function compares the nearest depth of the box with the pixels in the rectangle around the projected box,
// and stops at the first one that is farther. A box without points (low > high) is not visible. Of the
// others, one that is not finite, or that the near plane cuts, is visible, whatever the frame shows.
//
// `depth.payload` may be null. Throws std::invalid_argument for a camera or matrices that Frontend::run()
// throws for.
bool visible(const Bounds& box, const Scene& scene, const ConstFrameView& depth);

}  // namespace edgewise
#pragma GCC visibility pop
