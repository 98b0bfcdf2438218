// The registry of clipping methods, the truth without clipping, and the score. A method is a file in
// clipping_methods/ that defines clipping_NAME, and a line here.
#include "lab/clipping.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lab/clipping_methods/pipeline.h"
#include "lab/truth.h"

#define EDGEWISE_CLIPPING_METHODS(X) \
  X(near_guard)                      \
  X(near_too_near)                   \
  X(screen_edges)                    \
  X(discard_behind)                  \
  X(none)

namespace edgewise::lab {

#define EDGEWISE_DECLARE(name) extern const ClippingMethod clipping_##name;
EDGEWISE_CLIPPING_METHODS(EDGEWISE_DECLARE)

std::span<const ClippingMethod> clipping_methods() {
#define EDGEWISE_ENTRY(name) clipping_##name,
  static const std::array list{EDGEWISE_CLIPPING_METHODS(EDGEWISE_ENTRY)};
  return list;
}

ClippingFrame::ClippingFrame(Size size)
    : picture(size.width, size.height), backend(backends().front().make()) {}

namespace {

int sign(const Ball& v) {
  return v.sign();
}
int sign(const mpq_class& v) {
  return sgn(v);
}

// A triangle's homogeneous edge functions in whatever arithmetic T is: Ball, whose sign 0 means "cannot
// tell", or rationals.
template <typename T>
class Homogeneous {
 public:
  Homogeneous(const ClippingScene& scene, glm::uvec3 t)
      : Homogeneous(scene, vertex(scene, t.x), vertex(scene, t.y), vertex(scene, t.z)) {}
  int facing() const { return sign(det_); }

  // 1 if the ray through a point of the screen hits the triangle between near and far, -1 if not. The edge
  // functions are det times barycentric coordinates over w, so their sum is det / w, and w > 0 comes for
  // free.
  int hit(double x_px, double y_px) const {
    const int front = facing();
    if (front == 0) return 0;
    int all = 1;
    T sum(0.0);
    const auto require = [&](const T& v) { all = std::min(all, sign(v) * front); };
    for (const auto& e : edge_) {
      const T value = T(e[0] * T(x_px)) + T(e[1] * T(y_px)) + e[2];
      require(value);
      sum = sum + value;
    }
    require(det_ - near_ * sum);
    require(far_ * sum - det_);
    return all;
  }
  // 1 / w of the triangle's plane.
  T nearness(double x_px, double y_px) const {
    T sum(0.0);
    for (const auto& e : edge_) sum = sum + T(e[0] * T(x_px)) + T(e[1] * T(y_px)) + e[2];
    return T(sum / det_);
  }

 private:
  using Row = std::array<T, 3>;
  Homogeneous(const ClippingScene& scene, const Row& a, const Row& b, const Row& c)
      : edge_{cross(b, c), cross(c, a), cross(a, b)},
        det_(a[0] * edge_[0][0] + a[1] * edge_[0][1] + a[2] * edge_[0][2]),
        near_(scene.scene.camera.near_z),
        far_(scene.scene.camera.far_z) {}

  // Pixels times w, and w.
  static Row vertex(const ClippingScene& scene, unsigned index) {
    const glm::dvec3 v(scene.mesh().positions[index]);
    const T focal(focal_px(scene)), w(-v.z);
    return {T(focal * T(v.x) + T(scene.size.width / 2.0) * w),
            T(T(scene.size.height / 2.0) * w - focal * T(v.y)), w};
  }
  static Row cross(const Row& a, const Row& b) {
    return {T(a[1] * b[2] - a[2] * b[1]), T(a[2] * b[0] - a[0] * b[2]), T(a[0] * b[1] - a[1] * b[0])};
  }

  std::array<Row, 3> edge_;
  T det_, near_, far_;
};

class Truth {
 public:
  explicit Truth(const ClippingScene& scene) : scene_(scene) {
    for (const auto& t : scene.mesh().triangles) {
      estimates_.emplace_back(scene, t);
      exact_.emplace_back(scene, t);
    }
  }
  std::uint32_t owner_at(double x_px, double y_px) const {
    std::uint32_t owner = Owners::kNobody;
    for (std::uint32_t i = 0; i < exact_.size(); ++i)
      if (hit(i, x_px, y_px) && (owner == Owners::kNobody || nearer(i, owner, x_px, y_px))) owner = i;
    return owner;
  }
  double depth01(std::uint32_t triangle, double x_px, double y_px) const {
    const double near_z = scene_.scene.camera.near_z, far_z = scene_.scene.camera.far_z;
    const Ball estimate = estimates_[triangle].nearness(x_px, y_px);
    const double nearness =
        estimate.error * near_z < 0x1p-40 ? estimate.value : exact_[triangle].nearness(x_px, y_px).get_d();
    return far_z / (far_z - near_z) * (1 - near_z * nearness);
  }

