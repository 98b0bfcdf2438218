#include "lab/needs/pipeline.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/grid.h"
#include "edgewise/contract.h"
#include "frontend/fixed.h"
#include "frontend/transform.h"
#include "frontend/view.h"
#include "lab/needs/ranges.h"
#include "lab/source_triangles.h"
#include "lab/stage_methods.h"
#include "lab/view_space.h"
#include "lab/visibility/depth_buffer.h"

namespace edgewise::lab {

namespace {

constexpr std::uint32_t kPlanes[kViewPlanes] = {kNear, kFar, kGuard};

constexpr const char* kFacingTests[] = {"no test",        "normal_z",   "normal_dot_object",
                                        "normal_dot_eye", "float_area", "snapped_area"};
enum FacingLevel { kNormalZ = 1, kNormalDotObject, kNormalDotEye, kFloatArea };  // of those between

constexpr const char* kVisibilities[] = {"submission_order", "painter_mean", "painter_farthest",
                                         "depth buffer"};

using Draw = void (*)(const VisibilityScene& scene, VisibilityFrame& frame);
template <int kBits>
void draw_unorm(const VisibilityScene& scene, VisibilityFrame& frame) {
  using Plane = UnormPlane<kBits, std::uint32_t>;
  draw_depth_buffer<Plane, std::uint32_t>(scene, frame, frame.depth32, Plane::kMax);
}
// The lab's planes hold the largest value in 32 bits with a sign.
constexpr auto kUnorm = []<int... kBits>(std::integer_sequence<int, kBits...>) {
  return std::array<Draw, sizeof...(kBits)>{draw_unorm<kBits + 1>...};
}
(std::make_integer_sequence<int, kOurDepth>());
// The levels above: ours, which is exact, and floats, which are no more and no less precise.
constexpr const char* kOtherDepths[] = {"contract31", "float_z", "reversed_z"};

Draw draw_of(const Pipeline& pipeline) {
  if (pipeline[kVisibility] != kDepthBuffer)
    return find_visibility_method(kVisibilities[pipeline[kVisibility]]).draw;
  const auto level = static_cast<std::size_t>(pipeline[kDepth]);
  return level < kUnorm.size() ? kUnorm[level]
                               : find_visibility_method(kOtherDepths[level - kUnorm.size()]).draw;
}

void add_bits(std::vector<std::string>& levels, int least, int most) {
  for (int bits = least; bits <= most; ++bits) levels.push_back(bits_name(bits));
}

double area_px(const VisibilityTriangle& t) {
  const float qx = t.x_px[1] - t.x_px[0], qy = t.y_px[1] - t.y_px[0], rx = t.x_px[2] - t.x_px[0],
              ry = t.y_px[2] - t.y_px[0];
  return double{qx * ry - qy * rx};
}

// Makes the triangles of a frame that a pipeline shows.
class Assembly {
 public:
  // `for_all`: for all facing tests and visibilities, not those of the pipeline.
  Assembly(const Pipeline& pipeline, bool for_all, Cull cull, const ViewVolume& view, bool stream,
           PipelineMemory& memory)
      : pipeline_(pipeline),
        cull_(cull),
        tests_(cull != Cull::back ? bit(kSnappedArea)
               : for_all          ? bit(kSnappedArea + 1) - 1
                                  : bit(pipeline[kFacing])),
        view_(view),
        stream_(stream),
        depth_(view.near_z, view.far_z),
        memory_(memory),
        scene_(memory.scene) {
    const bool ours = pipeline[kVisibility] == kDepthBuffer && pipeline[kDepth] == kOurDepth;
    has_depth_ = for_all || ours, has_distance_ = for_all || (pipeline[kVisibility] != 0 && !ours);
    if (stream) std::fill_n(pipeline_.begin(), kViewPlanes, kClip);
    tests_sides_ =
        std::any_of(pipeline_.begin(), pipeline_.begin() + kViewPlanes, [](int l) { return l != kNothing; });
    scene_.width = static_cast<int>(view.width_px), scene_.height = static_cast<int>(view.height_px);
    // Streams have no camera. With these planes, a vertex of depth z has the distance 1 / (1 - z / 2).
    scene_.near_z = stream ? 1.0 : view.near_z, scene_.far_z = stream ? 2.0 : view.far_z;
    scene_.triangles.clear(), scene_.faces.clear(), memory.kept_by.clear();
  }

