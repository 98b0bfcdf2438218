#include "bench/peers/stage.h"

#include <fmt/format.h>

#include "bench/peers/judge.h"
#include "bench/peers/scene.h"

namespace edgewise::bench {

namespace {

// The pixels that show the same triangle in both pictures, but another colour.
std::uint64_t differing_colours(const Framebuffer& ids, std::span<const std::uint32_t> their_ids,
                                const Framebuffer& colours, std::span<const std::uint32_t> their_colours) {
  std::uint64_t count = 0;
  std::size_t i = 0;
  for (int y = 0; y < ids.height(); ++y)
    for (int x = 0; x < ids.width(); ++x, ++i)
      count += ids.payload_row(y)[x] == their_ids[i] && colours.payload_row(y)[x] != their_colours[i];
  return count;
}

}  // namespace

void PeerStage::compare(Row& row) {
  const Workload& workload = *row.workload;
  const auto load = [&](PeerPayload payload) {
    auto frame = row.peer->load(peer_scene(workload, payload), row.execution.threads);
    frame->draw();
    return frame;
  };

  const auto triangles = triangles_by_id(workload);
  Framebuffer ours(workload.width(), workload.height());
  backends().front().make()->draw(triangles, ours.view(), kNoTriangle, {});
  const auto their_ids = load(PeerPayload::id)->read();
  auto& loaded = loaded_[row.name] = load(PeerPayload::colour);

  const PeerJudgement judgement = judge(ours, their_ids, triangles);
  row.depth_ties = judgement.depth_ties;
  if (judgement.wrong() != 0)
    row.error = fmt::format(
        "{} pixels are drawn in only one of the two pictures, {} show another triangle, the first at ({}, "
        "{})",
        judgement.coverage, judgement.other_triangles, judgement.first_x, judgement.first_y);
  else if (const auto count = differing_colours(ours, their_ids, row.workload->reference(), loaded->read());
           count != 0)
    row.error = fmt::format("{} pixels have other colours", count);
}

}  // namespace edgewise::bench
