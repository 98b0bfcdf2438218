// The two kinds of input: a scene (meshes, a camera and a light), or a stream of triangles that are already
// on the screen. All types here are plain values that own their data. Frontend::run and draw() check them;
// nothing is checked before.
//
// Pixel (0, 0) is top left, its centre lies at (0.5, 0.5), and y points down. The smaller depth is nearer.
// The front of a triangle is the side whose vertices appear clockwise (camera.h).
#pragma once

#include "edgewise/cxx20.h"

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "edgewise/camera.h"

#pragma GCC visibility push(default)
namespace edgewise {

// camera.h defines world space. Colours are 0xAABBGGRR (red in the lowest byte). Angles are in radians,
// lengths in world units.

// An opaque colour. Each channel must be in 0 … 255, which is not checked.
constexpr std::uint32_t rgb(std::uint32_t r, std::uint32_t g, std::uint32_t b) {
  return 0xFF000000u | b << 16 | g << 8 | r;
}

// Triangle flags (Mesh::flags).
inline constexpr std::uint8_t kTwoSided = 1;  // never culled, and lit on the side that the camera sees
inline constexpr std::uint8_t kSameFace = 2;  // belongs to the same face as the triangle before it

// Cluster i of a mesh: triangles i · kClusterTriangles … (i + 1) · kClusterTriangles - 1. The last cluster
// may have fewer.
inline constexpr std::size_t kClusterTriangles = 256;
struct MeshCluster {
  glm::vec3 low, high;  // bounding box of `positions`; infinite if a vertex is not finite
};

// Triangles first … first + count - 1 of a mesh, which have a name: of an object or a group of an OBJ file,
// say.
struct MeshPart {
  std::string name;
  std::size_t first = 0, count = 0;
};

struct Mesh {
  std::vector<glm::vec3> positions;    // model space, less `origin`
  std::vector<glm::uvec3> triangles;   // indices into positions; the side seen clockwise is the front
  std::vector<std::uint32_t> colours;  // one per triangle
  std::vector<std::uint8_t> flags{};   // one set of flags per triangle; empty if no triangle has any
  // For meshes with faces of more than three vertices: the face_normal() of each triangle's face, one per
  // triangle. Empty if each triangle's own plane gives its normal. renew_normals() when positions change. The
  // length does not matter; length 0 means no normal, and ambient light only.
  std::vector<glm::vec3> normals{};
  // For speed only: clusters_of() this mesh, or empty. Renew or clear them when positions or triangles
  // change.
  std::vector<MeshCluster> clusters{};
  // For objects() only. Parts may overlap, and several may have one name.
  std::vector<MeshPart> parts{};
  // Vertex i lies at origin + positions[i]. Floats alone would round away the shape of a mesh far
  // from 0. Finite.
  glm::dvec3 origin{0.0};

  // Sets `positions` and `origin` from points in double; set `triangles` before. The origin is 0 if floats
  // hold all points that triangles name (all points, if there are no triangles), or if none of their
  // coordinates exceeds 4 times the longest side of the box around them: then points are rounded to float.
  // Otherwise it is a point near the box's centre, and positions are off by at most 2^-24 of that side. NaN,
  // infinity and points out of float's range do not count, and become positions that are not finite. Clusters
  // and normals must be renewed.
  void set_positions(std::span<const glm::dvec3> points);
  // Makes `normals` anew, unless it is empty, after a change of positions. Requires one normal per triangle,
  // and vertices that exist.
  void renew_normals();

