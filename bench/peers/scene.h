// Converts a workload to a peer's scene, and gives our triangles by id to compare the pictures.
#pragma once

#include "bench/peers/peer.h"
#include "bench/workloads/workload.h"

namespace edgewise::bench {

inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFu;

enum class PeerPayload {
  colour,  // over kBackground, as our backends draw
  id       // over kNoTriangle, the ids of triangles_by_id()
};

// With `whole_frame`, the scene's meshes with their matrices, which the peer transforms, culls and clips.
// Otherwise the front end's triangles, with their snapped positions unchanged.
PeerScene peer_scene(const Workload& workload, bool whole_frame, PeerPayload payload);

// The front end's triangles with ids as payloads. With `whole_frame` an id numbers the scene's triangles in
// submission order (the pieces of a clipped triangle share its id), otherwise the screen triangles.
std::vector<ScreenTriangle> triangles_by_id(const Workload& workload, bool whole_frame);

}  // namespace edgewise::bench
