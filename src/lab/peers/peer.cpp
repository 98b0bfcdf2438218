#include "lab/peers/peer.h"

#include <fmt/format.h>

#include <regex>
#include <stdexcept>

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

}  // namespace edgewise::lab
