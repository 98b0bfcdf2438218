#include "bench/peers/peer.h"

#include <vector>

namespace edgewise::bench {

#ifdef EDGEWISE_PEER_LLVMPIPE
std::string llvmpipe_version();
std::unique_ptr<PeerFrame> load_llvmpipe(const PeerScene& scene, int threads);
#endif

std::span<const PeerInfo> peers() {
  static const std::vector<PeerInfo> all{
#ifdef EDGEWISE_PEER_LLVMPIPE
      {"llvmpipe", llvmpipe_version, load_llvmpipe},
#endif
  };
  return all;
}

}  // namespace edgewise::bench
