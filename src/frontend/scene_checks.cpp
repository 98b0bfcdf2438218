#include "frontend/scene_checks.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "edgewise/frontend.h"
#include "edgewise/limits.h"

namespace edgewise {

std::size_t checked_count(std::uint64_t triangles, std::uint32_t first_id) {
  if (triangles > kMaxTriangles)
    throw std::invalid_argument(std::to_string(triangles) + " triangles are more than " +
                                std::to_string(kMaxTriangles));
  if (first_id > kMaxTriangles - triangles)
    throw std::invalid_argument("the ids of " + std::to_string(triangles) + " triangles, from " +
                                std::to_string(first_id) + " on, reach " + std::to_string(kMaxTriangles));
  return static_cast<std::size_t>(triangles);
}

void check_subpixel_bits(int bits) {
  if (bits < kMinSubpixelBits || bits > kMaxSubpixelBits)
    throw std::invalid_argument(std::to_string(bits) + " subpixel bits are outside " +
                                std::to_string(kMinSubpixelBits) + " to " + std::to_string(kMaxSubpixelBits));
}

void check(const TriangleStream& stream) {
  if (!stream.triangles.empty() && !stream.exact.empty())
    throw std::invalid_argument("a stream has triangles in float and in double");
}

const Mesh& mesh_of(const Scene& scene, const Instance& instance) {
  if (instance.mesh >= scene.meshes.size())
    throw std::invalid_argument("an instance names mesh " + std::to_string(instance.mesh) + " of " +
                                std::to_string(scene.meshes.size()));
  return scene.meshes[instance.mesh];
}

void check_index(const char* what, std::size_t index, std::size_t count) {
  if (index >= count)
    throw std::invalid_argument(std::string(what) + " " + std::to_string(index) + " of " +
                                std::to_string(count));
}

void check_count(const char* what, std::size_t given, std::size_t count) {
  if (given != count)
    throw std::invalid_argument(std::to_string(given) + " " + what + " given instead of " +
                                std::to_string(count));
}

void check_per_triangle(const Mesh& mesh, std::size_t given, const char* what) {
  if (given != mesh.triangles.size())
    throw std::invalid_argument("a mesh has " + std::to_string(mesh.triangles.size()) + " triangles and " +
                                std::to_string(given) + " " + what);
}

void check_flags(const Mesh& mesh) {
  if (!mesh.flags.empty()) check_per_triangle(mesh, mesh.flags.size(), "flags");
}

void check_part(const Mesh& mesh, const MeshPart& part) {
  const std::size_t triangles = mesh.triangles.size();
  if (part.first > triangles || part.count > triangles - part.first)
    throw std::invalid_argument("a part of " + std::to_string(part.count) + " triangles from " +
                                std::to_string(part.first) + " on does not fit a mesh of " +
                                std::to_string(triangles));
}

void check_vertices(const Mesh& mesh) {
  const auto largest = [](glm::uvec3 t) { return std::max({t.x, t.y, t.z}); };
  const auto bad = std::find_if(mesh.triangles.begin(), mesh.triangles.end(),
                                [&](glm::uvec3 t) { return largest(t) >= mesh.positions.size(); });
  if (bad == mesh.triangles.end()) return;
  throw std::invalid_argument("triangle " + std::to_string(bad - mesh.triangles.begin()) + " names vertex " +
                              std::to_string(largest(*bad)) + " of " + std::to_string(mesh.positions.size()));
}

}  // namespace edgewise
