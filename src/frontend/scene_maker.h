// Makes the screen triangles of a scene on several threads, each of which transforms the vertices that its
// own triangles name.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "frontend/mesh_clusters.h"
#include "frontend/shade.h"
#include "frontend/transform.h"
#include "frontend/triangle_maker.h"
#include "frontend/vertex_window.h"

namespace edgewise {

class SceneMaker final : public TriangleMaker {
 public:
  // The arguments must outlive the frame. Throws as Frontend::run() does.
  void set(const Scene& scene, const FrontendOptions& options, SimdTarget target);
  void start_workers(int workers, std::size_t inputs, TriangleState* states) override;
  std::size_t size() const override { return first_ids_.back(); }
  void append(int worker, std::size_t begin, std::size_t end, ChunkOutput& out) override;
  // Throws std::invalid_argument if a triangle in view names a vertex that its mesh lacks.
  void finish() override;

 private:
  enum Sight : std::uint8_t {
    unknown,   // with clusters: all so far are out of view
    in_sight,  // not all vertices lie beyond one side, or none is finite, or a cluster is in view
    out_of_sight
  };

  struct alignas(64) Worker {
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