  void add(const Scene& scene, glm::dvec3 centre) {
    std::uint32_t id = 0;
    for (const Instance& instance : scene.instances) {
      const Mesh& mesh = scene.meshes[instance.mesh];
      const glm::dmat4 model = model_matrix(mesh, instance);
      const ScreenTransform to_screen({scene.camera, scene_.width, scene_.height}, model);
      memory_.vertices.clear();
      for (const glm::vec3 p : mesh.positions) {
        const glm::vec3 v = transform(to_screen, p);
        const float inverse_w = 1.0f / v.z;
        const double distance = has_distance_ ? to_screen(p).w : 0.0;
        memory_.vertices.push_back(project(v.x * inverse_w, v.y * inverse_w, v.z, distance));
        if (tests_sides_) memory_.vertices.back().snapped.outside |= outside_of(as_clip_vertex(v), view_);
      }

      // A face is tested by the sign of normal · (ray + scale position), in the mesh's own space.
      const float mirror = glm::determinant(glm::dmat3(model)) < 0.0 ? -1.0f : 1.0f;
      struct {
        std::uint32_t test;
        glm::vec3 ray;
        float scale;
      } tests[] = {
          {bit(kNormalZ), in_mesh_space(glm::dmat3(model), line_of_sight(scene.camera)), 0.0f},
          {bit(kNormalDotObject), in_mesh_space(glm::dmat3(model), centre - scene.camera.position), 0.0f},
          {bit(kNormalDotEye), -mirror * glm::vec3(to_screen.origin), mirror}};
      std::uint32_t kept_by = 0;
      for (std::size_t i = 0; i < mesh.triangles.size(); ++i, ++id) {
        const glm::uvec3 t = mesh.triangles[i];
        if (i == 0 || !mesh.has_flag(i, kSameFace)) {
          kept_by = tests_;
          for (const auto& [test, ray, scale] : tests)
            if ((tests_ & test) != 0 &&
                !(glm::dot(mesh.normals[i], ray + scale * mesh.positions[t.x]) < 0.0f))
              kept_by &= ~test;
        }
        const bool two_sided = mesh.has_flag(i, kTwoSided);
        if (kept_by == 0 && !two_sided) continue;
        add_triangle(memory_.vertices[t.x], memory_.vertices[t.y], memory_.vertices[t.z],
                     {id, two_sided, two_sided ? tests_ : kept_by},
                     [&](int k) { return to_screen(mesh.positions[t[k]]); });
      }
    }
  }

  void add(const TriangleStream& stream) {
    for (std::uint32_t id = 0; id < stream.triangles.size(); ++id) {
      const glm::vec3* const v = stream.triangles[id].vertex;
      const auto clip_vertex = [&](int k) { return ClipVertex{v[k].x, v[k].y, v[k].z, 1.0}; };
      ProjectedVertex corner[3];
      for (int k = 0; k < 3; ++k) {
        corner[k] = project(v[k].x, v[k].y, v[k].z, v[k].z);
        corner[k].snapped.outside |= outside_of(clip_vertex(k), view_);
      }
      add_triangle(corner[0], corner[1], corner[2], {id, false, tests_}, clip_vertex);
    }
  }

 private:
  static constexpr std::uint32_t bit(int i) { return 1u << i; }
  struct Source {
    std::uint32_t id;
    bool two_sided;
    std::uint32_t kept_by;  // facing tests, by bits; those of areas keep it so far
  };

  // A flag beside those of Outside: the screen position is not finite.
  static constexpr std::uint32_t kNowhere = 2 * kNotFinite;

  // Of a stream, both are its depth.
  ProjectedVertex project(float x_px, float y_px, double front_end_distance, double distance) const {
    ProjectedVertex v{x_px, y_px, 0.0, {0, 0, 0, kNowhere}};
    if (!std::isfinite(x_px) || !std::isfinite(y_px)) return v;
    const int bits = pipeline_[kSubpixel];
    v.snapped = {snap(double{x_px}, bits), snap(double{y_px}, bits), 0, 0};
    if (has_depth_)
      v.snapped.z = stream_ ? quantize_depth(static_cast<float>(distance)) : depth_.units(front_end_distance);
    if (has_distance_)
      v.view_z = stream_ ? 1.0 / (1.0 - distance / 2.0) : std::clamp(distance, scene_.near_z, scene_.far_z);
    return v;
  }

