#include "lab/clipping/truth.h"

#include <algorithm>
#include <numeric>

#include "core/finite.h"
#include "core/parallel.h"
#include "core/trigonometry.h"
#include "frontend/view.h"
#include "lab/truth/truth.h"

namespace edgewise::lab {

namespace {

constexpr int kTile = 4;  // px

int sign(const Ball& v) {
  return v.sign();
}
int sign(const mpq_class& v) {
  return sgn(v);
}

// Where an instance stands, in the doubles that count as exact.
struct Placement {
  Placement(const Scene& scene, Size image, const Instance& instance)
      : camera(camera_of(scene)),
        size(image),
        model(model_matrix(scene.meshes.at(instance.mesh), instance)),
        turn(to_camera_frame(camera)),
        focal_px(size.height / 2.0 / tangent(double{camera.fov_y} / 2)) {}

  const Camera& camera;
  Size size;
  glm::dmat4 model;
  glm::dmat3 turn;
  double focal_px;
};

}  // namespace

template <typename T>
class Homogeneous {
  using Row = std::array<T, 3>;

 public:
  Homogeneous(const Placement& at, const Mesh& mesh, std::size_t triangle)
      : Homogeneous(at.camera, vertex(at, mesh, triangle, 0), vertex(at, mesh, triangle, 1),
                    vertex(at, mesh, triangle, 2)) {}
  int facing() const { return sign(det_); }

  // 1 if the ray through a point of the screen hits the triangle between near and far, -1 if not, 0 if
  // undecided or on a boundary. The edge functions are det times barycentric coordinates over w, so their sum
  // is det / w, and w > 0 needs no test of its own.
  int hit(double x_px, double y_px, int front) const {
    int all = 1;
    T sum(0.0);
    for (const Row& e : edge_) {
      const T v = at(e, x_px, y_px);
      all = std::min(all, sign(v) * front);
      if (all < 0) return all;
      sum = T(sum + v);
    }
    return std::min({all, sign(T(det_ - near_ * sum)) * front, sign(T(far_ * sum - det_)) * front});
  }
  // Whether one of the conditions fails at all corners of a box. All are linear on the screen, so it then
  // fails in the whole box.
  bool misses(const Box& box, int front) const {
    const auto fails = [&](auto&& condition) {
      return sign(condition(box.x0, box.y0)) * front < 0 && sign(condition(box.x1, box.y0)) * front < 0 &&
             sign(condition(box.x0, box.y1)) * front < 0 && sign(condition(box.x1, box.y1)) * front < 0;
    };
    const auto sum = [&](double x, double y) {
      return T(at(edge_[0], x, y) + at(edge_[1], x, y) + at(edge_[2], x, y));
    };
    return fails([&](double x, double y) { return at(edge_[0], x, y); }) ||
           fails([&](double x, double y) { return at(edge_[1], x, y); }) ||
           fails([&](double x, double y) { return at(edge_[2], x, y); }) ||
           fails([&](double x, double y) { return T(det_ - near_ * sum(x, y)); }) ||
           fails([&](double x, double y) { return T(far_ * sum(x, y) - det_); });
  }
  // 1 / w of the triangle's plane.
  T nearness(double x_px, double y_px) const {
    T sum(0.0);
    for (const Row& e : edge_) sum = sum + T(e[0] * T(x_px)) + T(e[1] * T(y_px)) + e[2];
    return T(sum / det_);
  }

 private:
  static T at(const Row& e, double x_px, double y_px) {
    return T(T(e[0] * T(x_px)) + T(e[1] * T(y_px)) + e[2]);
  }
  Homogeneous(const Camera& camera, const Row& a, const Row& b, const Row& c)
      : edge_{cross(b, c), cross(c, a), cross(a, b)},
        det_(a[0] * edge_[0][0] + a[1] * edge_[0][1] + a[2] * edge_[0][2]),
        near_(camera.near_z),
        far_(camera.far_z) {}

  // A vertex: x and y in pixels times w, and w.
  static Row vertex(const Placement& at, const Mesh& mesh, std::size_t triangle, int k) {
    const auto times = [](const auto& m, const Row& v, int row) {
      return T(T(m[0][row]) * v[0] + T(m[1][row]) * v[1] + T(m[2][row]) * v[2]);
    };
    const glm::dvec3 p(mesh.positions.at(mesh.triangles[triangle][k]));
    const Row position{T(p.x), T(p.y), T(p.z)};
    const auto from_camera = [&](int i) {
      return T(times(at.model, position, i) + T(T(at.model[3][i]) - T(at.camera.position[i])));
    };
    const Row seen{from_camera(0), from_camera(1), from_camera(2)};
    const T focal(at.focal_px), w(T(0.0) - times(at.turn, seen, 2));
    return {T(focal * times(at.turn, seen, 0) + T(at.size.width / 2.0) * w),
            T(T(at.size.height / 2.0) * w - focal * times(at.turn, seen, 1)), w};
  }
  static Row cross(const Row& a, const Row& b) {
    return {T(a[1] * b[2] - a[2] * b[1]), T(a[2] * b[0] - a[0] * b[2]), T(a[0] * b[1] - a[1] * b[0])};
  }

