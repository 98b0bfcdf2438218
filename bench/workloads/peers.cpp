#include "bench/workloads/peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "edgewise/contract.h"
#include "frontend/view.h"
#include "lab/cases/backend_comparison.h"
#include "lab/coverage/cracks.h"
#include "lab/portable/portable.h"

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
    const ScreenTransform transform({scene.camera, workload.width(), workload.height()},
                                    model_matrix(mesh, instance));
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
PeerMesh stream_mesh(const TriangleStream& stream, std::span<const std::uint32_t> payloads,
                     int subpixel_bits) {
  PeerMesh mesh;
  for (std::size_t i = 0; i < stream.size(); ++i)
    for (const glm::dvec3 vertex : stream.at(i).vertex) {
      mesh.positions.emplace_back(lab::rounded_to(vertex.x, subpixel_bits),
                                  lab::rounded_to(vertex.y, subpixel_bits), vertex.z);
      mesh.payloads.push_back(payloads[i]);
    }
  return mesh;
}

}  // namespace

PeerScene peer_scene(const Workload& workload, PeerPayload payload, int subpixel_bits) {
  PeerScene result;
  result.width = workload.width();
  result.height = workload.height();
  result.background = payload == PeerPayload::id ? kNoTriangle : kBackground;
  result.cull_back = workload.frontend_options().cull == Cull::back;
  const auto payloads = payloads_of(workload, payload);
  if (const auto* scene = std::get_if<Scene>(&workload.drawable()))
    result.meshes = scene_meshes(*scene, workload, payloads);
  else
    result.meshes.push_back(
        stream_mesh(std::get<TriangleStream>(workload.drawable()), payloads, subpixel_bits));
  return result;
}

namespace {

std::vector<ScreenTriangle> triangles_by_id(const Workload& workload, FrontendOptions options) {
  options.payload = Payload::id;
  Frontend frontend;
  const auto triangles = frontend.run(workload.drawable(), options);
  return {triangles.begin(), triangles.end()};
}

}  // namespace

std::vector<ScreenTriangle> triangles_by_id(const Workload& workload) {
  return triangles_by_id(workload, workload.frontend_options());
}

namespace {

using namespace contract;

bool covers(const Oriented& t, int x, int y) {
  return t.area > 0 && make_edge(t, 0).at(x, y) >= 0 && make_edge(t, 1).at(x, y) >= 0 &&
         make_edge(t, 2).at(x, y) >= 0;
}

// The piece of triangle `id` that covers the pixel, or null.
const ScreenTriangle* find(std::span<const ScreenTriangle> triangles, std::uint32_t id, int x, int y) {
  const auto pieces = std::ranges::equal_range(triangles, id, {}, &ScreenTriangle::payload);
  const auto found = std::ranges::find_if(pieces, [&](const auto& t) { return covers(orient(t), x, y); });
  return found == pieces.end() ? nullptr : &*found;
}

}  // namespace

double float_plane_error(const ScreenTriangle& t, int width, int height) {
  const Oriented o = orient(t);
  const auto [low, high] = std::minmax({o.z[0], o.z[1], o.z[2]});
  const auto length_px = [](const std::int32_t(&v)[3]) {
    return (static_cast<double>(std::abs(v[1] - v[0])) + std::abs(v[2] - v[0])) / kPixel_q15;
  };
  return lab::float_plane_error(static_cast<double>(high), static_cast<double>(high - low), length_px(o.x),
                                length_px(o.y), static_cast<double>(o.area) / (kPixel_q15 * kPixel_q15),
                                width, height);
}

