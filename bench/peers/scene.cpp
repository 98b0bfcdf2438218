#include "bench/peers/scene.h"

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

// Colours by triangle id. Triangles that the front end drops keep 0, since peers must not draw them either.
std::vector<std::uint32_t> colours_by_id(const Workload& workload, std::size_t count) {
  std::vector<std::uint32_t> colours(count, 0);
  const auto ids = triangles_by_id(workload, true);
  for (std::size_t i = 0; i < ids.size(); ++i) colours[ids[i].payload] = workload.triangles()[i].payload;
  return colours;
}

std::vector<PeerMesh> scene_meshes(const Workload& workload, PeerPayload payload) {
  const auto& scene = std::get<Scene>(workload.drawable());
  std::vector<std::uint32_t> payloads(workload.submitted());
  if (payload == PeerPayload::colour)
    payloads = colours_by_id(workload, payloads.size());
  else
    for (std::size_t i = 0; i < payloads.size(); ++i) payloads[i] = static_cast<std::uint32_t>(i);
  const glm::dmat4 to_screen = screen_matrix(scene.camera, workload.width(), workload.height());
  std::vector<PeerMesh> meshes;
  std::span<const std::uint32_t> rest = payloads;
  for (const auto& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    meshes.push_back(ProvokingVertices(mesh).assign(rest.first(mesh.triangles.size())));
    meshes.back().to_screen = glm::mat4(to_screen * glm::dmat4(model_matrix(instance)));
    rest = rest.subspan(mesh.triangles.size());
  }
  return meshes;
}

PeerMesh screen_mesh(const Workload& workload, PeerPayload payload) {
  PeerMesh mesh;
  std::uint32_t id = 0;
  for (const auto& t : workload.triangles()) {
    for (int k = 0; k < 3; ++k) {
      const auto units = static_cast<double>(t.z[k] - contract::kDepthHead);
      mesh.positions.emplace_back(static_cast<float>(t.x_sub[k]) / contract::kSub,
                                  static_cast<float>(t.y_sub[k]) / contract::kSub,
                                  static_cast<float>(units / contract::kDepthRange));
      mesh.payloads.push_back(payload == PeerPayload::id ? id : t.payload);
    }
    ++id;
  }
  return mesh;
}

}  // namespace

PeerScene peer_scene(const Workload& workload, bool whole_frame, PeerPayload payload) {
  PeerScene scene;
  scene.width = workload.width();
  scene.height = workload.height();
  scene.background = payload == PeerPayload::id ? kNoTriangle : kBackground;
  if (whole_frame) {
    scene.cull_back = workload.frontend_options(1).cull == Cull::back;
    scene.meshes = scene_meshes(workload, payload);
  } else {
    scene.meshes.push_back(screen_mesh(workload, payload));
  }
  return scene;
}

std::vector<ScreenTriangle> triangles_by_id(const Workload& workload, bool whole_frame) {
  if (whole_frame) {
    FrontendOptions options = workload.frontend_options(1);
    options.payload = Payload::id;
    Frontend frontend;
    const auto triangles = frontend.run(workload.drawable(), options);
    return {triangles.begin(), triangles.end()};
  }
  std::vector<ScreenTriangle> triangles(workload.triangles().begin(), workload.triangles().end());
  for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i].payload = static_cast<std::uint32_t>(i);
  return triangles;
}

}  // namespace edgewise::bench
