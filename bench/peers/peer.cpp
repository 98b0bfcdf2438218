#include "bench/peers/peer.h"

#include <optional>
#include <stdexcept>
#include <vector>

namespace edgewise::bench {

#ifdef EDGEWISE_PEER_MESA
PeerInfo llvmpipe();
PeerInfo softpipe();
#endif
#ifdef EDGEWISE_PEER_VULKAN
PeerInfo lavapipe();
std::optional<PeerInfo> vulkan_gpu();
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
    list.push_back(lavapipe());
    if (const auto gpu = vulkan_gpu()) list.push_back(*gpu);
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

void require_peers() {
  if (peers().empty())
    throw std::invalid_argument(
        "--peers: none was built, since neither OpenGL with EGL nor Vulkan was found (scripts/run --peers "
        "installs them)");
}

}  // namespace edgewise::bench
