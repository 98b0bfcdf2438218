// Peers (other projects' rasterizers) in the benchmark's suite: converts a workload to a peer's scene,
// compares the peer's picture with ours, and times the peer.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/row.h"
#include "lab/truth/truth.h"

namespace edgewise::bench {

using lab::kNoTriangle, lab::PeerFrame, lab::PeerInfo, lab::PeerMesh, lab::PeerScene;

enum class PeerPayload {
  colour,  // over kBackground, as our backends draw
  id       // over kNoTriangle, the ids of triangles_by_id()
};

// The scene's meshes with their matrices, which the peer transforms, culls and clips, or a stream's
// triangles. The stream's positions are rounded to so many subpixel bits.
PeerScene peer_scene(const Workload& workload, PeerPayload payload, int subpixel_bits = 8);

// The front end's triangles with ids as payloads. An id numbers the submitted triangles; the pieces of a
// clipped triangle share its id.
std::vector<ScreenTriangle> triangles_by_id(const Workload& workload);

// In how many pixels a peer's picture differs from ours. Both are drawn with triangle ids as payloads, over
// kNoTriangle. A tie is another triangle at a depth within tolerance.
struct PeerJudgement {
  std::uint64_t different = 0, wrong = 0, tie = 0;
};

// The bound on a peer's depth error for a triangle, in contract depth units. The peer evaluates
// z = a + x dz/dx + y dz/dy in floats of 24-bit significand. A thin triangle's gradients, and with them the
// rounding errors of the products, grow with the square of its length over its area.
double float_plane_error(const ScreenTriangle& triangle, int width, int height);

// `ours` was drawn from `triangles`, which are sorted by payload. `theirs` has the same size, row by row.
PeerJudgement judge(const Framebuffer& ours, std::span<const std::uint32_t> theirs,
                    std::span<const ScreenTriangle> triangles);

// Wrong are the pixels that `portable` says are the same in every picture of a rasterizer with so many
// subpixel bits and a float depth buffer. Ties are in its mask for a tie alone. Ours has no fewer bits.
PeerJudgement judge_portable(const Workload& workload, std::span<const std::uint32_t> theirs,
                             int subpixel_bits);

class PeerStage {
 public:
  // Draws the row's scene twice, with triangle ids and with colours. Keeps the scene loaded in the peer.
  // Requires a prepared workload. The row has an error if a triangle that both show has another colour, and
  // - if the peer is exact: if the coverage differs, or a visible triangle beyond a depth tie within
  // tolerance; sets
  //   depth_ties;
  // - else: if a portable pixel differs; sets wrong_px.
  void compare(Row& row);

  // Draws one frame of a row that compare() has loaded.
  void work(const Row& row) { loaded_.at(row.name)->draw(); }
  // The duration of the last frame by the clock of the peer's device.
  double device_s(const Row& row) const { return loaded_.at(row.name)->device_s().value(); }

 private:
  std::map<std::string, std::unique_ptr<PeerFrame>> loaded_;  // by row name
};

}  // namespace edgewise::bench
