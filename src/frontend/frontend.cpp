#include "frontend/frontend.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "frontend/clip.h"
#include "frontend/fixed.h"
#include "raster/contract.h"
#include "raster/parallel.h"

namespace edgewise {

namespace {

constexpr Cull kCullModes[] = {Cull::none, Cull::back, Cull::front, Cull::both};

// Work is cut into runs of this many vertices or triangles, whatever the thread count.
constexpr std::size_t kRun = 2048;

struct Snapped {
  std::int32_t x_sub, y_sub;
  std::uint32_t z;
};

// Only for such vertices is the division safe: w > 0, and no NaN can come of it.
bool can_project(const ClipVertex& v) {
  return v.w > 0.0f && std::isfinite(1.0f / v.w) && std::isfinite(v.x) && std::isfinite(v.y) &&
         std::isfinite(v.z);
}

Snapped project(const ClipVertex& v) {
  const float inverse_w = 1.0f / v.w;
  return {snap(v.x * inverse_w), snap(v.y * inverse_w), quantize_depth(v.z * inverse_w)};
}

UnsnappedTriangle unsnapped_triangle(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c) {
  const float wa = 1.0f / a.w, wb = 1.0f / b.w, wc = 1.0f / c.w;
  return {{a.x * wa, b.x * wb, c.x * wc}, {a.y * wa, b.y * wb, c.y * wc}, {a.z * wa, b.z * wb, c.z * wc}};
}

struct Corner {
  const ClipVertex& clip;
  Snapped screen;
};

// One run's visible triangles and what became of the others.
struct Output {
  std::vector<ScreenTriangle> triangles;
  std::vector<UnsnappedTriangle> unsnapped;
  FrontendStats stats;
};

// A triangle's way from clip space to the screen.
class Assembler {
 public:
  Assembler(const FrontendOptions& options, Output& out) : options_(options), out_(out) {}

  // True if the triangle is dropped for where its vertices lie.
  bool drop(std::uint16_t a, std::uint16_t b, std::uint16_t c) {
    if ((a | b | c) & kNotFinite) {
      ++out_.stats.not_finite;
      return true;
    }
    if (a & b & c & kInvisible) {
      ++out_.stats.outside;
      return true;
    }
    return false;
  }

  // payload() is called for what is visible only.
  template <typename PayloadOf>
  void clip(const ClipVertex (&triangle)[3], std::uint16_t sides, PayloadOf&& payload) {
    FrontendStats& stats = out_.stats;
    if (sides & kNear) ++stats.clipped_near;
    if (sides & kFar) ++stats.clipped_far;
    if (sides & kGuard) ++stats.clipped_guard;
    const auto polygon = clipper_.clip(triangle, sides);
    if (polygon.size() < 3) {
      ++stats.outside;
      return;
    }
    if (!std::all_of(polygon.begin(), polygon.end(), can_project)) {
      ++stats.not_in_front;
      return;
    }
    const Snapped first = project(polygon[0]);
    Snapped previous = project(polygon[1]);
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const Snapped next = project(polygon[i]);
      emit({polygon[0], first}, {polygon[i - 1], previous}, {polygon[i], next}, payload);
      previous = next;
    }
  }

  template <typename PayloadOf>
  void emit(const Corner& a, const Corner& b, const Corner& c, PayloadOf&& payload) {
    FrontendStats& stats = out_.stats;
    ++stats.pieces;
    ScreenTriangle t{{a.screen.x_sub, b.screen.x_sub, c.screen.x_sub},
                     {a.screen.y_sub, b.screen.y_sub, c.screen.y_sub},
                     {a.screen.z, b.screen.z, c.screen.z},
                     0};
    const std::int64_t area = contract::signed_area(t);
    if (area == 0 && !options_.keep_unsnapped) {
      ++stats.zero_area;
    } else if (options_.cull == Cull::both || (options_.cull == Cull::front && area > 0) ||
               (options_.cull == Cull::back && area < 0)) {
      ++stats.culled;
    } else {
      ++stats.emitted;
      t.payload = payload();
      out_.triangles.push_back(t);
      if (options_.keep_unsnapped) out_.unsnapped.push_back(unsnapped_triangle(a.clip, b.clip, c.clip));
    }
  }

