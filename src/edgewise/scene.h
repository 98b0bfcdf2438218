// What can be drawn: meshes seen by a camera under a light, or a stream of triangles already on the screen.
// All are plain values that own what they hold. Nothing is checked until they are drawn (Frontend::run).
#pragma once

#include "edgewise/cxx20.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <variant>
#include <vector>

namespace edgewise {

// World space is right-handed with y up: x right, z towards a camera of yaw 0 and pitch 0, which looks along
// -z. Colours are 0xAABBGGRR (red in the lowest byte). Angles are radians, lengths are world units.

// Each 0 … 255; opaque.
constexpr std::uint32_t rgb(std::uint32_t r, std::uint32_t g, std::uint32_t b) {
  return 0xFF000000u | b << 16 | g << 8 | r;
}

// What sets a triangle apart from others.
inline constexpr std::uint8_t kTwoSided = 1;  // never culled for its facing, and lit on the side that is seen
inline constexpr std::uint8_t kSecondHalf = 2;  // with the triangle before it, a face of four vertices

struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;   // indices into positions; clockwise seen from outside is front
  std::vector<std::uint32_t> colours;  // one a triangle
  std::vector<std::uint8_t> marks{};   // of each triangle, the sum of the above; or empty: none has any

  bool has_mark(std::size_t triangle, std::uint8_t mark) const {
    return !marks.empty() && (marks[triangle] & mark) != 0;
  }
  // The first triangle of a triangle's face. It stands for the face: its colour and its light (by its own
  // normal) are those of both halves.
  std::size_t face_of(std::size_t triangle) const { return triangle - has_mark(triangle, kSecondHalf); }
  // A face of four vertices a, b, c, d: the triangles a, b, c and a, c, d, in this order.
  void add_quad(glm::uvec4 corners, std::uint32_t colour, bool two_sided = false);
};

// A mesh in the world: scaled, then rotated about an axis through its origin, then moved. A scale with one or
// three negative components mirrors the mesh. Only the winding decides which side is the front, and mirroring
// reverses it: Cull::back shows the inside of a closed mesh, and the light falls on that side, too. To draw
// the outside, give the instance a mesh whose triangles name their vertices in reverse order.
struct Instance {
  std::size_t mesh = 0;  // index into Scene::meshes
  glm::vec3 scale{1.0f};
  glm::vec3 axis{0.0f, 1.0f, 0.0f};  // of any length; 0: no rotation
  float angle = 0.0f;                // about the axis, counter-clockwise seen from its tip
  glm::vec3 translation{0.0f};
};

struct Camera {
  glm::vec3 position{0.0f};
  float yaw = 0.0f;     // about +y; positive turns left
  float pitch = 0.0f;   // positive looks up
  float fov_y = 1.0f;   // vertical field of view, in (0, pi)
  float near_z = 0.1f;  // distances along the view direction, 0 < near_z < far_z
  float far_z = 100.0f;

  // Turns the camera towards a point; one at the camera's own position changes nothing.
  void look_at(glm::vec3 target);
};

struct Scene {
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  Camera camera;
  glm::vec3 to_light{0.3f, 0.8f, 0.5f};  // direction towards the light, of any length but 0
};

// One triangle of a stream: x and y in pixels (y down), z in [0, 1], smaller is nearer.
struct StreamTriangle {
  glm::vec3 vertex[3];
  std::uint32_t colour;
};
static_assert(sizeof(StreamTriangle) == 40);

struct TriangleStream {
  int width = 0, height = 0;  // px, the image it was made for
  std::vector<StreamTriangle> triangles;
};

using Drawable = std::variant<Scene, TriangleStream>;

// Centres the bounding box of the scene's finite vertices on the origin and scales its longest side to 2.
// Throws std::out_of_range, as frame_camera does, for an instance that names a mesh the scene lacks, and
// std::invalid_argument for a box below about 10^-30 or above 10^38, or as far off in proportion.
void fit(Scene& scene);

// Puts the camera where it sees all finite vertices from the front, a little to the right and above, with a
// vertical field of view of 45 degrees and near and far planes around them. The image should be at least as
// wide as high.
void frame_camera(Scene& scene);

// Where an instance's mesh lies in the world.
glm::mat4 model_matrix(const Instance& instance);

}  // namespace edgewise