PeerJudgement judge(const Framebuffer& ours, std::span<const std::uint32_t> theirs,
                    std::span<const ScreenTriangle> triangles) {
  const auto is_depth_tie = [&](std::uint32_t our_id, std::uint32_t their_id, int x, int y) {
    const ScreenTriangle *mine = find(triangles, our_id, x, y), *other = find(triangles, their_id, x, y);
    if (mine == nullptr || other == nullptr) return false;
    const double gap = 1.0 * make_depth(orient(*other)).at(x, y) - ours.depth_row(y)[x];
    return gap <= 2.0 * kDepthError + float_plane_error(*mine, ours.width(), ours.height()) +
                      float_plane_error(*other, ours.width(), ours.height());
  };
  const auto mine = lab::payloads_of(ours);
  PeerJudgement result;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    if (mine[i] == theirs[i]) continue;
    const int pixel = static_cast<int>(i), x = pixel % ours.width(), y = pixel / ours.width();
    ++result.different;
    ++(is_depth_tie(mine[i], theirs[i], x, y) ? result.tie : result.wrong);
  }
  return result;
}

namespace {

// The pixels that show the same triangle in both pictures, but another colour.
std::uint64_t differing_colours(const Framebuffer& ids, std::span<const std::uint32_t> their_ids,
                                const Framebuffer& colours, std::span<const std::uint32_t> their_colours) {
  const auto our_ids = lab::payloads_of(ids), our_colours = lab::payloads_of(colours);
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < our_ids.size(); ++i)
    count += our_ids[i] == their_ids[i] && our_colours[i] != their_colours[i];
  return count;
}

Framebuffer picture_of_ids(const Workload& workload, std::span<const ScreenTriangle> triangles) {
  Framebuffer frame(workload.width(), workload.height());
  backends().front().make()->draw(triangles, frame.view(), {kNoTriangle});
  return frame;
}

}  // namespace

PeerJudgement judge_portable(const Workload& workload, std::span<const std::uint32_t> theirs,
                             int subpixel_bits) {
  FrontendOptions options = workload.frontend_options();
  options.subpixel_bits = std::max(options.subpixel_bits, subpixel_bits);
  const Framebuffer ours = picture_of_ids(workload, triangles_by_id(workload, options));
  const auto mask = lab::portable_pixels(
      lab::portable_triangles(workload.drawable(), options), ours.width(), ours.height(),
      {.subpixel_bits = subpixel_bits, .depth = lab::find_depth_format("d32_sfloat")}, 2);
  const auto our_ids = lab::payloads_of(ours);
  PeerJudgement result;
  for (std::size_t i = 0; i < our_ids.size(); ++i) {
    if (theirs[i] == our_ids[i]) continue;
    ++result.different;
    result.wrong += mask.reasons[i] == lab::Unstable::no;
    result.tie += mask.reasons[i] == lab::Unstable::tie;
  }
  return result;
}

void PeerStage::compare(Row& row) {
  const Workload& workload = *row.workload;
  const int bits = workload.frontend_options().subpixel_bits,
            peer_bits = std::min(row.peer->subpixel_bits(), kMaxSubpixelBits);
  const auto load = [&](PeerPayload payload) {
    auto frame =
        row.peer->load(peer_scene(workload, payload, std::max(bits, peer_bits)), row.execution.threads);
    frame->draw();
    return frame;
  };

  const auto triangles = triangles_by_id(workload);
  const Framebuffer ours = picture_of_ids(workload, triangles);
  const auto their_ids = load(PeerPayload::id)->read();
  auto& loaded = loaded_[row.name] = load(PeerPayload::colour);

  if (row.peer->exact && bits == peer_bits) {
    const PeerJudgement judgement = judge(ours, their_ids, triangles);
    row.depth_ties = judgement.tie;
    if (judgement.wrong != 0)
      row.error = fmt::format("{} pixels show another triangle or none", judgement.wrong);
  } else {
    const PeerJudgement judgement = judge_portable(workload, their_ids, peer_bits);
    row.wrong_px = judgement.different;
    if (judgement.wrong != 0)
      row.error = fmt::format("{} pixels show another triangle although they are portable", judgement.wrong);
  }
  if (!row.error.empty()) return;
  if (const auto count = differing_colours(ours, their_ids, row.workload->reference(), loaded->read());
      count != 0)
    row.error = fmt::format("{} pixels have other colours", count);
}

}  // namespace edgewise::bench