 private:
  const FrontendOptions& options_;
  Output& out_;
  Clipper clipper_;
};

void check(const Camera& camera) {
  const auto finite = [](glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  if (!finite(camera.position) || !std::isfinite(camera.yaw) || !std::isfinite(camera.pitch))
    throw std::invalid_argument("the camera's position, yaw and pitch must be finite");
  if (!(camera.fov_y > 0.0f && camera.fov_y < std::numbers::pi_v<float>))
    throw std::invalid_argument("the camera's field of view must be between 0 and 180 degrees");
  if (!(camera.near_z > 0.0f && camera.near_z < camera.far_z && std::isfinite(camera.far_z)))
    throw std::invalid_argument("the camera needs 0 < near < far");
}

void check(const Mesh& mesh) {
  if (mesh.colours.size() != mesh.triangles.size())
    throw std::invalid_argument("a mesh has " + std::to_string(mesh.triangles.size()) + " triangles and " +
                                std::to_string(mesh.colours.size()) + " colours");
}

ClipVertex transform(const glm::mat4& m, glm::vec3 p) {
  const auto row = [&](int r) { return m[0][r] * p.x + m[1][r] * p.y + m[2][r] * p.z + m[3][r]; };
  return {row(0), row(1), row(2), row(3)};
}

// Lambert's law with the tutorials' floor. Transforming by the cofactor matrix keeps normals right under any
// scale, and turns them with the winding where a scale mirrors.
class Shade {
 public:
  Shade(const glm::dmat4& model, glm::dvec3 to_light)
      : cofactor_(glm::cross(glm::dvec3(model[1]), glm::dvec3(model[2])),
                  glm::cross(glm::dvec3(model[2]), glm::dvec3(model[0])),
                  glm::cross(glm::dvec3(model[0]), glm::dvec3(model[1]))),
        to_light_(glm::normalize(to_light)) {}

  std::uint32_t operator()(glm::vec3 a, glm::vec3 b, glm::vec3 c, std::uint32_t colour) const {
    constexpr float kFloor = 0.15f;
    // In double, since squares of squares of a mesh's size leave the range of float.
    const glm::dvec3 normal =
        cofactor_ * glm::cross(glm::dvec3(c) - glm::dvec3(a), glm::dvec3(b) - glm::dvec3(a));
    const auto lambert =
        static_cast<float>(glm::dot(normal, to_light_) / std::sqrt(glm::dot(normal, normal)));
    const float light = lambert > kFloor ? std::min(lambert, 1.0f) : kFloor;
    const auto channel = [&](int shift) {
      return static_cast<std::uint32_t>(static_cast<float>(colour >> shift & 255) * light + 0.5f);
    };
    return rgb(channel(0), channel(8), channel(16));
  }

 private:
  glm::dmat3 cofactor_;
  glm::dvec3 to_light_;
};

}  // namespace

glm::dmat4 screen_matrix(const Camera& camera, int width, int height) {
  const double half_w = width / 2.0, half_h = height / 2.0;
  glm::dmat4 viewport(1.0);
  viewport[0][0] = half_w;
  viewport[1][1] = -half_h;
  viewport[3][0] = half_w;
  viewport[3][1] = half_h;
  const glm::dmat4 projection = glm::perspectiveRH_ZO(
      double{camera.fov_y}, static_cast<double>(width) / height, double{camera.near_z}, double{camera.far_z});
  glm::dmat4 view = glm::rotate(glm::dmat4(1.0), -double{camera.pitch}, glm::dvec3(1, 0, 0));
  view = glm::rotate(view, -double{camera.yaw}, glm::dvec3(0, 1, 0));
  view = glm::translate(view, -glm::dvec3(camera.position));
  return viewport * projection * view;
}

std::span<const Cull> cull_modes() {
  return kCullModes;
}

std::string_view name_of(Cull cull) {
  switch (cull) {
    case Cull::none:
      return "none";
    case Cull::back:
      return "back";
    case Cull::front:
      return "front";
    case Cull::both:
      return "both";
  }
  throw std::invalid_argument("not a culling mode");
}

FrontendStats& FrontendStats::operator+=(const FrontendStats& o) {
  meshes += o.meshes, meshes_culled += o.meshes_culled;
  triangles += o.triangles, whole_mesh += o.whole_mesh, not_finite += o.not_finite, outside += o.outside;
  not_in_front += o.not_in_front;
  clipped_near += o.clipped_near, clipped_far += o.clipped_far, clipped_guard += o.clipped_guard;
  pieces += o.pieces, culled += o.culled, zero_area += o.zero_area, emitted += o.emitted;
  return *this;
}

struct Frontend::State {
  struct Vertex {
    ClipVertex clip;
    Snapped screen;  // set where `outside` needs no clipping
    std::uint16_t outside;
  };

