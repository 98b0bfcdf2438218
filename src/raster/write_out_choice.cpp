#include "raster/write_out_choice.h"

#include <algorithm>

namespace edgewise {

namespace {

constexpr int kGroup = 64;  // tiles
// Places in a group. `kOtherFirst` and the one after it are written the other way.
constexpr int kOtherFirst = 16, kOther = kOtherFirst + 1, kUsual = 48;

}  // namespace

WriteOutChoice::WriteOutChoice(std::size_t cache_bytes) : cache_bytes_(cache_bytes) {}

void WriteOutChoice::begin_frame(std::size_t frame_bytes, std::size_t triangle_bytes, int threads) {
  // Half of it, since whoever shows the frame and whoever makes the triangles want it, too.
  const std::size_t room = cache_bytes_ / 2;
  frame_fits_ = frame_bytes <= room;
  all_fit_ = frame_bytes + triangle_bytes <= room;
  constexpr int kLooking = 6, kInAll = 32;  // frames
  const bool as_before = frame_bytes == frame_bytes_ && threads == threads_;
  frame_ = as_before ? (frame_ + 1) % kInAll : 0;
  if (frame_ == 0) frames_against_ = 0;
  frame_bytes_ = frame_bytes, threads_ = threads;
  // A small frame stays even where many share, and there the other way costs most.
  in_doubt_ = frame_fits_ && frame_bytes > room / 4;
  looks_ = in_doubt_ && frame_ < kLooking;
  pairs_.fill({});
}

WriteOutChoice::ForTile WriteOutChoice::for_tile(int tile, bool empty) {
  // Tiles without triangles are filled in a burst that no work hides, and want nothing else from the caches.
  if (!(empty ? frame_fits_ : all_fit_)) return {WriteOut::past_caches};
  if (!in_doubt_) return {WriteOut::through_caches};
  const int place = tile % kGroup;
  const bool other = looks_ && (place == kOtherFirst || place == kOther);
  ForTile out{rather_past_ != other ? WriteOut::past_caches : WriteOut::through_caches};
  if (!looks_) return out;
  const auto group = static_cast<std::size_t>(tile / kGroup);
  if (group < kGroups && place == kOther) {
    out.elapsed_ns = &pairs_[group].other_ns;
    pairs_[group].other_empty = empty;
  } else if (group < kGroups && place == kUsual) {
    out.elapsed_ns = &pairs_[group].usual_ns;
    pairs_[group].usual_empty = empty;
  }
  return out;
}

void WriteOutChoice::end_frame() {
  std::array<double, kGroups> ratios;  // other / usual
  std::size_t count = 0;
  for (const Pair& pair : pairs_)
    if (pair.usual_ns > 0 && pair.other_ns > 0 && pair.usual_empty == pair.other_empty)
      ratios[count++] = static_cast<double>(pair.other_ns) / static_cast<double>(pair.usual_ns);
  constexpr std::size_t kEnough = 4;
  if (count < kEnough) return;
  const auto median = ratios.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(ratios.begin(), median, ratios.begin() + static_cast<std::ptrdiff_t>(count));
  constexpr double kClearlyLess = 0.9;
  constexpr int kFrames = 3;
  frames_against_ = *median < kClearlyLess ? frames_against_ + 1 : 0;
  if (frames_against_ < kFrames) return;
  rather_past_ = !rather_past_;
  frames_against_ = 0;
}

}  // namespace edgewise
