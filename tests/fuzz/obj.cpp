// Reads any bytes as an .obj file: the result is either an error message, or a valid mesh that can be drawn.
#include <cmath>
#include <stdexcept>

#include "edgewise/obj_file.h"
#include "fuzz.h"
#include "lab/cases/random_cases.h"

using namespace edgewise;

namespace {

void check(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    fuzz::require(!mesh.triangles.empty(), "a mesh without triangles");
    fuzz::require(mesh.colours.size() == mesh.triangles.size(), "colours and triangles differ in number");
    fuzz::require(mesh.flags.size() == mesh.normals.size(), "flags and normals differ in number");
    for (const MeshPart& part : mesh.parts)
      fuzz::require(part.count > 0 && part.first < mesh.triangles.size() &&
                        part.count <= mesh.triangles.size() - part.first,
                    "a part is empty, or names a triangle that is not there");
    for (const glm::vec3& n : mesh.normals)
      fuzz::require(n == glm::vec3(0.0f) || std::abs(glm::length(n) - 1.0f) < 1e-6f,
                    "a normal's length is not 1");
    for (const glm::vec3& p : mesh.positions)
      fuzz::require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                    "a position is not finite");
    for (const glm::uvec3& t : mesh.triangles)
      for (int i = 0; i < 3; ++i)
        fuzz::require(t[i] < mesh.positions.size(), "a triangle names a vertex that is not there");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile file(data, size);
  Scene scene;
  try {
    scene = read_obj(file.path());
  } catch (const std::runtime_error&) {
    return 0;
  }
  check(scene);
  fuzz::check_frontend(scene, 64, 48);
  Random random(size);
  scene.matrices = randomized::random_matrices(random, scene.camera, 64, 48);
  if (scene.matrices) fuzz::check_frontend(scene, 64, 48);
  return 0;
}
