// Draws two overlapping squares, and prints the picture's hash; square.c draws the same.
#include <edgewise/draw.h>
#include <edgewise/hash.h>

#include <cstdio>
#include <limits>

using namespace edgewise;

int main() {
  constexpr int kWidth = 320, kHeight = 180;
  Scene scene;
  scene.meshes.push_back({.positions = {{-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {1, -1, 0}},
                          .triangles = {{0, 1, 2}, {0, 2, 3}},
                          .colours = {rgb(230, 57, 70), rgb(255, 200, 87)}});
  const glm::dmat4 moved(1, 0, .5, 0, .25, 1, 0, 0, 0, 0, 1, 0, .5, .25, -1, 1);
  scene.instances = {Instance{}, Instance{.matrix = moved}};
  const glm::dmat4 view(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -3, 1);
  scene.matrices = {view, perspective_projection(1.0, double{kWidth} / kHeight, .1,
                                                 std::numeric_limits<double>::infinity())};
  Frontend frontend;
  Framebuffer frame(kWidth, kHeight);
  draw(scene, frontend, {.width = kWidth, .height = kHeight, .cull = Cull::none},
       *find_backend("tiled").make(), frame.view(), {rgb(0, 0, 0)});
  std::printf("%016llx\n", static_cast<unsigned long long>(hash_of(frame)));
}
