// Draws ids with the camera of a computer vision program, and asks the frame what it shows.
#include <edgewise/barycentrics.h>
#include <edgewise/draw.h>
#include <edgewise/visible.h>

#include <cstdio>

using namespace edgewise;

int main() {
  constexpr int width = 640, height = 480;  // px
  Scene scene;
  scene.meshes.push_back({.positions = {{-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {1, -1, 0}},
                          .triangles = {{0, 1, 2}, {0, 2, 3}},
                          .colours = {rgb(230, 57, 70), rgb(255, 200, 87)}});
  scene.instances = {{.mesh = 0}, {.mesh = 0, .translation = {1, 0.5, -1}}};
  // Column by column, as glm stores them: OpenCV's K, and a camera 3 units before the first square.
  const glm::dmat3 k(500, 0, 0, 0, 500, 0, 319.5, 239.5, 1);
  const glm::dmat4 world_to_camera(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 3, 1);
  scene.matrices = {world_to_camera, intrinsics_projection(k, width, height, 0.0, 0.1, 100.0)};

  const FrontendOptions options{.width = width, .height = height, .payload = Payload::id};
  Frontend frontend;
  Framebuffer ids(width, height);
  draw(scene, frontend, options, *find_backend("tiled").make(), ids.view());
  for (const std::uint32_t pixels : pixels_per_instance(ids, scene)) std::printf("%u px\n", pixels);

  std::vector<float> uv(2 * width * height), distance(width * height);
  barycentrics(ids, scene, options, {uv.data(), 2 * width, distance.data(), width});
  std::printf("distance %.3f\n", distance[height / 2 * width + width / 2]);

  const bool seen = visible({{-0.2, -0.2, -2}, {0.2, 0.2, -1}}, scene, ids);
  std::printf("the box is %s\n", seen ? "perhaps seen" : "hidden");
}
