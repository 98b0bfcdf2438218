// Rasterizers of other projects that draw the benchmark's scenes beside our backends, in the same run. A peer
// is handed a scene before the clock starts, and draws it as often as asked.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace edgewise::bench {

// One mesh as a peer's vertex buffers hold it. A triangle's payload is that of its last vertex.
struct PeerMesh {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> payloads;  // one a position
  std::vector<std::uint32_t> indices;   // three a triangle; none: three positions in a row are one
  // Position → pixels and depth in [0, 1], all times w, as the front end's.
  glm::mat4 to_screen{1.0f};
};

struct PeerScene {
  int width = 0, height = 0;  // px
  bool cull_back = false;     // front is clockwise on the y-down screen
  std::uint32_t background = 0;
  std::vector<PeerMesh> meshes;
};

// A scene in the peer's memory.
class PeerFrame {
 public:
  virtual ~PeerFrame() = default;
  // Clears and draws a whole frame, and returns when every pixel is written.
  virtual void draw() = 0;
  // The payloads of the last frame, row by row from the top.
  virtual std::vector<std::uint32_t> read() = 0;
};

struct PeerInfo {
  std::string_view name;  // as in row names; no backend's
  std::string (*version)();
  // `threads` is 1 or 2. Throws std::runtime_error where the peer cannot start.
  std::unique_ptr<PeerFrame> (*load)(const PeerScene& scene, int threads);
};

// Those that were built.
std::span<const PeerInfo> peers();

}  // namespace edgewise::bench
