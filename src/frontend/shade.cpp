// Lambert's law with an ambient term of 0.15, as in the tutorials. The cofactor matrix transforms normals
// correctly under any scale, and reverses them, like the winding, if the scale mirrors. In double, because
// the fourth power of a mesh's size may exceed the range of float. A triangle of a mesh with normals takes
// its face's.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "frontend/shade.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// This needs Highway first.
#include "frontend/lanes-inl.h"

#include <algorithm>

#include "core/kernel_table.h"
#include "edgewise/contract.h"
#include "frontend/shade.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

// The functions below compute glm's cross(), dot() and matrix product, with glm's order of operations.
template <class Real>
struct Vec3 {
  Real x, y, z;
};

template <class Real>
HWY_INLINE Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

template <class Real>
HWY_INLINE Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) {
  const auto minor = [](Real p, Real q, Real r, Real s)
                         HWY_ATTR { return hn::Sub(hn::Mul(p, q), hn::Mul(r, s)); };
  return {minor(a.y, b.z, b.y, a.z), minor(a.z, b.x, b.z, a.x), minor(a.x, b.y, b.x, a.y)};
}

// The normal of a triangle, of any length.
template <class Real>
HWY_INLINE Vec3<Real> across(const Vec3<Real>& a, const Vec3<Real>& b, const Vec3<Real>& c) {
  const auto minus = [](const Vec3<Real>& p, const Vec3<Real>& q) HWY_ATTR {
    return Vec3<Real>{hn::Sub(p.x, q.x), hn::Sub(p.y, q.y), hn::Sub(p.z, q.z)};
  };
  return cross(minus(c, a), minus(b, a));
}

// The cosine of the angle between a normal in model space and the light; NaN if its length is 0.
template <class Real>
HWY_INLINE Real lambert(const ShadeTask& task, const Vec3<Real>& model_normal) {
  const hn::DFromV<Real> d;
  const auto row = [&](int r) HWY_ATTR {
    const auto& m = task.cofactor;
    return dot(Vec3<Real>{hn::Set(d, m[0][r]), hn::Set(d, m[1][r]), hn::Set(d, m[2][r])}, model_normal);
  };
  const Vec3<Real> normal{row(0), row(1), row(2)};
  const Vec3<Real> light{hn::Set(d, task.to_light.x), hn::Set(d, task.to_light.y),
                         hn::Set(d, task.to_light.z)};
  return hn::Div(dot(normal, light), hn::Sqrt(dot(normal, normal)));
}

HWY_INLINE V lit(V colour, VF cosine) {
  const DF d;
  const VF ambient = hn::Set(d, 0.15f);
  const VF light =
      hn::IfThenElse(hn::Gt(cosine, ambient), hn::Min(cosine, hn::Set(d, 1.0f)), ambient);  // also for NaN
  const auto channel = [&](V c) HWY_ATTR {
    const VF value = hn::ConvertTo(d, hn::And(c, hn::Set(D{}, 255)));
    return hn::ConvertTo(D{}, hn::Add(hn::Mul(value, light), hn::Set(d, 0.5f)));
  };
  const V red = channel(colour), green = channel(hn::ShiftRight<8>(colour)),
          blue = channel(hn::ShiftRight<16>(colour));
  const V alpha = hn::Set(D{}, static_cast<std::int32_t>(0xFF000000u));
  return hn::Or(hn::Or(red, hn::ShiftLeft<8>(green)), hn::Or(hn::ShiftLeft<16>(blue), alpha));
}

// Positions or normals, at least one, readable as four words each. The last one is copied, as no memory
// follows it.
class Padded {
 public:
  explicit Padded(const std::vector<glm::vec3>& all) : all_(all.data()), last_(all.size() - 1) {
    std::copy_n(&all_[last_].x, 3, padded_);
  }
  const float* operator[](std::uint32_t i) const { return i == last_ ? padded_ : &all_[i].x; }

 private:
  const glm::vec3* all_;
  std::size_t last_;
  float padded_[4] = {};
};

using Indices = std::uint32_t[kLanes];  // of triangles of the mesh

HWY_INLINE VF cosines_of_normals(const ShadeTask& task, const Padded& normals, const Indices& index) {
  const Words n = load_words([&](int lane) { return normals[index[lane]]; });
  const auto of_normal = [&](auto x, auto y, auto z) HWY_ATTR {
    return lambert(task, Vec3<decltype(x)>{x, y, z});
  };
  return in_double(of_normal, real(n.word[0]), real(n.word[1]), real(n.word[2]));
}

