#include "edgewise/barycentrics.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "core/execution.h"
#include "core/float_state.h"
#include "core/overlap.h"
#include "core/parallel.h"
#include "edgewise/contract.h"
#include "edgewise/visible.h"
#include "frontend/fixed.h"
#include "frontend/tasks.h"
#include "frontend/transform.h"
#include "frontend/triangle_ids.h"
#include "queries/checks.h"

namespace edgewise {

namespace {

using Sources = std::vector<std::array<SourceVertex, 3>>;  // the vertices of screen triangles (tasks.h)

// A screen triangle, ready for rule 11 at any sample that it covers.
struct Piece {
  // w_is_distance: of streams and parallel projections false.
  Piece(const ScreenTriangle& screen, const std::array<SourceVertex, 3>& source, bool w_is_distance) {
    const contract::Oriented t = contract::orient(screen);
    depth = contract::make_depth(t);
    const std::size_t second = contract::signed_area(screen) >= 0 ? 1 : 2, order[3] = {0, second, 3 - second};
    for (int i = 0; i < 3; ++i) {
      const SourceVertex& v = source[order[i]];
      opposite[i] = contract::make_edge(t, (i + 1) % 3);
      for (std::size_t k = 0; k < 3; ++k) weights_over_w[i][k] = v.weights[k] / v.w;
      z_over_w[i] = w_is_distance ? 1.0 : std::clamp(v.z / v.w, 0.0, 1.0) / v.w;
    }
  }

  contract::DepthPlane depth;
  contract::Edge opposite[3];   // by vertex
  double weights_over_w[3][3];  // by vertex: its weights of the source triangle's vertices
  double z_over_w[3];
};

struct Point {
  float u, v, distance;
};

// 0 … 1 → a multiple of 2^-24, half to even. Only the first sum rounds: it has no fraction bits.
double round_weight(double v) {
  return ((v * 0x1p24 + kRoundDouble) - kRoundDouble) * 0x1p-24;
}

// What a pixel of this depth shows of the first piece that covers it, if a piece that does has the depth.
std::optional<Point> point_at(std::span<const Piece> pieces, int x, int y, std::uint32_t depth) {
  std::optional<Point> point;
  bool has_depth = false;
  for (const Piece& piece : pieces) {
    double e[3];
    std::int64_t outside = 0;
    for (int i = 0; i < 3; ++i) {
      const contract::Edge& edge = piece.opposite[i];
      const std::int64_t biased = edge.at(x, y);
      outside |= biased;
      e[i] = static_cast<double>(biased + (contract::is_top_left(edge.a, edge.b) ? 0 : 1));
    }
    if (outside < 0) continue;
    has_depth |= piece.depth.at(x, y) == depth;
    if (point) continue;
    const auto sum = [&](double a, double b, double c) { return e[0] * a + e[1] * b + e[2] * c; };
    const auto& by = piece.weights_over_w;
    const double first = sum(by[0][0], by[1][0], by[2][0]), second = sum(by[0][1], by[1][1], by[2][1]),
                 third = sum(by[0][2], by[1][2], by[2][2]), all = first + second + third;
    const double u = round_weight(second / all), v = std::min(round_weight(third / all), 1.0 - u);
    const double z = sum(piece.z_over_w[0], piece.z_over_w[1], piece.z_over_w[2]) / all;
    point = {static_cast<float>(u), static_cast<float>(v), static_cast<float>(z)};
  }
  return has_depth ? point : std::nullopt;
}

// Makes the screen triangles of single source triangles, as the front end does.
class Triangles {
 public:
  // `options` asks for ids. Throws std::invalid_argument as barycentrics() does.
  Triangles(const Drawable& drawable, const FrontendOptions& options, SimdTarget target)
      : options_(options), target_(target), scene_(std::get_if<Scene>(&drawable)) {
    if (scene_ == nullptr) {
      stream_ = &std::get<TriangleStream>(drawable);
      check(*stream_);
      count_ = checked_count(stream_->size(), options.first_id);
      return;
    }
    view_.emplace(*scene_, options.width, options.height, is_fine(options.subpixel_bits));
    w_is_distance_ = view_->axis == glm::dvec3(0.0);
    first_ids_ = first_ids(*scene_);
    count_ = checked_count(first_ids_.back(), options.first_id);
    for (const Instance& instance : scene_->instances) {
      check(instance);
      check_flags(scene_->meshes[instance.mesh]);
    }
  }
  std::size_t count() const { return count_; }

