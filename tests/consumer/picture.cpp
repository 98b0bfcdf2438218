// Draws a mesh file and writes the picture.
#include <edgewise/draw.h>
#include <edgewise/image.h>
#include <edgewise/obj_file.h>

using namespace edgewise;

int main() {
  const Scene scene = read_obj("mesh.obj");  // its camera sees the whole mesh
  Frontend frontend;                         // reuse it and the backend: they keep their buffers
  const auto backend = find_backend("tiled").make();
  Framebuffer frame(640, 360);
  draw(scene, frontend, {.width = 640, .height = 360}, *backend, frame.view(), {rgb(30, 30, 40)},
       {.threads = 2});
  write_image("mesh.png", to_image(frame.view()));
}
