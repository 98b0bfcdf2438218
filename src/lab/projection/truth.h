// The exact projection of a scene's own vertices. It shares no stage with a front end, and clips nothing: a
// sample's ray hits a triangle if the three homogeneous edge functions have the sign of the triangle's
// orientation (Olano and Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997), and
// covers the sample if it does so between the near and the far plane.
//
// The doubles that state a camera and an instance count as exact: the rotation and the focal length, which
// come from sines and a tangent, the camera's position, near and far, its matrices, and the instance's
// matrix. From there on all is exact: doubles with an error bound decide most signs, rationals the others.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "edgewise/scene.h"
#include "lab/method.h"
#include "lab/truth/ball_arithmetic.h"
#include "lab/truth/truth.h"

namespace edgewise::lab {

struct Box {
  double x0, y0, x1, y1;  // px
};

// Linear functions of a position: x and y in pixels times w, and w; near and far, which are at least 0 on the
// inner side of these planes.
enum ClipRow { kXw, kYw, kW, kNearSide, kFarSide, kClipRows };
template <typename T>
using ClipMatrix = std::array<std::array<T, 4>, kClipRows>;
template <typename T>
using ClipPoint = std::array<T, kClipRows>;
ClipMatrix<mpq_class> exact_matrix(const Scene& scene, Size size, const glm::dmat4& model);

// A triangle's conditions in the arithmetic of T: Ball, or mpq_class. Condition i is a linear function on the
// screen, which has the sign of `det` on the inner side: those of the three edges, and of the near and the
// far plane.
template <typename T>
struct Conditions {
  static constexpr std::size_t kNear = 3, kFar = 4, kCount = 5;

  // The screen's origin is moved to (x0, y0), near the triangle, so that less is rounded.
  Conditions(const ClipPoint<T>& a, const ClipPoint<T>& b, const ClipPoint<T>& c, double x0_px, double y0_px);
  T at(std::size_t i, double x_px, double y_px) const {
    const T x = T(T(x_px) - T(x0)), y = T(T(y_px) - T(y0));
    return T(T(side[i][0] * x) + T(side[i][1] * y) + side[i][2]);
  }

  double x0, y0;
  std::array<std::array<T, 3>, kCount> side;
  T det;  // its sign is the facing: 1 front (clockwise on the screen), -1 back
};

class SceneTruth final : public SourceTruth {
 public:
  // A triangle with a vertex that is not finite draws nothing. Two-sided triangles are never culled. Throws
  // std::out_of_range for a mesh or a vertex that the scene lacks.
  SceneTruth(Scene scene, Size size, Cull cull);
  ~SceneTruth() override;

  std::size_t size() const override { return sources_.size(); }
  // 1 front, -1 back, 0 if it draws nothing: it is culled, edge-on, or beyond one side of the view.
  int facing(std::uint32_t triangle) const { return facing_[triangle]; }
  std::vector<Run> runs(Window window, int threads) const override;
  VisibleTriangles visible_triangles(Window window, int threads) const override;
  std::vector<glm::dvec3> outline(std::uint32_t triangle) const override;

  // The rest is about points anywhere in the image. A triangle that draws nothing covers none.
  bool covers(std::uint32_t triangle, double x_px, double y_px) const;
  // Whether a's depth is less.
  bool nearer(std::uint32_t a, std::uint32_t b, double x_px, double y_px) const;
  // Within 2^-36.
  double depth01(std::uint32_t triangle, double x_px, double y_px) const;
  // Whether one of the conditions fails at all corners of a box, so in the whole box.
  bool misses(std::uint32_t triangle, const Box& box) const;

  const Scene& scene() const { return scene_; }
  Size image() const { return size_; }
  // The instance of a triangle, and its index in the mesh; its vertex k, and that in clip space.
  std::pair<std::size_t, std::size_t> source(std::size_t triangle) const { return sources_[triangle]; }
  const glm::vec3& position(std::size_t triangle, int k) const;
  ClipPoint<Ball> estimate(std::size_t triangle, int k) const;
  ClipPoint<mpq_class> exact(std::size_t triangle, int k) const;

 private:
  class TriangleTruth;
  struct Estimate;

  void add(std::uint32_t triangle, Cull cull, const ClipPoint<Ball>& a, const ClipPoint<Ball>& b,
           const ClipPoint<Ball>& c);
  TriangleTruth truth_of(std::size_t triangle) const;
  const Conditions<mpq_class>& exact(std::size_t triangle) const;

  Scene scene_;
  Size size_;
  double depth_scale_;                        // if there is a camera, depth is this times 1 - near / w
  std::vector<ClipMatrix<mpq_class>> exact_;  // by instance
  std::vector<ClipMatrix<Ball>> rounded_;
  std::vector<std::pair<std::size_t, std::size_t>> sources_;
  std::vector<std::int8_t> facing_;
  std::vector<std::uint32_t> estimate_of_;  // by triangle, if it draws something
  std::vector<Estimate> estimates_;
  struct Exact {
    std::once_flag once;
    std::unique_ptr<const Conditions<mpq_class>> conditions;
  };
  std::unique_ptr<Exact[]> exact_of_;  // by triangle, found when an estimate leaves a sign open
};

}  // namespace edgewise::lab