HWY_INLINE VF cosines_of_triangles(const ShadeTask& task, const Padded& positions, const Indices& index) {
  const auto corner = [&](int k) HWY_ATTR {
    return load_words([&](int lane) { return positions[task.mesh.triangles[index[lane]][k]]; });
  };
  const Words a = corner(0), b = corner(1), c = corner(2);
  return in_double(
      [&](auto ax, auto ay, auto az, auto bx, auto by, auto bz, auto cx, auto cy, auto cz) HWY_ATTR {
        using Real3 = Vec3<decltype(ax)>;
        return lambert(task, across(Real3{ax, ay, az}, Real3{bx, by, bz}, Real3{cx, cy, cz}));
      },
      real(a.word[0]), real(a.word[1]), real(a.word[2]), real(b.word[0]), real(b.word[1]), real(b.word[2]),
      real(c.word[0]), real(c.word[1]), real(c.word[2]));
}

void shade(const ShadeTask& task, std::span<ScreenTriangle> triangles) {
  const D d;
  const Mesh& mesh = task.mesh;
  const bool has_normals = !mesh.normals.empty();
  const Padded vectors(has_normals ? mesh.normals : mesh.positions);
  for (std::size_t i = 0; i < triangles.size(); i += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, triangles.size() - i);
    const auto seen = [&](std::size_t lane) -> ScreenTriangle& {
      return triangles[i + std::min(lane, count - 1)];
    };
    std::uint32_t index[kLanes], colours[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      index[lane] = seen(lane).payload - task.first_id;
      colours[lane] = mesh.colours[index[lane]];
    }
    VF cosine =
        has_normals ? cosines_of_normals(task, vectors, index) : cosines_of_triangles(task, vectors, index);
    if (!mesh.flags.empty()) {
      float sides[kLanes];  // -1 for a two-sided triangle seen from behind, else 1
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        sides[lane] =
            mesh.has_flag(index[lane], kTwoSided) && contract::signed_area(seen(lane)) < 0 ? -1.0f : 1.0f;
      cosine = hn::Mul(cosine, hn::LoadU(DF{}, sides));
    }
    const V colour = hn::LoadU(d, reinterpret_cast<const std::int32_t*>(colours));
    hn::StoreU(lit(colour, cosine), d, reinterpret_cast<std::int32_t*>(colours));
    for (std::size_t lane = 0; lane < count; ++lane) triangles[i + lane].payload = colours[lane];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

glm::dmat3 cofactor_matrix(const glm::dmat4& model) {
  const glm::dvec3 x(model[0]), y(model[1]), z(model[2]);
  return {glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)};
}

ShadeKernel shade_kernel(SimdTarget target) {
  return EDGEWISE_KERNEL(shade, target);
}

namespace {

// A screen triangle with the same winding as a mesh's triangle has when seen by the camera, without area if
// that one has none.
ScreenTriangle wound_as_seen(const View& view, const Mesh& mesh, const glm::dmat4& model,
                             std::size_t triangle) {
  glm::dvec3 seen[3];  // x and y in pixels times w, and w
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 position(mesh.positions[mesh.triangles[triangle][k]]);
    seen[k] = view.pixels * (glm::dvec3(model * glm::dvec4(position, 1.0)) - view.origin) + view.at_origin;
  }
  // Points to the front, which is the clockwise side.
  const glm::dvec3 normal = glm::cross(seen[2] - seen[0], seen[1] - seen[0]);
  const int tall = glm::dot(normal, seen[0]) < 0.0 ? 1 : -1;
  return {{0, 1, 0}, {0, 0, tall}, {}, static_cast<std::uint32_t>(triangle)};
}

}  // namespace

std::vector<std::uint32_t> lit_colours(const Scene& scene) {
  const ShadeKernel kernel = shade_kernel(resolve(SimdTarget::best));
  std::vector<std::uint32_t> colours;
  const glm::dvec3 to_light = glm::normalize(glm::dvec3(scene.to_light));
  const View view(scene, 2, 2);  // any size
  std::vector<ScreenTriangle> triangles;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes.at(instance.mesh);
    const glm::dmat4 model = model_matrix(mesh, instance);
    const ShadeTask task{mesh, cofactor_matrix(model), to_light, 0};
    for (std::size_t i = 0; i < mesh.triangles.size();) {
      triangles.clear();
      for (const std::size_t end = std::min(mesh.triangles.size(), i + kChunkTriangles); i < end; ++i)
        triangles.push_back(wound_as_seen(view, mesh, model, i));
      kernel(task, triangles);
      for (const ScreenTriangle& t : triangles) colours.push_back(t.payload);
    }
  }
  return colours;
}

}  // namespace edgewise
#endif
