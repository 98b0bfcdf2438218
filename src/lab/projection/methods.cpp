// The table of projection methods, and what they compute.
#include <algorithm>
#include <array>

#include "edgewise/contract.h"
#include "frontend/fixed.h"
#include "lab/projection/projection.h"

namespace edgewise::lab {

namespace {

using Triangles = std::vector<ProjectedTriangle>;

// Rounds to subpixel bits, half to even; not at all without bits.
double to_grid(double px, std::optional<int> bits) {
  return bits ? rounded_to(px, *bits) : px;
}
double on_grid(const mpq_class& px, int bits) {
  const mpq_class units = px * (1 << bits);
  mpz_class down;
  mpz_fdiv_q(down.get_mpz_t(), units.get_num_mpz_t(), units.get_den_mpz_t());
  const int above_half = cmp(units - down, mpq_class(1, 2));
  if (above_half > 0 || (above_half == 0 && mpz_odd_p(down.get_mpz_t()) != 0)) ++down;
  return down.get_d() / (1 << bits);
}

// The planes that clip: near, far, and the guard band.
template <typename T>
std::array<T, 6> distances(const ClipPoint<T>& p) {
  const T guard = T(T(contract::kMaxImageSide) * p[kW]);
  return {p[kNearSide],      p[kFarSide],       T(guard - p[kXw]),
          T(guard + p[kXw]), T(guard - p[kYw]), T(guard + p[kYw])};
}

// Clips a triangle (Sutherland and Hodgman), in the arithmetic of T.
template <typename T>
std::vector<ClipPoint<T>> clipped(const std::array<ClipPoint<T>, 3>& triangle) {
  std::vector<ClipPoint<T>> polygon(triangle.begin(), triangle.end()), kept;
  for (std::size_t plane = 0; plane < 6; ++plane) {
    kept.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const ClipPoint<T>*inside = &polygon[i], *outside = &polygon[(i + 1) % polygon.size()];
      T from = distances(*inside)[plane], to = distances(*outside)[plane];
      if (from >= 0) kept.push_back(*inside);
      if ((from >= 0) == (to >= 0)) continue;
      // From the inside vertex, so that both triangles at an edge get the same point.
      if (from < 0) std::swap(inside, outside), std::swap(from, to);
      const T t = T(from / T(from - to));
      ClipPoint<T> added = *inside;
      for (std::size_t row = 0; row < kClipRows; ++row)
        added[row] = T(added[row] + T(t * T((*outside)[row] - (*inside)[row])));
      kept.push_back(std::move(added));
    }
    polygon.swap(kept);
  }
  return polygon;
}

// Appends a polygon as a fan. x(i) and y(i) are the position of its corner i.
template <typename X, typename Y>
void append(Triangles& list, std::size_t corners, std::uint32_t source, X&& x, Y&& y) {
  for (std::size_t i = 2; i < corners; ++i)
    list.push_back({{x(0), x(i - 1), x(i)}, {y(0), y(i - 1), y(i)}, source});
}

// By one 4 x 4 matrix, in the arithmetic of T from the camera's and the instance's matrices on.
template <typename T>
Triangles by_matrix(const SceneTruth& truth, std::optional<int> bits) {
  const Scene& scene = truth.scene();
  const Size size = truth.image();
  const CameraMatrices camera =
      scene.matrices ? *scene.matrices : matrices_of(scene.camera, double(size.width) / size.height);
  const auto seen = glm::tmat4x4<T>(camera.projection) * glm::tmat4x4<T>(camera.view);
  const T half_w = static_cast<T>(size.width) / 2, half_h = static_cast<T>(size.height) / 2;
  std::vector<glm::tmat4x4<T>> matrices;
  for (const Instance& instance : scene.instances)
    matrices.push_back(seen * glm::tmat4x4<T>(model_matrix(scene.meshes[instance.mesh], instance)));
  Triangles list;
  for (std::uint32_t i = 0; i < truth.size(); ++i) {
    if (truth.facing(i) == 0) continue;
    const auto corner = [&](int k) {
      const auto v =
          matrices[truth.source(i).first] * glm::tvec4<T>(glm::tvec3<T>(truth.position(i, k)), T(1));
      return ClipPoint<T>{half_w * (v.w + v.x), half_h * (v.w - v.y), v.w, v.z, v.w - v.z};
    };
    const auto polygon = clipped<T>({corner(0), corner(1), corner(2)});
    const auto px = [&](ClipRow axis) {
      return [&, axis](std::size_t k) { return to_grid(double{polygon[k][axis] / polygon[k][kW]}, bits); };
    };
    append(list, polygon.size(), i, px(kXw), px(kYw));
  }
  return list;
}

Triangles exactly(const SceneTruth& truth, std::optional<int> bits) {
  return exactly_projected(truth, *bits);
}

// The library's front end. Unrounded positions are those that it rounds to 8 bits.
Triangles ours(const SceneTruth& truth, std::optional<int> bits) {
  Frontend frontend;
  const auto screen = frontend.run(truth.scene(), {.width = truth.image().width,
                                                   .height = truth.image().height,
                                                   .cull = Cull::none,
                                                   .shade = false,
                                                   .payload = Payload::id,
                                                   .subpixel_bits = bits.value_or(8),
                                                   .keep_unsnapped = true});
  Triangles list;
  for (std::size_t i = 0; i < screen.size(); ++i) {
    if (truth.facing(screen[i].payload) == 0) continue;
    const UnsnappedTriangle& at = frontend.unsnapped()[i];
    const auto px = [&](const std::int32_t(&q15)[3], const float(&unsnapped)[3]) {
      return
          [&](std::size_t k) { return bits ? q15[k] / double{contract::kPixel_q15} : double{unsnapped[k]}; };
    };
    append(list, 3, screen[i].payload, px(screen[i].x_q15, at.x_px), px(screen[i].y_q15, at.y_px));
  }
  return list;
}

}  // namespace

