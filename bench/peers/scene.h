// What a peer is given to draw for a workload, and our own picture of the same, by triangle.
#pragma once

#include "bench/peers/peer.h"
#include "bench/workloads/workload.h"

namespace edgewise::bench {

inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFu;

enum class PeerPayload {
  colour,  // over kBackground, as our backends draw
  id       // over kNoTriangle: Workload's ids
};

// `whole_frame`: the scene's meshes with their matrices, so that the peer transforms, culls and clips; else
// the front end's triangles, whose positions survive as they were snapped.
PeerScene peer_scene(const Workload& workload, bool whole_frame, PeerPayload payload);

// The front end's triangles with ids for payloads: of a mesh's triangle in submission order if `whole_frame`
// (pieces of a clipped one share theirs), else of the screen triangle.
std::vector<ScreenTriangle> triangles_by_id(const Workload& workload, bool whole_frame);

}  // namespace edgewise::bench
