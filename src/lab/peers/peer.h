// Peers are other projects' rasterizers. A peer loads a scene once, and then draws it repeatedly, so that a
// timed draw loads nothing.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lab/truth/truth.h"

namespace edgewise::lab {

struct CoverageMethod;

// One mesh for a peer's vertex buffers. A triangle's payload is that of its last vertex.
struct PeerMesh {
  std::vector<glm::vec3> positions;     // relative to the camera, as the front end makes them
  std::vector<std::uint32_t> payloads;  // one per position
  std::vector<std::uint32_t> indices;   // three per triangle; empty: every three positions are a triangle
  // Maps positions to pixels and depth in [0, 1], all multiplied by w, as the front end's matrix does.
  glm::mat4 to_screen{1.0f};
};

struct PeerScene {
  int width = 0, height = 0;  // px
  bool cull_back = false;     // front is clockwise on the y-down screen
  std::uint32_t background = 0;
  std::vector<PeerMesh> meshes;
};

// A peer's viewport: a square whose side is a power of two, centred on the image's top left corner. Clip
// coordinates are therefore our own, scaled exactly, and the drivers' screen positions are the same floats as
// our front end's. The viewport reaches far beyond the image, so that only the near and far planes clip. Most
// drivers allow no larger one, and some only a smaller one.
inline constexpr int kHalfViewport_px = 8192;
glm::mat4 to_clip(const glm::mat4& to_screen, float half_viewport_px = kHalfViewport_px);

// A scene that a peer has loaded.
class PeerFrame {
 public:
  virtual ~PeerFrame() = default;
  // Clears and draws a whole frame, and returns when every pixel is written.
  virtual void draw() = 0;
  // The payloads of the last frame, row by row from the top.
  virtual std::vector<std::uint32_t> read() = 0;
  // The duration of the last draw() by the device's own clock; none if it has none.
  virtual std::optional<double> device_s() const { return {}; }
};

struct PeerInfo {
  std::string_view name;          // in row names; differs from every backend's
  std::string_view summary = {};  // one line
  int most_threads = 1;
  bool exact =
      false;  // its picture is ours but for depth ties; others may differ in pixels that are not portable
  bool own_clock = false;  // device_s() is timed beside the wall clock
  // All three throw std::runtime_error if the peer cannot start. version() tries every number of threads.
  int (*subpixel_bits)() = nullptr;  // the fewest bits to which it rounds positions
  std::string (*version)() = nullptr;
  // `threads` is at most most_threads.
  std::unique_ptr<PeerFrame> (*load)(const PeerScene& scene, int threads) = nullptr;
};

// The peers of this build, which may not start here. The second call has only those with rows in the
// benchmark's suite.
std::span<const PeerInfo> peers();
std::span<const PeerInfo> benchmark_peers();

struct StartedPeers {
  std::vector<std::pair<const PeerInfo*, std::string>> peers;  // with their versions
  std::vector<std::string> left_out;                           // why each of the others cannot start

  // If no peer starts, throws std::runtime_error, which says why; std::invalid_argument if none was built.
  void require_one() const;
};
StartedPeers start_peers(std::span<const PeerInfo> peers);

// Beside each version of Mesa the year of its branch: "Mesa 22.3.6 (branch of 2022)". Mesa numbers its
// versions YEAR.BRANCH.PATCH (https://docs.mesa3d.org/releasing.html).
std::string with_year(const std::string& version);

// One method per peer, which draws pictures and has no depths; `started` must outlive them.
std::vector<CoverageMethod> peer_methods(const StartedPeers& started);

}  // namespace edgewise::lab
