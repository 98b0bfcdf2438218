// Makes the screen triangles of a scene on several threads, each of which transforms the vertices that its
// own triangles name.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "frontend/mesh_clusters.h"
#include "frontend/shade.h"
#include "frontend/submission.h"
#include "frontend/tasks.h"
#include "frontend/transform.h"
#include "frontend/vertex_window.h"

namespace edgewise {

class SceneMaker {
 public:
  // `states` holds one per submitted triangle, to be written, or is null. The arguments must outlive the
  // frame. Throws as Frontend::run() does.
  void start_frame(const Scene& scene, const FrontendOptions& options, SimdTarget target,
                   TriangleState* states, int workers);
  // Appends the visible triangles of the submitted triangles begin … end - 1. Calls ready() before each
  // chunk of them. Calls with different workers may run at once. Does not throw.
  template <typename Ready>
  void make(int worker, std::size_t begin, std::size_t end, ChunkOutput& out, Ready&& ready) {
    Worker& w = workers_[static_cast<std::size_t>(worker)];
    for (std::size_t instance = instance_of(first_ids_, begin); begin < end; ++instance) {
      const std::size_t first = first_ids_[instance], last = std::min(end, first_ids_[instance + 1]);
      if (begin == last) continue;
      if (w.instance != instance) start_instance(w, instance);
      for (std::size_t i = begin - first; i < last - first;) {
        ready();
        i = make_some(w, i, last - first, out);
      }
      begin = last;
    }
  }
  // Adds the counts that no output has. Throws std::invalid_argument if a triangle in view names a vertex
  // that its mesh lacks.
  void end_frame(FrontendStats& stats);

 private:
  enum Sight : std::uint8_t {
    unknown,   // with clusters: all so far are out of view
    in_sight,  // not all vertices lie beyond one side, or none is finite, or a cluster is in view
    out_of_sight
  };

  struct alignas(128) Worker {
    std::size_t instance = ~std::size_t{0};  // whose vertices the window holds
    std::optional<MeshTask> task;
    std::optional<ShadeTask> light;
    std::optional<ViewSides> sides;  // for meshes with clusters
    VertexWindow window;
  };

  const Mesh& mesh_of(std::size_t instance) const { return scene_->meshes[scene_->instances[instance].mesh]; }
  void start_instance(Worker& w, std::size_t instance);
  // Makes or drops triangles from `begin` on. Returns the first one left.
  std::size_t make_some(Worker& w, std::size_t begin, std::size_t end, ChunkOutput& out);
  void make_visible(Worker& w, std::size_t begin, std::size_t end, ChunkOutput& out);
  // For meshes without clusters. Transforms vertices until it is known.
  Sight find_sight(Worker& w);

  const Scene* scene_ = nullptr;
  FrontendOptions options_;
  TriangleState* states_ = nullptr;
  std::optional<View> view_;
  glm::dvec3 to_light_;
  TransformKernel transform_ = nullptr;
  IndexRangeKernel index_range_ = nullptr;
  AssembleKernel assemble_ = nullptr;
  ShadeKernel shade_ = nullptr;
  std::vector<std::size_t> first_ids_;  // by instance: its first triangle; then the number of triangles
  std::vector<std::uint8_t> sights_;    // Sight, by instance; accessed atomically
  std::vector<Worker> workers_;
  std::atomic<bool> vertex_missing_{false};
};

}  // namespace edgewise
