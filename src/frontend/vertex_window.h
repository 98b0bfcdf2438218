// The vertices that one worker has transformed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/buffer.h"
#include "frontend/tasks.h"
#include "frontend/transform.h"

namespace edgewise {

// Holds transformed vertices: all from the lowest to the highest index that the last triangles name, in
// granules of 256. A granule stays until another one takes its place. Each worker has a window of its own: a
// vertex that two workers need is transformed twice, which costs less than fetching it from another core's
// cache.
class VertexWindow {
 public:
  // Room for the vertices of meshes of up to `most_vertices`. Larger meshes may need scattered().
  void reserve(std::size_t most_vertices) {
    vertices_.reserve(std::min(kVertices, (most_vertices + kGranule - 1) / kGranule * kGranule));
    if (most_vertices <= kVertices || !in_order_.empty()) return;
    positions_.reserve(3 * kChunkTriangles);
    in_order_.reserve(kChunkTriangles);
    for (std::uint32_t i = 0; i < kChunkTriangles; ++i) in_order_.push_back(3 * i + glm::uvec3{0, 1, 2});
  }
  // Empties the window for another mesh.
  void start(const Mesh& mesh) {
    std::fill_n(granules_, std::min(mesh.positions.size() / kGranule + 1, kSlots), 0u);
  }
  // Returns the corners of triangles begin … end - 1, at most kChunkTriangles, whose vertices exist and lie
  // in `range`.
  Corners corners(const MeshTask& task, std::size_t begin, std::size_t end, IndexRange range,
                  TransformKernel transform) {
    const std::size_t first = range.first / kGranule, last = range.last / kGranule + 1;
    if (last - first > kSlots) return scattered(task, begin, end, transform);
    fill(task, first, last, transform);
    return {vertices_.data(), task.mesh.triangles.data() + begin};
  }
  // Transforms granules first … last - 1 that the window lacks. Returns what TransformKernel does, of these.
  std::uint32_t fill(const MeshTask& task, std::size_t first, std::size_t last, TransformKernel transform) {
    std::uint32_t common = kInvisible | kNotFinite;
    for (std::size_t begin = first, end; begin < last; begin = end) {
      end = begin + 1;
      if (holds(begin)) continue;
      while (end < last && end % kSlots != 0 && !holds(end)) ++end;
      for (std::size_t i = begin; i < end; ++i) granules_[i % kSlots] = static_cast<std::uint32_t>(i + 1);
      const std::size_t vertex = begin * kGranule,
                        count = std::min(end * kGranule, task.mesh.positions.size()) - vertex;
      common &=
          transform(task, task.mesh.positions.data() + vertex, count, vertices_.data() + vertex % kVertices);
    }
    return common;
  }

  static constexpr std::size_t kGranule = 256;                  // vertices
  static constexpr std::size_t kVertices = Corners::kVertices;  // of the window
  static constexpr std::size_t kBytes = kVertices * sizeof(Vertex) + 3 * kChunkTriangles * sizeof(glm::vec3) +
                                        kChunkTriangles * sizeof(glm::uvec3);

 private:
  static constexpr std::size_t kSlots = kVertices / kGranule;

  bool holds(std::size_t granule) const { return granules_[granule % kSlots] == granule + 1; }

  // For triangles whose vertices lie too far apart: transforms a vertex as often as they name it.
  Corners scattered(const MeshTask& task, std::size_t begin, std::size_t end, TransformKernel transform) {
    positions_.clear();
    for (std::size_t i = begin; i < end; ++i)
      for (int k = 0; k < 3; ++k) positions_.push_back(task.mesh.positions[task.mesh.triangles[i][k]]);
    std::fill_n(granules_, kSlots, 0u);
    transform(task, positions_.data(), positions_.size(), vertices_.data());
    return {vertices_.data(), in_order_.data()};
  }

  Buffer<Vertex> vertices_;           // of granule g: from (g % kSlots) · kGranule on
  std::uint32_t granules_[kSlots]{};  // by slot; 1 more than the granule; 0: empty
  std::vector<glm::vec3> positions_;  // of scattered()
  std::vector<glm::uvec3> in_order_;  // its corners: 0, 1, 2, 3, …
};

}  // namespace edgewise