  std::vector<Vertex> vertices;
  std::vector<Output> outputs;  // one a run, in submission order; the first used_outputs are this frame's
  std::size_t used_outputs = 0;
  std::vector<ScreenTriangle> screen;
  std::vector<UnsnappedTriangle> unsnapped;
  FrontendStats stats;
  FrontendOptions options;

  // Calls body(begin, end, output) for runs of 0 … count - 1, in parallel; outputs keep the runs' order.
  template <typename Body>
  void for_each_run(std::size_t count, Body&& body) {
    const std::size_t runs = (count + kRun - 1) / kRun, first = used_outputs;
    used_outputs += runs;
    if (outputs.size() < used_outputs) outputs.resize(used_outputs);
    parallel_for(options.threads, static_cast<int>(runs), [&](int i) {
      const auto r = static_cast<std::size_t>(i);
      Output& out = outputs[first + r];
      out.triangles.clear();
      out.unsnapped.clear();
      out.stats = {};
      body(r * kRun, std::min(count, (r + 1) * kRun), out);
    });
  }

  void transform_vertices(const Mesh& mesh, const glm::mat4& to_screen) {
    const auto width = static_cast<float>(options.width), height = static_cast<float>(options.height);
    const std::size_t count = mesh.positions.size();
    vertices.resize(count);
    parallel_for(options.threads, static_cast<int>((count + kRun - 1) / kRun), [&](int run) {
      const std::size_t begin = static_cast<std::size_t>(run) * kRun;
      for (std::size_t i = begin; i < std::min(count, begin + kRun); ++i) {
        Vertex& v = vertices[i];
        v.clip = transform(to_screen, mesh.positions[i]);
        v.outside = outside_of(v.clip, width, height);
        if ((v.outside & (kMustClip | kNotFinite)) != 0) continue;
        if (can_project(v.clip))
          v.screen = project(v.clip);
        else
          v.outside |= kNear;  // sends its triangles through the clipper, which judges them
      }
    });
  }

  // True if the bounding box of the finite vertices lies wholly beyond one side of the view.
  bool culls(const Mesh& mesh, const glm::mat4& to_screen) const {
    glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
    for (const auto& p : mesh.positions) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    unsigned common = kInvisible;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 p(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                        corner & 4 ? high.z : low.z);
      common &= outside_of(transform(to_screen, p), static_cast<float>(options.width),
                           static_cast<float>(options.height));
    }
    return common != 0;
  }

