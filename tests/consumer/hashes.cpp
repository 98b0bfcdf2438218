// Prints the hashes that `edgewise hash SCENE… --size 320x160 --frames 4 --fps 32` prints, also if a compiler
// may reorder this program's floating-point arithmetic. SCENE: a built-in scene of meshes, or an OBJ file.
#include <edgewise/builtin.h>
#include <edgewise/draw.h>
#include <edgewise/hash.h>
#include <edgewise/obj_file.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

using namespace edgewise;

void print(std::uint64_t hash) {
  std::printf("%016llx\n", static_cast<unsigned long long>(hash));
}

int main(int count, char** arguments) try {
  constexpr int kWidth = 320, kHeight = 160, kFrames = 4;
  Frontend frontend;
  const auto backend = find_backend("tiled").make();
  Framebuffer frame(kWidth, kHeight);
  const auto draw_and_hash = [&](const Drawable& drawable) {
    draw(drawable, frontend, {.width = kWidth, .height = kHeight}, *backend, frame.view(), {rgb(0, 0, 0)});
    return hash_of(frame);
  };
  std::vector<std::uint64_t> all;
  for (int i = 1; i < count; ++i) {
    std::vector<std::uint64_t> hashes;
    const std::string scene = arguments[i];
    if (scene.ends_with(".obj")) {
      Scene mesh = read_obj(scene);
      frame_camera(mesh, double{kWidth} / kHeight);
      hashes.assign(kFrames, draw_and_hash(mesh));
    } else {
      for (int n = 0; n < kFrames; ++n)
        hashes.push_back(draw_and_hash(find_scene(scene).make({.time = static_cast<float>(n) / 32.0f})));
    }
    all.push_back(hash_of_all(hashes));
    print(all.back());
  }
  print(hash_of_all(all));
} catch (const std::exception& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
