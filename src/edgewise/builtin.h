// The built-in scenes. They are deterministic: the same name, size, time and scale give the same bits on
// every machine. Any thread may call these functions.
//
// Pixel (0, 0) is top left, its centre lies at (0.5, 0.5), and y points down. The smaller depth is nearer.
// The front of a triangle is the side whose vertices appear clockwise (camera.h).
#pragma once

#include "edgewise/cxx20.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "edgewise/scene.h"

#pragma GCC visibility push(default)
namespace edgewise {

struct SceneRequest {
  int width = 1920, height = 1080;  // px, 1 … contract::kMaxImageSide; scenes of meshes ignore it
  float time = 0.0f;                // s, for scenes that turn
  double scale = 1.0;               // factor on the number of triangles, > 0; only scalable scenes use it
};

struct SceneInfo {
  std::string_view name;     // the key in the command line, tests, results and charts
  std::string_view summary;  // a description in one line
  bool stream;               // true: make() returns a TriangleStream, to be drawn without culling
  // Throws std::invalid_argument if it cannot make the requested size or scale.
  Drawable (*make)(const SceneRequest&);
  bool scalable = stream;  // true: SceneRequest::scale changes the number of triangles
};

// All built-in scenes. Valid until the program ends.
std::span<const SceneInfo> builtin_scenes();

// Throws std::invalid_argument for an unknown name; the message suggests the nearest known one.
const SceneInfo& find_scene(std::string_view name);

// A stream of count × request.scale triangles (at least 1) of `area_px` square pixels each. Their centres are
// random points of the image, so some reach over its border; depths, windings and colours are random too.
// `aspect` > 0 makes slivers of about that length over width; 0 draws from many shapes. Throws
// std::invalid_argument if request.scale is not positive or gives more than 10^8 triangles.
TriangleStream random_stream(const SceneRequest& request, std::size_t count, double area_px, double aspect,
                             std::uint64_t seed);

}  // namespace edgewise
#pragma GCC visibility pop