  template <typename ClipVertexOf>
  void add_triangle(const ProjectedVertex& a, const ProjectedVertex& b, const ProjectedVertex& c,
                    const Source& source, ClipVertexOf&& clip_vertex) {
    const std::uint32_t any = a.snapped.outside | b.snapped.outside | c.snapped.outside;
    std::uint32_t all = a.snapped.outside & b.snapped.outside & c.snapped.outside & kInvisible;
    if ((any & kNotFinite) != 0) return;
    std::uint32_t clipped = kMustClip;
    for (std::size_t i = 0; i < kViewPlanes; ++i) {
      if ((any & kPlanes[i]) == 0 || pipeline_[i] == kClip) continue;
      if (pipeline_[i] == kNothing) all = 0;
      // Clipping at the sides would hide the lack of a near plane: a point between two of them has w >= 0.
      clipped &= kPlanes[i] == kNear ? 0 : ~kPlanes[i];
    }
    if (all != 0) return;
    if ((any & clipped) == 0) return emit(a, b, c, source);

    // As the library clips: a corner that is inside keeps its snapped position.
    const ProjectedVertex* const corners[] = {&a, &b, &c};
    ClipVertex triangle[3];
    std::uint32_t planes = 0;
    for (int k = 0; k < 3; ++k) {
      triangle[k] = clip_vertex(k);
      if (is_inside(corners[k]->snapped))
        triangle[k].corner = k;
      else
        planes |= outside_of(triangle[k], view_) & clipped;
    }
    if ((planes & kNear) != 0) planes |= kGuard & clipped;
    const auto polygon = memory_.clipper.clip(triangle, static_cast<std::uint16_t>(planes), view_);
    if (polygon.size() < 3) return;
    std::array<ProjectedVertex, Clipper::kMaxVertices> projected;
    std::array<Vertex, Clipper::kMaxVertices> snapped;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const ClipVertex& v = polygon[i];
      projected[i] = v.corner >= 0 ? *corners[v.corner] : project(x_px(v), y_px(v), v.z, v.z);
      snapped[i] = projected[i].snapped;
    }
    const Pieces pieces = split({snapped.data(), polygon.size()});
    for (std::size_t i = 0; i < pieces.count; ++i) {
      const auto [p, q, r] = pieces.corners[i];
      emit(projected[p], projected[q], projected[r], source);
    }
  }

  void emit(const ProjectedVertex& a, const ProjectedVertex& b, const ProjectedVertex& c,
            const Source& source) {
    if (((a.snapped.outside | b.snapped.outside | c.snapped.outside) & kNowhere) != 0) return;
    const VisibilityTriangle t{{{a.snapped.x_q15, b.snapped.x_q15, c.snapped.x_q15},
                                {a.snapped.y_q15, b.snapped.y_q15, c.snapped.y_q15},
                                {a.snapped.z, b.snapped.z, c.snapped.z},
                                source.id},
                               {a.x_px, b.x_px, c.x_px},
                               {a.y_px, b.y_px, c.y_px},
                               {a.view_z, b.view_z, c.view_z}};
    if (contract::pixel_box(t.screen, scene_.width, scene_.height).empty()) return;
    std::uint32_t kept_by = source.kept_by;
    if (!source.two_sided) {
      if ((kept_by & bit(kFloatArea)) != 0 && !(area_px(t) > 0.0)) kept_by &= ~bit(kFloatArea);
      if ((kept_by & bit(kSnappedArea)) != 0) {
        const std::int64_t area = contract::signed_area(t.screen);
        if (!keeps(cull_, (area > 0) - (area < 0))) kept_by &= ~bit(kSnappedArea);
      }
      if (kept_by == 0) return;
    }
    scene_.faces.push_back({static_cast<std::uint32_t>(scene_.triangles.size()), 1});
    scene_.triangles.push_back(t);
    memory_.kept_by.push_back(static_cast<std::uint8_t>(kept_by));
  }

  Pipeline pipeline_;
  Cull cull_;
  std::uint32_t tests_;  // the facing tests that are made
  ViewVolume view_;
  bool stream_, has_depth_, has_distance_, tests_sides_;
  ViewDepth depth_;
  PipelineMemory& memory_;
  VisibilityScene& scene_;
};

}  // namespace

std::string name_of(Stage stage) {
  constexpr const char* kNames[] = {"near plane",    "far plane",  "guard band",  "facing test",
                                    "subpixel bits", "visibility", "depth buffer"};
  return kNames[stage];
}