 private:
  bool hit(std::uint32_t i, double x_px, double y_px) const {
    if (scene_.cull_back && exact_[i].facing() < 0) return false;
    const int guess = estimates_[i].hit(x_px, y_px);
    // A point exactly on an edge counts: which side it belongs to is a hairline matter.
    return guess != 0 ? guess > 0 : exact_[i].facing() != 0 && exact_[i].hit(x_px, y_px) >= 0;
  }
  bool nearer(std::uint32_t a, std::uint32_t b, double x_px, double y_px) const {
    const int guess = sign(estimates_[a].nearness(x_px, y_px) - estimates_[b].nearness(x_px, y_px));
    return guess != 0 ? guess > 0 : exact_[a].nearness(x_px, y_px) > exact_[b].nearness(x_px, y_px);
  }
  const ClippingScene& scene_;
  std::vector<Homogeneous<Ball>> estimates_;
  std::vector<Homogeneous<mpq_class>> exact_;
};

// Calls visit(x, y) for the sample and eight places around it, until it returns true; false if it never does.
template <typename Visit>
bool around(int px, int py, Visit&& visit) {
  for (const int dx : {0, -1, 1})
    for (const int dy : {0, -1, 1}) {
      const double reach = dx != 0 && dy != 0 ? kHairlinePx * 0.7071 : kHairlinePx;
      if (visit(px + 0.5 + dx * reach, py + 0.5 + dy * reach)) return true;
    }
  return false;
}

bool depth_fits(const Truth& truth, std::uint32_t owner, int x, int y, std::uint32_t stored) {
  const double depth01 = (static_cast<double>(stored) - contract::kDepthHead) / contract::kDepthRange;
  double low = 2, high = -1;
  around(x, y, [&](double x_px, double y_px) {
    const double here = truth.depth01(owner, x_px, y_px);
    low = std::min(low, here), high = std::max(high, here);
    return false;
  });
  return depth01 >= low - 0x1p-20 && depth01 <= high + 0x1p-20;
}

bool promises(const ClippingMethod& method, const ClippingScene& scene) {
  const ToClip to_clip(scene);
  return std::none_of(scene.mesh().positions.begin(), scene.mesh().positions.end(), [&](const auto& p) {
    const auto sides =
        outside_of(to_clip(p), static_cast<float>(scene.size.width), static_cast<float>(scene.size.height));
    return (sides & method.fails_on) != 0;
  });
}

}  // namespace

ClippingTruth clipping_truth(const ClippingScene& scene) {
  const Truth truth(scene);
  ClippingTruth result;
  for (int y = 0; y < scene.size.height; ++y)
    for (int x = 0; x < scene.size.width; ++x) result.owner.push_back(truth.owner_at(x + 0.5, y + 0.5));
  return result;
}

ClippingScore score(const ClippingMethod& method, const ClippingScene& scene, const ClippingTruth& owners) {
  ClippingFrame frame(scene.size), ours(scene.size);
  method.draw(scene, frame);
  clipping_methods().front().draw(scene, ours);
  const Truth exact(scene);
  ClippingScore score;
  score.not_a_number = frame.not_a_number;
  score.out_of_range = frame.out_of_range;
  auto truth = owners.owner.begin();
  for (int y = 0; y < scene.size.height; ++y)
    for (int x = 0; x < scene.size.width; ++x, ++truth) {
      const std::uint32_t said = frame.picture.payload_row(y)[x];
      if (*truth != Owners::kNobody) ++score.covered;
      if (said != ours.picture.payload_row(y)[x]) ++score.differs_from_ours;
      if (said == *truth) {
        if (said != Owners::kNobody && !depth_fits(exact, said, x, y, frame.picture.depth_row(y)[x]))
          ++score.wrong_depth;
      } else if (around(x, y, [&](double x_px, double y_px) { return exact.owner_at(x_px, y_px) == said; })) {
        ++score.hairline;
      } else if (said == Owners::kNobody) {
        ++score.missing;
      } else {
        ++(*truth == Owners::kNobody ? score.extra : score.wrong_owner);
      }
    }
  if (promises(method, scene)) score.broken = score.wrong();
  return score;
}

double linear_attribute_error(double w0, double w1, double fraction) {
  const double perspective = fraction / w1 / ((1 - fraction) / w0 + fraction / w1);
  return std::abs(fraction - perspective);
}

}  // namespace edgewise::lab
