// The built-in scenes. All are deterministic: the same name, size, time and scale give the same bits
// everywhere. Any thread may call anything here.
#pragma once

#include "edgewise/cxx20.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "edgewise/scene.h"

namespace edgewise {

struct SceneRequest {
  int width = 1920, height = 1080;  // px, 1 … contract::kMaxImageSide; meshes look the same in any
  float time = 0.0f;                // s, for scenes that turn
  double scale = 1.0;               // factor on the number of triangles, > 0; only of scalable scenes
};

struct SceneInfo {
  std::string_view name;  // the one key in command line, tests, results and charts
  std::string_view idea;  // one line
  bool stream;            // true: a TriangleStream, to be drawn without culling or shading
  // Throws std::invalid_argument for a size or scale that it cannot make.
  Drawable (*make)(const SceneRequest&);
  bool scalable = stream;  // SceneRequest::scale changes it
};

// Valid for as long as the program.
std::span<const SceneInfo> builtin_scenes();

// Throws std::invalid_argument, with the nearest known name, for an unknown one.
const SceneInfo& find_scene(std::string_view name);

// A stream of `count` triangles of `area_px` square pixels each, at random places over the image, overlapping
// at its borders, at random depths. `aspect` is length over width of a sliver; 0 draws from all shapes.
// Throws std::invalid_argument where request.scale makes none of it, or more than 10^8.
TriangleStream random_stream(const SceneRequest& request, std::size_t count, double area_px, double aspect,
                             std::uint64_t seed);

}  // namespace edgewise
