// Draws the benchmark's built-in scenes, smaller, so that their instructions can be counted
// (count_instructions.cpp). A line of standard output ends each part of a frame, which is done twice: the
// first also allocates.
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <string_view>

#include "edgewise/backend.h"
#include "edgewise/builtin.h"
#include "edgewise/frontend.h"

namespace edgewise {

namespace {

constexpr int kWidth = 480, kHeight = 270;  // px, a quarter of the benchmark's

void draw_parts(const SceneInfo& scene, SimdTarget target) {
  const Drawable drawable =
      scene.make({.width = kWidth, .height = kHeight, .scale = scene.stream ? 1.0 / 16 : 1.0});
  const FrontendOptions options{.width = kWidth,
                                .height = kHeight,
                                .cull = scene.stream ? Cull::none : Cull::back,
                                .shade = !scene.stream};
  const auto twice = [&](std::string_view part, auto&& draw_part) {
    const std::string line =
        std::string(scene.name) + " " + std::string(name_of(target)) + " " + std::string(part) + "\n";
    for (int i = 0; i < 2; ++i) {
      draw_part();
      if (write(STDOUT_FILENO, line.data(), line.size()) < 0) std::abort();  // printf would be counted
    }
  };
  Frontend frontend;
  Framebuffer frame(kWidth, kHeight);
  twice("frontend", [&] { frontend.run(drawable, options, {.target = target}); });
  const ScreenTriangles triangles = frontend.run(drawable, options);
  for (const std::string_view name : {"scanline", "tiled"}) {
    const auto backend = find_backend(name).make();
    twice(name, [&] { backend->draw(triangles, frame.view(), {0}, {.target = target}); });
  }
}

}  // namespace

}  // namespace edgewise

int main() {
  for (const edgewise::SceneInfo& scene : edgewise::builtin_scenes())
    for (const edgewise::SimdTarget target : edgewise::supported_targets())
      edgewise::draw_parts(scene, target);
}
