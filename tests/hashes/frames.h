// The frames whose hashes tests/hashes.json holds. They are the same on every machine.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "edgewise/frontend.h"
#include "edgewise/screen_triangle.h"
#include "hashes/files.h"

namespace edgewise::hashes {

struct Frame {
  int width, height;  // px
  std::uint32_t background = 0xFF000000;
  std::vector<ScreenTriangle> triangles = {};          // if there is no drawable
  std::shared_ptr<const Drawable> drawable = nullptr;  // for the front end, with
  FrontendOptions frontend = {};
  const FileFormat* file = nullptr;  // whose bytes are hashed, too
};

struct Group {
  std::string name;
  int frames;
  std::function<Frame(int)> frame;  // 0 … frames - 1; quick if called in order
};
std::vector<Group> groups();

}  // namespace edgewise::hashes
