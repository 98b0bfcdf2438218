#include "lab/peers/peer.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <stdexcept>

#include "lab/coverage/coverage.h"

namespace edgewise::lab {

#ifdef EDGEWISE_PEER_MESA
PeerInfo llvmpipe();
PeerInfo softpipe();
#endif
#ifdef EDGEWISE_PEER_VULKAN
PeerInfo lavapipe(), swiftshader(), vulkan_gpu();
#endif

glm::mat4 to_clip(const glm::mat4& to_screen, float half_viewport_px) {
  glm::mat4 result = to_screen;
  for (int column = 0; column < 4; ++column)
    for (const int row : {0, 1}) result[column][row] /= half_viewport_px;
  return result;
}

std::span<const PeerInfo> peers() {
  static const std::vector<PeerInfo> all = [] {
    std::vector<PeerInfo> list;
#ifdef EDGEWISE_PEER_MESA
    list.push_back(llvmpipe());
    list.push_back(softpipe());
#endif
#ifdef EDGEWISE_PEER_VULKAN
    for (const PeerInfo& peer : {lavapipe(), swiftshader(), vulkan_gpu()}) list.push_back(peer);
#endif
    return list;
  }();
  return all;
}

std::span<const PeerInfo> benchmark_peers() {
  static const std::vector<PeerInfo> timed = [] {
    std::vector<PeerInfo> list(peers().begin(), peers().end());
    // softpipe is far slower than llvmpipe, and lavapipe has llvmpipe's rasterizer.
    std::erase_if(list,
                  [](const PeerInfo& peer) { return peer.name == "softpipe" || peer.name == "lavapipe"; });
    return list;
  }();
  return timed;
}

void StartedPeers::require_one() const {
  if (!peers.empty()) return;
  if (left_out.empty())
    throw std::invalid_argument(
        "--peers: there is none, since neither OpenGL with EGL nor Vulkan was found (scripts/run --peers "
        "installs them)");
  throw std::runtime_error(fmt::format("--peers: none starts: {}", fmt::join(left_out, "; ")));
}

StartedPeers start_peers(std::span<const PeerInfo> peers) {
  StartedPeers started;
  for (const PeerInfo& peer : peers) try {
      started.peers.emplace_back(&peer, peer.version());
    } catch (const std::runtime_error& error) {
      started.left_out.emplace_back(error.what());
    }
  return started;
}

std::string with_year(const std::string& version) {
  return std::regex_replace(version, std::regex(R"(Mesa (\d\d)\.\d+\.\d+)"), "$& (branch of 20$1)");
}

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