  // What one thread needs.
  class Maker {
   public:
    explicit Maker(const Triangles& all) : all_(all), transform_(transform_kernel(all.target_)) {
      out_.triangles = pieces_;
      out_.sources = &sources_;
    }
    // Appends the pieces of triangle `id`, which exists. Ids begin at 0 here.
    void append(std::uint32_t id, std::vector<Piece>& pieces) {
      out_.count = 0;
      sources_.clear();
      if (all_.stream_ != nullptr)
        add_one({all_.options_, *all_.stream_}, id, out_);
      else
        add_mesh_triangle(id);
      for (std::size_t i = 0; i < out_.count; ++i)
        pieces.emplace_back(pieces_[i], sources_[i], all_.w_is_distance_);
    }

   private:
    void add_mesh_triangle(std::uint32_t id) {
      if (!task_ || id - task_->first_id >= task_->mesh.triangles.size()) start_instance_of(id);
      const MeshTask& task = *task_;
      const std::size_t triangle = id - task.first_id;
      const glm::uvec3 indices = task.mesh.triangles[triangle];
      glm::vec3 positions[3];
      for (int k = 0; k < 3; ++k) {
        if (indices[k] >= task.mesh.positions.size()) return;
        positions[k] = task.mesh.positions[indices[k]];
      }
      Vertex corners[3];
      transform_(task, positions, 3, corners);
      add_one(task, triangle, corners, out_);
    }
    void start_instance_of(std::uint32_t id) {
      const std::size_t index = instance_of(all_.first_ids_, id);
      const Scene& scene = *all_.scene_;
      const Instance& instance = scene.instances[index];
      const Mesh& mesh = scene.meshes[instance.mesh];
      task_.emplace(MeshTask{.options = all_.options_,
                             .mesh = mesh,
                             .view = all_.view_->volume,
                             .to_screen = {*all_.view_, model_matrix(mesh, instance)},
                             .depth = all_.view_->depth,
                             .first_id = static_cast<std::uint32_t>(all_.first_ids_[index])});
    }

    const Triangles& all_;
    TransformKernel transform_;
    std::optional<MeshTask> task_;  // of the last triangle's instance
    ScreenTriangle pieces_[Clipper::kMaxVertices - 2];
    ChunkOutput out_;
    Sources sources_;
  };

 private:
  FrontendOptions options_;
  SimdTarget target_;
  const Scene* scene_;
  const TriangleStream* stream_ = nullptr;
  std::optional<View> view_;  // of a scene
  bool w_is_distance_ = false;
  std::vector<std::size_t> first_ids_;  // of the scene's instances
  std::size_t count_ = 0;
};

constexpr int kColumn = 64;  // px

// The pieces of the triangles that were visible last.
class Cache {
 public:
  explicit Cache(const Triangles& all) : maker_(all) { pieces_.reserve(kMostPieces); }

  // Valid until the next call. The triangle must exist.
  std::span<const Piece> pieces_of(std::uint32_t id) {
    if (pieces_.size() + Clipper::kMaxVertices > kMostPieces) pieces_.clear(), slots_.assign(kSlots, {});
    Slot& slot = slots_[id % kSlots];
    if (slot.end == 0 || slot.id != id) {
      slot = {id, pieces_.size(), 0};
      maker_.append(id, pieces_);
      slot.end = pieces_.size();
    }
    return std::span(pieces_).subspan(slot.begin, slot.end - slot.begin);
  }

 private:
  static constexpr std::size_t kSlots = 1024, kMostPieces = 2048;
  struct Slot {
    std::uint32_t id = 0;
    std::size_t begin = 0, end = 0;  // the indices of its pieces; end 0: empty
  };