std::vector<std::string> levels_of(Stage stage) {
  std::vector<std::string> levels;
  switch (stage) {
    case kFacing:
      return {std::begin(kFacingTests), std::end(kFacingTests)};
    case kVisibility:
      return {std::begin(kVisibilities), std::end(kVisibilities)};
    case kDepth:
      add_bits(levels, 1, kOurDepth);
      levels.insert(levels.end(), std::begin(kOtherDepths), std::end(kOtherDepths));
      return levels;
    case kSubpixel:
      add_bits(levels, 0, Coarse::kSubBits);
      return levels;
    default:
      return {"nothing", "drop whole triangles", "clip"};
  }
}

Pipeline exact_pipeline() {
  return {kClip, kClip, kClip, kSnappedArea, Coarse::kSubBits, kDepthBuffer, kOurDepth};
}

bool is_weaker(const Pipeline& a, const Pipeline& b) {
  const bool normals = a[kFacing] != b[kFacing] && a[kFacing] != kNoTest;
  const bool painters =
      a[kVisibility] != b[kVisibility] && a[kVisibility] != 0 && b[kVisibility] != kDepthBuffer;
  return a != b && !normals && !painters &&
         std::ranges::equal(a, b, [](int less, int more) { return less <= more; });
}

Pipeline pipeline_of(const Levels& levels) {
  Pipeline pipeline = exact_pipeline();
  std::size_t found = 0;
  for (std::size_t s = 0; s < kStages; ++s) {
    const auto stage = static_cast<Stage>(s);
    const auto named = levels.find(name_of(stage));
    if (named == levels.end()) continue;
    const auto all = levels_of(stage);
    const auto level = std::ranges::find(all, named->second);
    if (level == all.end())
      throw std::invalid_argument("'" + named->second + "' is no level of '" + name_of(stage) + "'");
    pipeline[s] = static_cast<int>(level - all.begin()), ++found;
  }
  if (found != levels.size()) throw std::invalid_argument("not the stages of a pipeline");
  return pipeline;
}

std::vector<std::uint32_t> right_picture(const CoverageScene& scene, int threads) {
  if (scene.truth) return scene.truth->visible_triangles(scene.window(), threads).triangle;
  auto ids = exact_visible_triangles(scene.floats, scene.window(), threads).triangle;
  for (std::uint32_t& id : ids)
    if (id != kNoTriangle) id = scene.floats[id].payload;
  return ids;
}

std::vector<std::uint32_t> PipelineMemory::picture() const {
  std::vector<std::uint32_t> ids = frame.visible;
  for (std::uint32_t& id : ids)
    if (id != kNoTriangle) id = scene.triangles[id].screen.payload;
  return ids;
}

PipelineFrame::PipelineFrame(const Drawable& drawable, const FrontendOptions& options)
    : drawable_(drawable), size_{options.width, options.height}, cull_(options.cull) {
  auto* const scene = std::get_if<Scene>(&drawable_);
  if (scene == nullptr) return;
  for (Mesh& mesh : scene->meshes) mesh.fill_normals(mesh.triangles.size());
  glm::dvec3 sum(0.0);
  std::size_t vertices = 0;
  for (const Instance& instance : scene->instances) {
    const Mesh& mesh = scene->meshes.at(instance.mesh);
    const glm::dmat4 model = model_matrix(mesh, instance);
    for (const glm::uvec3 t : mesh.triangles)
      for (int k = 0; k < 3; ++k, ++vertices)
        sum += glm::dvec3(model * glm::dvec4(glm::dvec3(mesh.positions.at(t[k])), 1.0));
  }
  centre_ = sum / static_cast<double>(vertices);
}

void PipelineFrame::draw(const Pipeline& pipeline, PipelineMemory& memory) const {
  assemble(pipeline, false, memory);
  draw_of(pipeline)(memory.scene, memory.frame);
}

void PipelineFrame::assemble(const Pipeline& pipeline, bool for_all, PipelineMemory& memory) const {
  const auto* const scene = std::get_if<Scene>(&drawable_);
  const ViewVolume view = scene != nullptr ? view_volume(camera_of(*scene), size_.width, size_.height)
                                           : ViewVolume{double(size_.width), double(size_.height), 0.0, 1.0};
  Assembly assembly(pipeline, for_all, cull_, view, scene == nullptr, memory);
  if (scene != nullptr)
    assembly.add(*scene, centre_);
  else
    assembly.add(std::get<TriangleStream>(drawable_));
}

}  // namespace edgewise::lab
