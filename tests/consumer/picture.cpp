// Draws a pyramid and writes the picture.
#include <edgewise/backend.h>
#include <edgewise/frontend.h>
#include <edgewise/image.h>

using namespace edgewise;

int main() {
  Scene scene;
  scene.meshes.push_back({.positions = {{0, 2, 0}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}},
                          .triangles = {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}},  // front is clockwise
                          .colours = {rgb(230, 57, 70), rgb(255, 200, 87), rgb(64, 196, 196), rgb(9, 9, 9)}});
  scene.instances.push_back({.mesh = 0, .angle = 0.5f});  // radians, about y
  frame_camera(scene);

  Frontend frontend;  // it and the backend keep their memory: make them once, draw often
  const auto backend = find_backend("tiled").make();
  Framebuffer frame(640, 360);
  backend->draw(frontend.run(scene, {.width = 640, .height = 360}), frame.view(), rgb(30, 30, 40),
                {.threads = 2});
  write_image("pyramid.png", to_image(frame.view()));
}
