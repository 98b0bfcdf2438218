#include <algorithm>
#include <cmath>

#include "lab/cases/backend_comparison.h"
#include "lab/coverage/coverage.h"
#include "lab/coverage/cracks.h"
#include "lab/peers/peer.h"
#include "scene/streams.h"

namespace edgewise::lab {

namespace {

void draw_all(const PeerInfo& peer, const CoverageInput& input, Canvas& canvas, const Execution& execution) {
  const auto loaded = peer.load(peer_scene(input.floats, canvas.window(), 0), execution.threads);
  loaded->draw();
  const auto payloads = loaded->read();
  const auto depths = loaded->read_depths();
  const FrameView view = canvas.frame.view();
  for (std::ptrdiff_t y = 0; y < view.height; ++y) {
    std::copy_n(payloads.begin() + y * view.width, view.width, view.payload + y * view.stride);
    std::copy_n(depths.begin() + y * view.width, view.width, canvas.depth.begin() + y * view.stride);
  }
}

// A peer shows visible triangles only, so it draws triangles with disjoint bounding boxes together. The
// margin leaves room for a peer that snaps vertices more coarsely than we do.
void append_peer_runs(const PeerInfo& peer, const CoverageInput& input, Window window,
                      std::vector<Run>& runs) {
  constexpr int kMargin_px = 1;
  std::vector<FloatTriangle> members;
  for (const auto& set : disjoint_sets(input.snapped, window.width, window.height, kMargin_px)) {
    members.clear();
    for (const std::uint32_t i : set) members.push_back({input.floats[i].at, i});
    const auto loaded = peer.load(peer_scene(members, window, kNoTriangle), 1);
    loaded->draw();
    const auto ids = loaded->read();
    for (int y = 0; y < window.height; ++y)
      append_runs(std::span(ids).subspan(static_cast<std::size_t>(y) * static_cast<std::size_t>(window.width),
                                         static_cast<std::size_t>(window.width)),
                  y, 0, runs);
  }
}

// Whether it covers a mesh exactly as if positions were rounded to the bits that it reports. A driver may
// report fewer bits than it keeps.
bool rounds_as_reported(const PeerInfo& peer) {
  constexpr Window window{480, 270};  // large enough that 8 bits and more bits differ
  const auto triangles =
      float_triangles(jittered_grid({.width = window.width, .height = window.height}, 12.0, 7));
  const auto grid = snapped(triangles);
  std::vector<Run> drawn;
  append_peer_runs(peer, {triangles, grid}, window, drawn);
  return std::ranges::equal(DrawnRuns(std::move(drawn), window).runs,
                            covered_runs(rounded_to(triangles, peer.subpixel_bits()), window, 1));
}

}  // namespace

PeerScene peer_scene(std::span<const FloatTriangle> triangles, Window window, std::uint32_t background) {
  PeerScene scene{window.width, window.height, false, background, {}};
  PeerMesh& mesh = scene.meshes.emplace_back();
  for (const FloatTriangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.positions.emplace_back(t.at.x_px[k], t.at.y_px[k], t.at.z01[k]);
      mesh.payloads.push_back(t.payload);
    }
  return scene;
}

std::vector<CoverageMethod> peer_methods(const StartedPeers& started) {
  std::vector<CoverageMethod> list;
  for (const auto& [peer, version] : started.peers) {
    const double snap_px = std::sqrt(2.0) / 2 / (1 << peer->subpixel_bits());  // half a unit on both axes
    list.push_back(
        {.info = {peer->name, peer->summary, version, "none; errors are measured only", false},
         .promise = {.reach_px = snap_px,
                     .snap_bits = rounds_as_reported(*peer) ? peer->subpixel_bits() : kUnknownSnap},
         .draw = [peer = peer](const CoverageInput& input, Canvas& canvas,
                               const Execution& how) { draw_all(*peer, input, canvas, how); },
         .runs = [peer = peer](const CoverageInput& input, Window window,
                               std::vector<Run>& runs) { append_peer_runs(*peer, input, window, runs); },
         .threaded = peer->most_threads > 1,
         .one_thread = true});
  }
  return list;
}

}  // namespace edgewise::lab