  std::array<Row, 3> edge_;
  T det_, near_, far_;
};

using Estimate = Homogeneous<Ball>;
using Exact = Homogeneous<mpq_class>;

ClippingOracle::ClippingOracle(const Scene& scene, Size size, Cull cull)
    : scene_(scene), size_(size), tiles_x_((size.width + kTile - 1) / kTile) {
  const int tiles_y = (size.height + kTile - 1) / kTile;
  in_tile_.resize(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y));
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes.at(instance.mesh);
    const Placement placement(scene, size, instance);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      sources_.emplace_back(i, t);
      estimates_.emplace_back(placement, mesh, t);
      const auto finite = [&](std::uint32_t vertex) { return is_finite(mesh.positions[vertex]); };
      const glm::uvec3 corners = mesh.triangles[t];
      int facing = 0;
      if (finite(corners.x) && finite(corners.y) && finite(corners.z)) {
        facing = estimates_.back().facing();
        if (facing == 0) facing = exact(static_cast<std::uint32_t>(facing_.size())).facing();
      }
      const bool culled =
          cull == Cull::both || (cull == Cull::back && facing < 0) || (cull == Cull::front && facing > 0);
      facing_.push_back(static_cast<std::int8_t>(culled && !mesh.has_flag(t, kTwoSided) ? 0 : facing));
    }
  }
  std::vector<std::uint32_t> all(estimates_.size());
  std::iota(all.begin(), all.end(), 0u);
  std::erase_if(all, [&](std::uint32_t i) { return facing_[i] == 0; });
  int tiles = 1;
  while (tiles < std::max(tiles_x_, tiles_y)) tiles *= 2;
  sort_into_tiles(0, 0, tiles, all);
}

Exact ClippingOracle::exact(std::uint32_t triangle) const {
  const auto [instance, index] = sources_[triangle];
  const Instance& source = scene_.instances[instance];
  return {Placement(scene_, size_, source), scene_.meshes[source.mesh], index};
}

ClippingOracle::~ClippingOracle() = default;

void ClippingOracle::sort_into_tiles(int tile_x, int tile_y, int tiles,
                                     std::span<const std::uint32_t> candidates) {
  const int tiles_y = static_cast<int>(in_tile_.size()) / tiles_x_;
  if (tile_x >= tiles_x_ || tile_y >= tiles_y) return;
  const Box box{double{kTile} * tile_x, double{kTile} * tile_y, double{kTile} * (tile_x + tiles),
                double{kTile} * (tile_y + tiles)};
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t i : candidates)
    if (!estimates_[i].misses(box, facing_[i])) kept.push_back(i);
  if (tiles == 1) {
    in_tile_[static_cast<std::size_t>(tile_y * tiles_x_ + tile_x)] = std::move(kept);
    return;
  }
  const int half = tiles / 2;
  for (const int right : {0, half})
    for (const int below : {0, half}) sort_into_tiles(tile_x + right, tile_y + below, half, kept);
}

std::uint32_t ClippingOracle::visible_at(double x_px, double y_px) const {
  const auto tile =
      static_cast<std::size_t>(static_cast<int>(y_px) / kTile * tiles_x_ + static_cast<int>(x_px) / kTile);
  std::uint32_t visible_id = kNoTriangle;
  for (const std::uint32_t i : in_tile_[tile])
    if (covers(i, x_px, y_px) && (visible_id == kNoTriangle || nearer(i, visible_id, x_px, y_px)))
      visible_id = i;
  return visible_id;
}

bool ClippingOracle::shows(std::uint32_t triangle, std::uint32_t other, double x_px, double y_px) const {
  if (triangle != kNoTriangle && !covers(triangle, x_px, y_px)) return false;
  if (other != kNoTriangle && covers(other, x_px, y_px) &&
      (triangle == kNoTriangle || nearer(other, triangle, x_px, y_px)))
    return false;
  return visible_at(x_px, y_px) == triangle;
}

double ClippingOracle::depth01(std::uint32_t triangle, double x_px, double y_px) const {
  const double near_z = scene_.camera.near_z, far_z = scene_.camera.far_z;
  const Ball estimate = estimates_[triangle].nearness(x_px, y_px);
  const double nearness =
      estimate.error * near_z < 0x1p-34 ? estimate.value : exact(triangle).nearness(x_px, y_px).get_d();
  return far_z / (far_z - near_z) * (1 - near_z * nearness);
}

bool ClippingOracle::covers(std::uint32_t i, double x_px, double y_px) const {
  if (facing_[i] == 0) return false;
  const int guess = estimates_[i].hit(x_px, y_px, facing_[i]);
  // A point exactly on an edge counts as covered: its side is within hairline.
  return guess != 0 ? guess > 0 : exact(i).hit(x_px, y_px, facing_[i]) >= 0;
}

bool ClippingOracle::nearer(std::uint32_t a, std::uint32_t b, double x_px, double y_px) const {
  const int guess = sign(estimates_[a].nearness(x_px, y_px) - estimates_[b].nearness(x_px, y_px));
  if (guess != 0) return guess > 0;
  return exact(a).nearness(x_px, y_px) > exact(b).nearness(x_px, y_px);
}

ClippingTruth clipping_truth(const ClippingScene& scene, int threads) {
  const auto width = static_cast<std::size_t>(scene.size.width);
  const Cull cull = scene.cull_back ? Cull::back : Cull::none;
  ClippingTruth truth{{}, std::make_shared<ClippingOracle>(scene.scene, scene.size, cull)};
  truth.visible.resize(width * static_cast<std::size_t>(scene.size.height));
  parallel_for(threads, scene.size.height, [&](int y) {
    for (int x = 0; x < scene.size.width; ++x)
      truth.visible[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] =
          truth.oracle->visible_at(x + 0.5, y + 0.5);
  });
  return truth;
}

}  // namespace edgewise::lab