  Triangles::Maker maker_;
  std::vector<Slot> slots_ = std::vector<Slot>(kSlots);
  std::vector<Piece> pieces_;
};

void check(const FrontendOptions& options, const ConstFrameView& ids, const BarycentricsView& out) {
  check(ids, true);
  if (options.width != ids.width || options.height != ids.height)
    throw std::invalid_argument("options for " + std::to_string(options.width) + " x " +
                                std::to_string(options.height) + " px, but a frame of " +
                                std::to_string(ids.width) + " x " + std::to_string(ids.height) + " px");
  check_subpixel_bits(options.subpixel_bits);
  if (options.payload != Payload::id)
    throw std::invalid_argument("barycentric coordinates need a frame of ids: Payload::id");
  if (out.uv == nullptr && out.distance == nullptr)
    throw std::invalid_argument("barycentric coordinates need memory to write to: both planes are null");
  if ((out.uv != nullptr && out.uv_stride < 2 * ids.width) ||
      (out.distance != nullptr && out.distance_stride < ids.width))
    throw std::invalid_argument("barycentric coordinates need a stride of at least a row's floats");
  const Rows uv{out.uv, 2 * ids.width, ids.height, out.uv_stride},
      distance{out.distance, ids.width, ids.height, out.distance_stride};
  bool overlaps = overlap(uv, distance);
  for (const std::uint32_t* const plane : {ids.depth, ids.payload})
    overlaps |= overlap(uv, rows_of(ids, plane)) || overlap(distance, rows_of(ids, plane));
  if (overlaps)
    throw std::invalid_argument(
        "barycentric coordinates need planes that overlap neither the frame nor each other");
}

}  // namespace

void barycentrics(const ConstFrameView& ids, const Drawable& drawable, const FrontendOptions& options,
                  const BarycentricsView& out, const Execution& execution) {
  const DefaultFloatState state;
  check(options, ids, out);
  const auto [threads, tile_size, target] = checked(execution);
  FrontendOptions plain = options;
  plain.keep_unsnapped = plain.keep_states = false;
  const Triangles triangles(drawable, plain, target);

  const auto width = static_cast<std::uint64_t>(ids.width);
  constexpr std::uint64_t kNone = ~std::uint64_t{0};
  std::atomic<std::uint64_t> first_wrong{kNone};  // the first pixel that does not show its triangle
  const int parts = std::min(ids.height, threads == 1 ? 1 : 8 * threads);
  parallel_for(threads, parts, [&](int part) {
    constexpr Point kBackground{0.0f, 0.0f, std::numeric_limits<float>::infinity()};
    Cache cache(triangles);
    const int y0 = ids.height * part / parts, y1 = ids.height * (part + 1) / parts;
    const auto write_row = [&](int x0, int x1, int y) {
      const std::uint32_t *depth = ids.depth + y * ids.stride, *id = ids.payload + y * ids.stride;
      std::span<const Piece> pieces;
      std::uint32_t last = 0;  // the triangle of these pieces, if there are any
      for (int x = x0; x < x1; ++x) {
        std::optional<Point> point = kBackground;
        if (depth[x] != contract::kDepthClear) {
          const std::uint32_t triangle = id[x] - options.first_id;  // too large if the id is too small
          if (pieces.empty() || triangle != last) {
            last = triangle;
            pieces = last < triangles.count() ? cache.pieces_of(last) : std::span<const Piece>();
          }
          point = point_at(pieces, x, y, depth[x]);
        }
        if (!point) {
          const std::uint64_t pixel = static_cast<std::uint64_t>(y) * width + static_cast<std::uint64_t>(x);
          for (std::uint64_t old = first_wrong;
               pixel < old && !first_wrong.compare_exchange_weak(old, pixel);) {
          }
          return;
        }
        if (out.uv != nullptr) {
          float* uv = out.uv + y * out.uv_stride + 2 * x;
          uv[0] = point->u, uv[1] = point->v;
        }
        if (out.distance != nullptr) out.distance[y * out.distance_stride + x] = point->distance;
      }
    };
    // Columns narrow enough that a row's triangles are still in the cache in the next row.
    for (int x0 = 0; x0 < ids.width; x0 += kColumn)
      for (int y = y0; y < y1; ++y) write_row(x0, std::min(x0 + kColumn, ids.width), y);
  });
  if (first_wrong == kNone) return;
  const std::uint64_t y = first_wrong / width, x = first_wrong % width;
  const std::uint32_t id =
      ids.payload[static_cast<std::ptrdiff_t>(y) * ids.stride + static_cast<std::ptrdiff_t>(x)];
  const bool exists = id - options.first_id < triangles.count();
  throw std::invalid_argument(
      "pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") has id " + std::to_string(id) +
      (exists ? ", of a triangle that does not cover it at its depth"
              : " of " + std::to_string(triangles.count()) + " triangles" +
                    (options.first_id != 0 ? " from " + std::to_string(options.first_id) + " on" : "")));
}

}  // namespace edgewise