  void run_mesh(const Mesh& mesh, const glm::mat4& to_screen, const Shade& shade, std::uint32_t first_id) {
    transform_vertices(mesh, to_screen);
    for_each_run(mesh.triangles.size(), [&](std::size_t begin, std::size_t end, Output& out) {
      Assembler assembler(options, out);
      out.stats.triangles = end - begin;
      for (std::size_t i = begin; i < end; ++i) {
        const glm::uvec3 t = mesh.triangles[i];
        if (std::max({t.x, t.y, t.z}) >= vertices.size())
          throw std::invalid_argument("triangle " + std::to_string(i) + " names vertex " +
                                      std::to_string(std::max({t.x, t.y, t.z})) + " of " +
                                      std::to_string(vertices.size()));
        const Vertex &a = vertices[t.x], &b = vertices[t.y], &c = vertices[t.z];
        if (assembler.drop(a.outside, b.outside, c.outside)) continue;
        const auto payload = [&] {
          if (options.payload == Payload::id) return first_id + static_cast<std::uint32_t>(i);
          if (!options.shade) return mesh.colours[i];
          return shade(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], mesh.colours[i]);
        };
        const auto sides = static_cast<std::uint16_t>((a.outside | b.outside | c.outside) & kMustClip);
        if (sides == 0)
          assembler.emit({a.clip, a.screen}, {b.clip, b.screen}, {c.clip, c.screen}, payload);
        else
          assembler.clip({a.clip, b.clip, c.clip}, sides, payload);
      }
    });
  }

  void run_scene(const Scene& scene) {
    check(scene.camera);
    const glm::dmat4 to_screen = screen_matrix(scene.camera, options.width, options.height);
    std::uint64_t first_id = 0;
    for (const auto& instance : scene.instances) {
      if (instance.mesh >= scene.meshes.size())
        throw std::invalid_argument("an instance names mesh " + std::to_string(instance.mesh) + " of " +
                                    std::to_string(scene.meshes.size()));
      const Mesh& mesh = scene.meshes[instance.mesh];
      check(mesh);
      ++stats.meshes;
      const glm::mat4 model = model_matrix(instance);
      const glm::mat4 matrix(to_screen * glm::dmat4(model));
      if (culls(mesh, matrix)) {
        ++stats.meshes_culled;
        stats.triangles += mesh.triangles.size();
        stats.whole_mesh += mesh.triangles.size();
      } else {
        run_mesh(mesh, matrix, Shade(model, scene.to_light), static_cast<std::uint32_t>(first_id));
      }
      first_id += mesh.triangles.size();
    }
  }

  void run_stream(const TriangleStream& stream) {
    const auto width = static_cast<float>(options.width), height = static_cast<float>(options.height);
    for_each_run(stream.triangles.size(), [&](std::size_t begin, std::size_t end, Output& out) {
      Assembler assembler(options, out);
      out.stats.triangles = end - begin;
      for (std::size_t i = begin; i < end; ++i) {
        const StreamTriangle& t = stream.triangles[i];
        ClipVertex v[3];
        std::uint16_t outside[3];
        for (int k = 0; k < 3; ++k) {
          v[k] = {t.vertex[k].x, t.vertex[k].y, t.vertex[k].z, 1.0f};
          outside[k] = outside_of(v[k], width, height);
        }
        if (assembler.drop(outside[0], outside[1], outside[2])) continue;
        const auto payload = [&] {
          return options.payload == Payload::id ? static_cast<std::uint32_t>(i) : t.colour;
        };
        const auto sides = static_cast<std::uint16_t>((outside[0] | outside[1] | outside[2]) & kMustClip);
        if (sides == 0)
          assembler.emit({v[0], project(v[0])}, {v[1], project(v[1])}, {v[2], project(v[2])}, payload);
        else
          assembler.clip(v, sides, payload);
      }
    });
  }

  void gather() {
    std::vector<std::size_t> start(used_outputs + 1, 0);
    for (std::size_t i = 0; i < used_outputs; ++i) {
      start[i + 1] = start[i] + outputs[i].triangles.size();
      stats += outputs[i].stats;
    }
    screen.resize(start.back());
    unsnapped.resize(options.keep_unsnapped ? start.back() : 0);
    parallel_for(options.threads, static_cast<int>(used_outputs), [&](int i) {
      const Output& from = outputs[static_cast<std::size_t>(i)];
      const auto at = static_cast<std::ptrdiff_t>(start[static_cast<std::size_t>(i)]);
      std::copy(from.triangles.begin(), from.triangles.end(), screen.begin() + at);
      std::copy(from.unsnapped.begin(), from.unsnapped.end(), unsnapped.begin() + at);
    });
  }
};

Frontend::Frontend() : state_(std::make_unique<State>()) {}
Frontend::~Frontend() = default;
Frontend::Frontend(Frontend&&) noexcept = default;
Frontend& Frontend::operator=(Frontend&&) noexcept = default;

std::span<const ScreenTriangle> Frontend::run(const Drawable& drawable, const FrontendOptions& options) {
  for (const int side : {options.width, options.height})
    if (side < 1 || side > contract::kMaxImageSide)
      throw std::invalid_argument("image side " + std::to_string(side) + " is outside 1 to " +
                                  std::to_string(contract::kMaxImageSide));
  State& s = *state_;
  s.options = options;
  s.stats = {};
  s.used_outputs = 0;
  if (const auto* scene = std::get_if<Scene>(&drawable))
    s.run_scene(*scene);
  else
    s.run_stream(std::get<TriangleStream>(drawable));
  s.gather();
  return s.screen;
}

const FrontendStats& Frontend::stats() const {
  return state_->stats;
}

std::span<const UnsnappedTriangle> Frontend::unsnapped() const {
  return state_->unsnapped;
}

}  // namespace edgewise