  bool has_flag(std::size_t triangle, std::uint8_t flag) const {
    return !flags.empty() && (flags[triangle] & flag) != 0;
  }
  // The normal of a triangle's face: from `normals`, or else of the triangle itself.
  glm::vec3 normal_of(std::size_t triangle) const;
  // Appends the missing normals of triangles 0 … end - 1: those of the triangles themselves.
  void fill_normals(std::size_t end);
  // Appends a face of four vertices a, b, c, d, which `positions` must hold, as two triangles: a, b, c and
  // then a, c, d. Fills `normals` for all triangles.
  void add_quad(glm::uvec4 corners, std::uint32_t colour, bool two_sided = false);
};

// The normal of a face, of length 1, on the side from which its vertices appear clockwise: the direction of
// its area vector (Newell's method), computed in double and rounded once. A bent face gets a mean normal.
// Vertices that repeat or lie on a straight side do not change it. Zero if the area vector is zero, as for a
// face without area or a symmetric bow tie. `vertices` holds at least three.
glm::vec3 face_normal(std::span<const glm::vec3> vertices);

// The clusters of a mesh, for Mesh::clusters: 24 bytes per 256 triangles. With them the front end drops the
// clusters that are out of view. Empty for meshes of fewer than 65,536 triangles, and if a vertex is missing.
std::vector<MeshCluster> clusters_of(const Mesh& mesh);

// A mesh placed in the world: scaled, then rotated about an axis through 0, then translated; or by any affine
// matrix instead. A scale with one or three negative components mirrors the mesh, as does a matrix
// with a negative determinant. Only the winding decides which side is the front, and mirroring reverses it.
// So Cull::back then shows the inside of a closed mesh, and the light falls on that side too. To draw the
// outside, use a mesh whose triangles list their vertices in reverse order.
struct Instance {
  std::size_t mesh = 0;  // index into Scene::meshes
  glm::dvec3 scale{1.0};
  glm::vec3 axis{0.0f, 1.0f, 0.0f};  // any length; length 0 means no rotation
  float angle = 0.0f;                // radians about the axis, counter-clockwise seen from its tip
  glm::dvec3 translation{0.0};
  // From model space to world space, in place of the four values above. Its elements must be finite, and its
  // last row 0 0 0 1: a projective one belongs into the camera's. It may shear, and it may flatten the mesh.
  std::optional<glm::dmat4> matrix{};
};

struct Scene {
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  Camera camera;
  std::optional<CameraMatrices> matrices{};  // in place of `camera`
  glm::vec3 to_light{0.3f, 0.8f, 0.5f};      // direction towards the light; any length but 0
};

// One triangle of a stream.
struct StreamTriangle {
  glm::vec3 vertex[3];  // x and y in pixels (y down), z in [0, 1]; smaller z is nearer
  std::uint32_t colour;
};
static_assert(sizeof(StreamTriangle) == 40);

// The same in double. Floats hold positions of 15 subpixel bits only up to 512 px.
struct ExactStreamTriangle {
  glm::dvec3 vertex[3];
  std::uint32_t colour;
};

struct TriangleStream {
  int width = 0, height = 0;  // px; the image size that the stream was made for
  std::vector<StreamTriangle> triangles;
  std::vector<ExactStreamTriangle> exact{};  // in place of `triangles`: one of the two is empty

  std::size_t size() const { return triangles.size() + exact.size(); }
};

using Drawable = std::variant<Scene, TriangleStream>;

// The bounding box, in world space, of the finite vertices that triangles name. No box: low > high.
struct Bounds {
  glm::dvec3 low, high;
};
// Throws std::out_of_range for an instance whose mesh index the scene lacks.
Bounds bounds_of(const Scene& scene);

// Moves and scales the instances so that the bounding box is centred on the origin and its longest side is 2.
// Makes the meshes' origins 0. Does nothing if that side is 0 or there is no box. Throws what bounds_of()
// throws, and std::invalid_argument if the longest side is below about 10^-30 or above 10^38, or if the
// centre is more than 2^35 times that side away from the origin.
void fit(Scene& scene);

// Places the camera in front of the bounding box, a little to the right and above, so that an image whose
// width is `aspect` times its height shows all of it. Sets a vertical field of view of 45 degrees, and near
// and far planes around the box. Removes the scene's matrices. Throws what bounds_of() throws.
void frame_camera(Scene& scene, double aspect = 1.0);

// The matrix from the positions of an instance's mesh, which are relative to its origin, to world space.
glm::dmat4 model_matrix(const Mesh& mesh, const Instance& instance);

}  // namespace edgewise
#pragma GCC visibility pop
