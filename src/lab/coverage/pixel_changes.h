// Changes of pixels from frame to frame of a motion. A change is superfluous if the pixel changes more often
// than by exact coverage and visibility of the positions before snapping. The counts are compared over the
// whole motion: a change that only comes late or early is none, nor is one that the truth makes before the
// first frame or after the last. One that an exact method makes, because snapping moves an edge to and fro
// across a sample, is superfluous.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace edgewise::lab {

class PixelChanges {
 public:
  // The triangle at each pixel of the next frame; all frames have one size.
  void add(std::vector<std::uint32_t> picture) {
    if (last_.empty()) count_.assign(picture.size(), 0), first_ = picture;
    for (std::size_t i = 0; i < last_.size(); ++i) count_[i] += picture[i] != last_[i];
    last_ = std::move(picture);
  }
  std::uint64_t sum() const {
    std::uint64_t sum = 0;
    for (const std::uint32_t count : count_) sum += count;
    return sum;
  }
  std::uint64_t beyond(const PixelChanges& truth) const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < count_.size(); ++i) {
      const std::uint32_t due =
          truth.count_[i] + (first_[i] != truth.first_[i]) + (last_[i] != truth.last_[i]);
      sum += count_[i] > due ? count_[i] - due : 0;
    }
    return sum;
  }

 private:
  std::vector<std::uint32_t> first_, last_, count_;
};

}  // namespace edgewise::lab
