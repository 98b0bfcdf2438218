// What a frame shows: its visible triangles, how many pixels they have, and whether a box would be seen. A
// pixel is background if its depth is contract::kDepthClear; its payload does not count then. Ids are those
// of Payload::id. Any thread may call these functions.
//
// Those that take a frame throw std::invalid_argument if a plane that they read is null, if a side is outside
// 1 … contract::kMaxImageSide, or if the stride is below the width.
#pragma once

#include "edgewise/cxx20.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "edgewise/framebuffer.h"
#include "edgewise/scene.h"

namespace edgewise {

// The visible triangles: each id that a pixel has, once, in ascending order. Needs one bit of memory per id
// up to the highest one.
std::vector<std::uint32_t> visible_triangles(const ConstFrameView& ids);

// The number of pixels of each triangle, by id. `triangles` is the number of submitted triangles. Throws
// std::invalid_argument for an id that is not below it.
std::vector<std::uint32_t> pixels_per_triangle(const ConstFrameView& ids, std::size_t triangles);

// Ids count through the instances in order. One entry per instance: the id of its first triangle. Then one
// more: the number of triangles of the scene. Throws std::invalid_argument for an instance whose mesh index
// the scene lacks.
std::vector<std::size_t> first_ids(const Scene& scene);

// The number of pixels of each instance, or of all instances of each mesh. Throws what first_ids() throws,
// and std::invalid_argument for an id that the scene lacks.
std::vector<std::uint32_t> pixels_per_instance(const ConstFrameView& ids, const Scene& scene);
std::vector<std::uint32_t> pixels_per_mesh(const ConstFrameView& ids, const Scene& scene);

// True if a triangle whose vertices lie in a box could win a pixel of a frame, drawn after what the frame
// shows, seen by the scene's camera. False is certain, for all positions that rule 10 holds for. True is not:
// the query compares the nearest depth of the box with the pixels in the rectangle around the projected box,
// and stops at the first one that is farther. It returns true, without a look at the frame, for a box that
// the near plane cuts and for one with a coordinate that is infinite or NaN, and false for one without points
// (low > high).
//
// `depth.payload` may be null. Throws std::invalid_argument for a camera that is out of range.
bool visible(const Bounds& box, const Scene& scene, const ConstFrameView& depth);

}  // namespace edgewise
