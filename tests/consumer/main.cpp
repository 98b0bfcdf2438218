// Draws a pyramid, or the OBJ file given as argument, into the program's own memory. Then prints which
// triangle is visible in the middle pixel.
#include <edgewise/contract.h>
#include <edgewise/draw.h>
#include <edgewise/image.h>
#include <edgewise/obj_file.h>

#include <cstdio>

using namespace edgewise;

Scene pyramid() {
  Scene scene;
  scene.meshes.push_back({.positions = {{0, 2, 0}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}},
                          .triangles = {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}},  // front is clockwise
                          .colours = {rgb(230, 57, 70), rgb(255, 200, 87), rgb(64, 196, 196), rgb(9, 9, 9)}});
  scene.instances.push_back({.mesh = 0, .angle = 0.5f});  // radians, about y
  frame_camera(scene);
  return scene;
}

int main(int count, char** arguments) try {
  const Drawable scene = count > 1 ? read_obj(arguments[1]) : pyramid();
  constexpr int width = 640, height = 360, stride = 704;  // px
  std::vector<std::uint32_t> depth(stride * height), payload(stride * height);
  const FrameView frame{depth.data(), payload.data(), width, height, stride};

  Frontend frontend;  // it and the backend keep their memory: make them once, draw often
  const auto backend = find_backend("tiled").make();
  draw(scene, frontend, {.width = width, .height = height}, *backend, frame, {rgb(30, 30, 40)});
  write_image("picture.png", to_image(frame));
  const FrontendOptions ids{.width = width, .height = height, .payload = Payload::id};
  draw(scene, frontend, ids, *backend, frame, {0xFFFFFFFF}, {.threads = 2});
  constexpr int middle = height / 2 * stride + width / 2;
  std::printf("triangle %u, depth %.6f\n", payload[middle], contract::depth01(depth[middle]));
} catch (const std::exception& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
