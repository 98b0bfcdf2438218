// Cuts the vertices or triangles of several meshes into chunks of kChunkTriangles: a large mesh spans many
// chunks, and one chunk spans many small meshes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "frontend/tasks.h"

namespace edgewise {

// Elements begin … end - 1 of a mesh.
struct MeshPart {
  std::size_t mesh, begin, end;
};

class Chunks {
 public:
  void clear() {
    parts_.clear();
    ends_.clear();
    total_ = room_ = 0;
  }
  // Appends the `count` elements of a mesh.
  void add(std::size_t mesh, std::size_t count) {
    for (std::size_t begin = 0, end; begin < count; begin = end) {
      if (room_ == 0) {
        ends_.push_back(parts_.size());
        room_ = kChunkTriangles;
      }
      end = std::min(count, begin + room_);
      parts_.push_back({mesh, begin, end});
      ++ends_.back();
      room_ -= end - begin;
    }
    total_ += count;
  }

  std::size_t size() const { return ends_.size(); }  // chunks
  std::span<const MeshPart> operator[](std::size_t chunk) const {
    const std::size_t first = chunk == 0 ? 0 : ends_[chunk - 1];
    return {parts_.data() + first, ends_[chunk] - first};
  }
  std::size_t total() const { return total_; }  // elements

 private:
  std::vector<MeshPart> parts_;
  std::vector<std::size_t> ends_;     // the end of each chunk in parts_
  std::size_t total_ = 0, room_ = 0;  // elements: in all chunks; that still fit the last chunk
};

}  // namespace edgewise
