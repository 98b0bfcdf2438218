// Draws two overlapping squares into the program's own memory, and prints the picture's hash; square.c draws
// the same.
#include <edgewise/draw.h>
#include <edgewise/hash.h>

#include <cstdio>
#include <limits>
#include <vector>

using namespace edgewise;

int main() {
  constexpr int kWidth = 320, kHeight = 180, kStride = 333;  // px
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
  std::vector<std::uint32_t> depth(kStride * kHeight), payload(kStride * kHeight);
  const FrameView frame{depth.data(), payload.data(), kWidth, kHeight, kStride};
  draw(scene, frontend, {.width = kWidth, .height = kHeight, .cull = Cull::none},
       *find_backend("tiled").make(), frame, {rgb(0, 0, 0)});
  std::printf("%016llx\n", static_cast<unsigned long long>(hash_of(frame)));
}