Triangles exactly_projected(const SceneTruth& truth, int bits) {
  Triangles list;
  for (std::uint32_t i = 0; i < truth.size(); ++i) {
    if (truth.facing(i) == 0) continue;
    const std::array<ClipPoint<Ball>, 3> guess{truth.estimate(i, 0), truth.estimate(i, 1),
                                               truth.estimate(i, 2)};
    const bool inside = std::ranges::all_of(guess, [](const auto& p) {
      return std::ranges::all_of(distances(p), [](const Ball& d) { return d.sign() > 0; });
    });
    const auto corner = [&](std::size_t k) { return truth.exact(i, static_cast<int>(k)); };
    if (inside) {
      const auto px = [&](ClipRow axis) {
        return [&, axis](std::size_t k) {
          const Ball at = guess[k][axis] / guess[k][kW];
          const double low = rounded_to(at.value - at.error, bits),
                       high = rounded_to(at.value + at.error, bits);
          if (low == high) return low;
          const ClipPoint<mpq_class> exact = corner(k);
          return on_grid(exact[axis] / exact[kW], bits);
        };
      };
      append(list, 3, i, px(kXw), px(kYw));
      continue;
    }
    const auto polygon = clipped<mpq_class>({corner(0), corner(1), corner(2)});
    const auto px = [&](ClipRow axis) {
      return [&, axis](std::size_t k) { return on_grid(polygon[k][axis] / polygon[k][kW], bits); };
    };
    append(list, polygon.size(), i, px(kXw), px(kYw));
  }
  return list;
}

namespace {

constexpr std::string_view kOurs[] = {"ours_4",  "ours_5",  "ours_6",  "ours_7",  "ours_8",  "ours_9",
                                      "ours_10", "ours_11", "ours_12", "ours_13", "ours_14", "ours_15"},
                           kExact[] = {"exact_8", "exact_12", "exact_15"};  // by kShownBits
static_assert(std::size(kOurs) == kMaxSubpixelBits - kMinSubpixelBits + 1);

constexpr std::string_view kFrontend = "frontend/transform.cpp",
                           kInFloat =
                               "positions off by less than 2^-19 (f + 2 side) D / w px before rounding",
                           kInDouble =
                               "positions off by less than 2^-17 px before rounding, for usual cameras";

ProjectionMethod our(int bits) {
  const bool fine = is_fine(bits);
  return {{kOurs[bits - kMinSubpixelBits], fine ? "our front end, in double" : "our front end, in float",
           kFrontend, fine ? kInDouble : kInFloat, false},
          bits,
          ours};
}

ProjectionMethod exact(std::size_t i) {
  return {{kExact[i], "exact projection, rounded exactly", "the best that these subpixel bits allow",
           "exact positions, rounded half to even", true},
          kShownBits[i],
          exactly};
}

}  // namespace

std::span<const ProjectionMethod> projection_methods() {
  static const std::vector<ProjectionMethod> kMethods = [] {
    std::vector<ProjectionMethod> list;
    for (int bits = kMinSubpixelBits; bits <= kMaxSubpixelBits; ++bits) list.push_back(our(bits));
    list.push_back(
        {{"ours_float", "the floats that our front end rounds to at most 8 bits: relative to the camera",
          kFrontend, kInFloat, false},
         {},
         ours});
    list.push_back({{"matrix_float", "one 4×4 matrix of floats, positions as they are",
                     "OpenGL, Direct3D, most engines", "none", false},
                    {},
                    by_matrix<float>});
    list.push_back({{"matrix_float_8", "one 4×4 matrix of floats, positions rounded to 1/256 px",
                     "Direct3D 11.3 functional specification, 3.4.1", "none", false},
                    8,
                    by_matrix<float>});
    list.push_back({{"matrix_double", "one 4×4 matrix of doubles, positions as they are",
                     "the usual remedy for float errors", "none", false},
                    {},
                    by_matrix<double>});
    for (std::size_t i = 0; i < std::size(kShownBits); ++i) list.push_back(exact(i));
    return list;
  }();
  return kMethods;
}

}  // namespace edgewise::lab
