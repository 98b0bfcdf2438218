#include "bench/peers/peer.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace edgewise::bench {

#ifdef EDGEWISE_PEER_MESA
PeerInfo llvmpipe();
PeerInfo softpipe();
#endif

std::span<const PeerInfo> peers() {
  static const std::vector<PeerInfo> all{
#ifdef EDGEWISE_PEER_MESA
      llvmpipe(), softpipe()
#endif
  };
  return all;
}

std::span<const PeerInfo> benchmark_peers() {
  return peers().first(std::min<std::size_t>(peers().size(), 1));  // softpipe is far slower
}

void require_peers() {
  if (peers().empty())
    throw std::invalid_argument(
        "--peers: none was built, since EGL or OpenGL was not found (scripts/run --peers installs them)");
}

}  // namespace edgewise::bench
