#include "bench/peers/scene.h"

#include <cmath>
#include <numeric>

#include "edgewise/contract.h"
#include "frontend/view.h"

namespace edgewise::bench {

namespace {

constexpr std::uint32_t kNoId = 0xFFFFFFFFu;

// Gives each triangle a last (provoking) vertex that no other triangle has as its last, to carry its payload.
// It takes the first of the triangle's three that is not taken (rotation keeps the winding), or a copy if all
// are. Vertices are numbered in the order in which triangles first use them, which is good for caches.
class ProvokingVertices {
 public:
  explicit ProvokingVertices(const Mesh& mesh)
      : mesh_(mesh), taken_(mesh.positions.size(), 0), number_(taken_.size(), kNoId) {}

  PeerMesh assign(std::span<const std::uint32_t> payloads) {
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      const glm::uvec3 t = mesh_.triangles[i];
      int last = 0;
      while (last < 3 && taken_[t[last]]) ++last;
      const bool copy = last == 3;
      if (copy) last = 2;
      for (const int k : {(last + 1) % 3, (last + 2) % 3}) out_.indices.push_back(number(t[k]));
      out_.indices.push_back(copy ? add(t[last]) : number(t[last]));
      taken_[t[last]] = 1;
      out_.payloads[out_.indices.back()] = payloads[i];
    }
    return std::move(out_);
  }

 private:
  std::uint32_t add(std::uint32_t vertex) {
    out_.positions.push_back(mesh_.positions[vertex]);
    out_.payloads.push_back(0);
    return static_cast<std::uint32_t>(out_.positions.size() - 1);
  }
  std::uint32_t number(std::uint32_t vertex) {
    if (number_[vertex] == kNoId) number_[vertex] = add(vertex);
    return number_[vertex];
  }

  const Mesh& mesh_;
  std::vector<char> taken_;
  std::vector<std::uint32_t> number_;
  PeerMesh out_;
};

// The colour or id of each submitted triangle. Triangles that the front end drops have colour 0, since peers
// must not draw them either.
std::vector<std::uint32_t> payloads_of(const Workload& workload, PeerPayload payload) {
  std::vector<std::uint32_t> payloads(workload.submitted(), 0);
  if (payload == PeerPayload::id) {
    std::iota(payloads.begin(), payloads.end(), 0u);
    return payloads;
  }
  const auto ids = triangles_by_id(workload);
  for (std::size_t i = 0; i < ids.size(); ++i) payloads[ids[i].payload] = workload.triangles()[i].payload;
  return payloads;
}

std::vector<PeerMesh> scene_meshes(const Scene& scene, const Workload& workload,
                                   std::span<const std::uint32_t> payloads) {
  const double near_z = scene.camera.near_z, far_z = scene.camera.far_z;
  const auto depth_scale = static_cast<float>(far_z / (far_z - near_z));
  std::vector<PeerMesh> meshes;
  for (const auto& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    meshes.push_back(ProvokingVertices(mesh).assign(payloads.first(mesh.triangles.size())));
    const ScreenTransform transform(scene.camera, instance, workload.width(), workload.height());
    PeerMesh& peers = meshes.back();
    for (glm::vec3& position : peers.positions) position -= transform.origin;
    for (int i = 0; i < 4; ++i) {
      const glm::vec3 v = transform.rounded[i];
      peers.to_screen[i] = {v.x, v.y, depth_scale * v.z, v.z};
    }
    peers.to_screen[3].z -= depth_scale * scene.camera.near_z;
    payloads = payloads.subspan(mesh.triangles.size());
  }
  return meshes;
}

// Positions are rounded as the front end does: peers may compute depth planes from positions before rounding,
// and those of slivers would differ.
PeerMesh stream_mesh(const TriangleStream& stream, std::span<const std::uint32_t> payloads) {
  PeerMesh mesh;
  const auto rounded = [](float px) { return std::nearbyint(px * contract::kSub) / contract::kSub; };
  for (std::size_t i = 0; i < stream.triangles.size(); ++i)
    for (const glm::vec3 vertex : stream.triangles[i].vertex) {
      mesh.positions.emplace_back(rounded(vertex.x), rounded(vertex.y), vertex.z);
      mesh.payloads.push_back(payloads[i]);
    }
  return mesh;
}

}  // namespace

PeerScene peer_scene(const Workload& workload, PeerPayload payload) {
  PeerScene result;
  result.width = workload.width();
  result.height = workload.height();
  result.background = payload == PeerPayload::id ? kNoTriangle : kBackground;
  result.cull_back = workload.frontend_options({}).cull == Cull::back;
  const auto payloads = payloads_of(workload, payload);
  if (const auto* scene = std::get_if<Scene>(&workload.drawable()))
    result.meshes = scene_meshes(*scene, workload, payloads);
  else
    result.meshes.push_back(stream_mesh(std::get<TriangleStream>(workload.drawable()), payloads));
  return result;
}

std::vector<ScreenTriangle> triangles_by_id(const Workload& workload) {
  FrontendOptions options = workload.frontend_options({});
  options.payload = Payload::id;
  Frontend frontend;
  const auto triangles = frontend.run(workload.drawable(), options);
  return {triangles.begin(), triangles.end()};
}

}  // namespace edgewise::bench
