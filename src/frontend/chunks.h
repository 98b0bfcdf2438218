// Cuts the vertices or triangles of several meshes into chunks of kChunkTriangles: a large mesh spans many
// chunks, and one chunk spans many small meshes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "frontend/mesh_clusters.h"
#include "frontend/tasks.h"

namespace edgewise {

// Vertices or triangles begin … end - 1 of a part, which has this index in its group.
struct PartRange {
  std::size_t part, begin, end;
  VertexRange allowed;  // of triangles: vertices that they may name
};

class Chunks {
 public:
  void clear() {
    ranges_.clear();
    ends_.clear();
    total_ = room_ = 0;
  }
  // Makes room for `count` elements from up to `ranges` calls of add().
  void reserve(std::size_t count, std::size_t ranges) {
    const std::size_t chunks = count / kChunkTriangles + 1;
    ranges_.reserve(ranges + chunks);
    ends_.reserve(chunks);
  }
  // Appends `count` elements from index `first` on.
  void add(std::size_t part, std::size_t first, std::size_t count, VertexRange allowed = {}) {
    const std::size_t last = first + count;
    for (std::size_t begin = first, end; begin < last; begin = end) {
      if (room_ == 0) {
        ends_.push_back(ranges_.size());
        room_ = kChunkTriangles;
      }
      end = std::min(last, begin + room_);
      ranges_.push_back({part, begin, end, allowed});
      ++ends_.back();
      room_ -= end - begin;
    }
    total_ += count;
  }

  std::size_t size() const { return ends_.size(); }  // chunks
  std::span<const PartRange> operator[](std::size_t chunk) const {
    const std::size_t first = chunk == 0 ? 0 : ends_[chunk - 1];
    return {ranges_.data() + first, ends_[chunk] - first};
  }
  std::size_t total() const { return total_; }  // elements

 private:
  std::vector<PartRange> ranges_;
  std::vector<std::size_t> ends_;     // the end of each chunk in ranges_
  std::size_t total_ = 0, room_ = 0;  // elements: in all chunks; that still fit the last chunk
};

}  // namespace edgewise
