#include <algorithm>

#include "lab/coverage/coverage.h"
#include "lab/peers/peer.h"

namespace edgewise::lab {

namespace {

// Positions before snapping, so that a peer's own snapping decides.
PeerScene scene_of(std::span<const FloatTriangle> triangles, Window window) {
  PeerScene scene{window.width, window.height, false, 0, {}};
  PeerMesh& mesh = scene.meshes.emplace_back();
  for (const FloatTriangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.positions.emplace_back(t.at.x_px[k], t.at.y_px[k], t.at.z01[k]);
      mesh.payloads.push_back(t.payload);
    }
  return scene;
}

void draw(const PeerInfo& peer, const CoverageInput& input, Canvas& canvas, const Execution& execution) {
  const auto loaded = peer.load(scene_of(input.floats, canvas.window()), execution.threads);
  loaded->draw();
  const auto payloads = loaded->read();
  const FrameView view = canvas.frame.view();
  for (std::ptrdiff_t y = 0; y < view.height; ++y)
    std::copy_n(payloads.begin() + y * view.width, view.width, view.payload + y * view.stride);
}

}  // namespace

std::vector<CoverageMethod> peer_methods(const StartedPeers& started) {
  std::vector<CoverageMethod> list;
  for (const auto& [peer, version] : started.peers)
    list.push_back({.info = {peer->name, peer->summary, version, "none; errors are measured only", false},
                    .promise = {},
                    .draw = [peer = peer](const CoverageInput& input, Canvas& canvas,
                                          const Execution& how) { draw(*peer, input, canvas, how); },
                    .runs = {},
                    .threaded = peer->most_threads > 1,
                    .one_thread = true});
  return list;
}

}  // namespace edgewise::lab
