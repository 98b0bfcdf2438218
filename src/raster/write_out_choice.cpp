#include "raster/write_out_choice.h"

#include <algorithm>
#include <bit>

namespace edgewise {

namespace {

// Of so many tiles two go past the caches, and the second's time is compared with that of one nearby. There
// is a first, and some distance between the two, because who writes through the caches asks for the right
// neighbour's place.
constexpr int kGroup = 64, kPastFirst = 16, kPast = kPastFirst + 1, kThrough = kPast + 4;
constexpr std::size_t kEnoughPairs = 3;
constexpr int kEnoughTiles = (static_cast<int>(kEnoughPairs) - 1) * kGroup + kThrough + 1;

// Frames: of a look, and of these, at its beginning, those that let the caches settle.
constexpr int kLooking = 6, kSettling = 2;
// From one look to the next. It costs more where the frame is not written through the caches anyway.
constexpr int kFromThrough = 32, kFromPast = 128;

}  // namespace

void WriteOutChoice::bring_kind_to_front(const Frame& frame) {
  const Likeness like{frame.bytes, frame.tiles, static_cast<int>(std::bit_width(frame.triangle_bytes)),
                      frame.threads, all_fit_};
  auto found =
      std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& kind) { return kind.like == like; });
  if (found == kinds_.end())
    *--found = {like};
  else
    found->frame = (found->frame + 1) % (found->past ? kFromPast : kFromThrough);
  std::rotate(kinds_.begin(), found, found + 1);
}

void WriteOutChoice::begin_frame(const Frame& frame) {
  // Half of it, since whoever shows the frame and whoever makes the triangles want it, too.
  const std::size_t room = cache_bytes_ / 2;
  frame_fits_ = frame.bytes <= room;
  all_fit_ = frame.bytes + frame.triangle_bytes <= room;
  // A small frame stays even where many share, and there the other way costs most.
  in_doubt_ = frame_fits_ && frame.bytes > room / 4 && frame.tiles >= kEnoughTiles;
  if (in_doubt_) bring_kind_to_front(frame);
  Kind& kind = kinds_.front();
  looks_ = in_doubt_ && kind.frame < kLooking;
  if (!looks_) return;
  pairs_.fill({});
  if (kind.frame == 0) kind.votes = kind.votes_past = 0;
}

WriteOutChoice::ForTile WriteOutChoice::for_tile(int tile, bool empty) {
  // Tiles without triangles are filled in a burst that no work hides, and want nothing else from the caches.
  if (!(empty ? frame_fits_ : all_fit_)) return {WriteOut::past_caches};
  if (!in_doubt_) return {WriteOut::through_caches};
  if (!looks_) return {kinds_.front().past ? WriteOut::past_caches : WriteOut::through_caches};
  const auto group = static_cast<std::size_t>(tile / kGroup);
  if (group >= kPairs) return {WriteOut::through_caches};
  Pair& pair = pairs_[group];
  switch (tile % kGroup) {
    case kPastFirst:
      return {WriteOut::past_caches};
    case kPast:
      pair.past_empty = empty;
      return {WriteOut::past_caches, &pair.past_ns};
    case kThrough:
      pair.through_empty = empty;
      return {WriteOut::through_caches, &pair.through_ns};
    default:
      return {WriteOut::through_caches};
  }
}

void WriteOutChoice::end_frame() {
  Kind& kind = kinds_.front();
  if (!looks_ || kind.frame < kSettling) return;
  std::array<double, kPairs> ratios;  // past / through
  std::size_t count = 0;
  for (const Pair& pair : pairs_)
    if (pair.through_ns > 0 && pair.past_ns > 0 && pair.through_empty == pair.past_empty)
      ratios[count++] = static_cast<double>(pair.past_ns) / static_cast<double>(pair.through_ns);
  if (count >= kEnoughPairs) {
    const auto median = ratios.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(ratios.begin(), median, ratios.begin() + static_cast<std::ptrdiff_t>(count));
    constexpr double kClearlyLess = 0.9;
    ++kind.votes;
    kind.votes_past += *median < kClearlyLess;
  }
  if (kind.frame == kLooking - 1 && kind.votes > 0) kind.past = 2 * kind.votes_past > kind.votes;
}

}  // namespace edgewise
