#include "cli/accuracy/peers.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "bench/peers/peer.h"
#include "lab/measure.h"
#include "support/console.h"

namespace edgewise::tools {

namespace {

using lab::CoverageInput;
using lab::Window;

// Positions before snapping, so that a peer's own snapping decides.
bench::PeerScene peer_scene(std::span<const lab::FloatTriangle> triangles, Window window,
                            std::uint32_t background) {
  bench::PeerScene scene{window.width, window.height, false, background, {}};
  bench::PeerMesh& mesh = scene.meshes.emplace_back();
  for (const lab::FloatTriangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.positions.emplace_back(t.at.x_px[k], t.at.y_px[k], t.at.z01[k]);
      mesh.payloads.push_back(t.payload);
    }
  return scene;
}

void draw(const bench::PeerInfo& peer, const CoverageInput& input, lab::Canvas& canvas,
          const Execution& execution) {
  const auto loaded = peer.load(peer_scene(input.floats, canvas.window(), 0), execution.threads);
  loaded->draw();
  const auto payloads = loaded->read();
  const auto depths = loaded->read_depths();
  const FrameView view = canvas.frame.view();
  for (std::ptrdiff_t y = 0; y < view.height; ++y) {
    std::copy_n(payloads.begin() + y * view.width, view.width, view.payload + y * view.stride);
    std::copy_n(depths.begin() + y * view.width, view.width, canvas.depth.begin() + y * view.stride);
  }
}

// A peer shows visible triangles only, so it draws triangles with disjoint bounding boxes together. The
// margin leaves room for a peer that snaps vertices more coarsely than we do.
void append_runs(const bench::PeerInfo& peer, const CoverageInput& input, Window window,
                 std::vector<lab::Run>& runs) {
  constexpr int kMargin_px = 1;
  std::vector<lab::FloatTriangle> members;
  for (const auto& set : lab::disjoint_sets(input.snapped, window.width, window.height, kMargin_px)) {
    members.clear();
    for (const std::uint32_t i : set) members.push_back({input.floats[i].at, i});
    const auto loaded = peer.load(peer_scene(members, window, lab::kNoTriangle), 1);
    loaded->draw();
    const auto ids = loaded->read();
    for (int y = 0; y < window.height; ++y)
      lab::append_runs(
          std::span(ids).subspan(static_cast<std::size_t>(y) * static_cast<std::size_t>(window.width),
                                 static_cast<std::size_t>(window.width)),
          y, 0, runs);
  }
}

lab::CoverageMethod method_of(const bench::PeerInfo& peer, std::string_view version) {
  const double snap_px = std::sqrt(2.0) / 2 / (1 << peer.subpixel_bits());  // half a unit on both axes
  return {.info = {peer.name, peer.summary, version, "none; errors are measured only", false},
          .promise = {.reach_px = snap_px},
          .draw = [&peer](const CoverageInput& input, lab::Canvas& canvas,
                          const Execution& execution) { draw(peer, input, canvas, execution); },
          .runs = [&peer](const CoverageInput& input, Window window,
                          std::vector<lab::Run>& runs) { append_runs(peer, input, window, runs); },
          .threaded = peer.most_threads > 1,
          .simd_note = "it chooses its own vectors",
          .load =
              [&peer](const CoverageInput& input, Window window, const Execution& execution) {
                std::shared_ptr loaded = peer.load(peer_scene(input.floats, window, 0), execution.threads);
                return [loaded] { loaded->draw(); };
              }};
}

}  // namespace

std::span<const lab::CoverageMethod> peer_methods() {
  static const bench::StartedPeers started = [] {
    bench::require_peers(bench::peers());
    bench::StartedPeers found = bench::start_peers(bench::peers());
    found.require_one();
    for (const std::string& reason : found.left_out) print_error("left out: " + reason);
    return found;
  }();
  static const std::vector<lab::CoverageMethod> methods = [] {
    std::vector<lab::CoverageMethod> list;
    for (const auto& [peer, version] : started.peers) list.push_back(method_of(*peer, version));
    return list;
  }();
  return methods;
}

}  // namespace edgewise::tools
