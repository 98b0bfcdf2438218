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

// The scene's meshes with their matrices, which the peer transforms, culls and clips, or a stream's
// triangles. The stream's positions are rounded to 1/256 px.
PeerScene peer_scene(const Workload& workload, PeerPayload payload);

// The front end's triangles with ids as payloads. An id numbers the submitted triangles; the pieces of a
// clipped triangle share its id.
std::vector<ScreenTriangle> triangles_by_id(const Workload& workload);

}  // namespace edgewise::bench
