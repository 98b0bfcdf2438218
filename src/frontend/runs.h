// What several meshes have to do, cut into runs of about the same length: a large mesh becomes many, and many
// small ones become one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "frontend/tasks.h"

namespace edgewise {

struct MeshPart {
  std::size_t mesh, begin, end;
};

class Runs {
 public:
  void clear() {
    parts_.clear();
    ends_.clear();
    total_ = room_ = 0;
  }
  void add(std::size_t mesh, std::size_t count) {
    for (std::size_t begin = 0, end; begin < count; begin = end) {
      if (room_ == 0) {
        ends_.push_back(parts_.size());
        room_ = kRun;
      }
      end = std::min(count, begin + room_);
      parts_.push_back({mesh, begin, end});
      ++ends_.back();
      room_ -= end - begin;
    }
    total_ += count;
  }

  std::size_t size() const { return ends_.size(); }
  std::span<const MeshPart> operator[](std::size_t run) const {
    const std::size_t first = run == 0 ? 0 : ends_[run - 1];
    return {parts_.data() + first, ends_[run] - first};
  }
  std::size_t total() const { return total_; }

 private:
  std::vector<MeshPart> parts_;
  std::vector<std::size_t> ends_;  // of each run, in parts_
  std::size_t total_ = 0, room_ = 0;
};

}  // namespace edgewise
