#include "lab/peers/peer.h"

#include <optional>
#include <stdexcept>
#include <vector>

namespace edgewise::lab {

#ifdef EDGEWISE_PEER_MESA
PeerInfo llvmpipe();
PeerInfo softpipe();
#endif
#ifdef EDGEWISE_PEER_VULKAN
std::optional<PeerInfo> lavapipe(), vulkan_gpu();  // if found
#endif

glm::mat4 to_clip(const glm::mat4& to_screen) {
  glm::mat4 result = to_screen;
  for (int column = 0; column < 4; ++column)
    for (const int row : {0, 1}) result[column][row] /= kHalfViewport_px;
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
    for (const auto& found : {lavapipe(), vulkan_gpu()})
      if (found) list.push_back(*found);
#endif
    return list;
  }();
  return all;
}

std::span<const PeerInfo> benchmark_peers() {
  static const std::vector<PeerInfo> timed{
#ifdef EDGEWISE_PEER_MESA
      llvmpipe()  // softpipe is far slower, and lavapipe has llvmpipe's rasterizer
#endif
  };
  return timed;
}

void StartedPeers::require_one() const {
  if (!peers.empty()) return;
  if (left_out.empty())
    throw std::invalid_argument(
        "--peers: there is none, since OpenGL or EGL was not found (scripts/run --peers installs them)");
  std::string why;
  for (const std::string& reason : left_out) why += (why.empty() ? "" : "; ") + reason;
  throw std::runtime_error("--peers: none starts: " + why);
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

}  // namespace edgewise::lab
