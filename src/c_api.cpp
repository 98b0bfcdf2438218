// The C interface (edgewise.h). No exception leaves it.
#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <exception>
#include <glm/gtc/type_ptr.hpp>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/float_state.h"
#include "edgewise/barycentrics.h"
#include "edgewise/camera.h"
#include "edgewise/contract.h"
#include "edgewise/draw.h"
#include "edgewise/edgewise.h"
#include "edgewise/hash.h"
#include "edgewise/visible.h"
#include "frontend/checked_edits.h"
#include "raster/checks.h"

using namespace edgewise;

struct edgewise_scene {
  Drawable drawable;
};
struct edgewise_renderer {
  Frontend frontend;
  std::unique_ptr<Backend> backend;
};

namespace {

// Not a std::string: exit handlers may call after it would be destroyed.
constinit thread_local char last_error[1024] = "";

edgewise_status failed(edgewise_status status, const char* text) noexcept {
  std::snprintf(last_error, sizeof last_error, "%s", text);
  return status;
}

// Calls f() in the caller's floating-point state, and turns what it throws into a status.
template <typename F>
edgewise_status status_in_callers_state(F&& f) noexcept {
  try {
    f();
    return EDGEWISE_OK;
  } catch (const std::bad_alloc&) {
    return failed(EDGEWISE_OUT_OF_MEMORY, "out of memory");
  } catch (const std::length_error&) {  // of a vector, or of the tiles' lists
    return failed(EDGEWISE_OUT_OF_MEMORY, "too many elements");
  } catch (const std::invalid_argument& error) {
    return failed(EDGEWISE_INVALID_ARGUMENT, error.what());
  } catch (const std::exception& error) {
    return failed(EDGEWISE_FAILED, error.what());
  } catch (...) {
    return failed(EDGEWISE_FAILED, "unknown error");
  }
}
template <typename F>
edgewise_status status_of(F&& f) noexcept {
  const DefaultFloatState state;
  return status_in_callers_state(f);
}

template <typename T>
T& given(T* pointer, const char* name) {
  if (pointer == nullptr) throw std::invalid_argument(std::string(name) + " is null");
  return *pointer;
}

// The meshes, instances and camera of a handle.
template <typename Handle>
auto& meshes_of(Handle* scene) {
  auto* const found = std::get_if<Scene>(&given(scene, "scene").drawable);
  if (found == nullptr) throw std::invalid_argument("a stream has neither meshes nor a camera");
  return *found;
}

// `count` elements that lie `stride` bytes apart; 0: without gaps.
template <typename T, typename Source>
std::vector<T> copied(const Source* first, std::size_t count, std::size_t stride, const char* name) {
  if (count != 0) given(first, name);
  if (stride != 0 && stride < sizeof(T))
    throw std::invalid_argument(std::string(name) + ": a stride of " + std::to_string(stride) +
                                " bytes is below " + std::to_string(sizeof(T)));
  std::vector<T> to(count);
  const auto* const bytes = reinterpret_cast<const char*>(first);
  const std::size_t step = stride != 0 ? stride : sizeof(T);
  for (std::size_t i = 0; i < count; ++i) std::memcpy(&to[i], bytes + i * step, sizeof(T));
  return to;
}

// Copies all of `from`, whose size the caller knows.
template <typename T>
void copy_out(const std::vector<T>& from, T* to, const char* name) {
  if (!from.empty()) std::copy(from.begin(), from.end(), &given(to, name));
}

glm::dmat4 matrix_of(const double* elements) {
  return glm::make_mat4(&given(elements, "matrix"));
}
void store(const glm::dmat4& matrix, double* elements, const char* name = "projection") {
  std::copy_n(glm::value_ptr(matrix), 16, &given(elements, name));
}

FrameView view_of(const edgewise_frame& frame) {
  return {frame.depth, frame.payload, frame.width, frame.height, frame.stride};
}

FrontendOptions frontend_options(const edgewise_options& options, const edgewise_frame& frame) {
  constexpr Cull kCull[] = {Cull::none, Cull::back, Cull::front, Cull::both};
  if (options.cull < EDGEWISE_CULL_NONE || options.cull > EDGEWISE_CULL_BOTH)
    throw std::invalid_argument("cull is none of EDGEWISE_CULL_NONE to EDGEWISE_CULL_BOTH");
  FrontendOptions o;
  o.width = frame.width, o.height = frame.height;
  o.subpixel_bits = options.subpixel_bits;
  o.cull = kCull[options.cull];
  o.shade = options.unlit == 0;
  o.payload = options.ids != 0 ? Payload::id : Payload::colour;
  o.first_id = options.first_id;
  return o;
}

// Point: what a vertex is in `positions`.
template <typename Point, typename Coordinate>
void add(edgewise_scene* scene, const edgewise_mesh& m, const Coordinate* positions, size_t* index) {
  Scene& s = meshes_of(scene);
  Mesh made{.positions = {},
            .triangles = copied<glm::uvec3>(m.triangles, m.triangle_count, m.triangle_stride, "triangles"),
            .colours = {}};
  set_vertices(made, copied<Point>(positions, m.vertex_count, m.position_stride, "positions"));
  if (m.colours != nullptr) made.colours.assign(m.colours, m.colours + m.triangle_count);
  if (m.two_sided != 0) made.flags.assign(m.triangle_count, kTwoSided);
  const std::size_t added = add_mesh(s, std::move(made));
  if (index != nullptr) *index = added;
}

}  // namespace

int edgewise_abi(void) {
  return EDGEWISE_ABI;
}

const char* edgewise_error(void) {
  return last_error;
}

edgewise_status edgewise_new_scene(edgewise_scene** scene) {
  return status_of([&] { given(scene, "scene") = new edgewise_scene{Scene{}}; });
}

edgewise_status edgewise_new_stream(const edgewise_stream_triangle* triangles, size_t count,
                                    edgewise_scene** stream) {
  return status_of([&] {
    static_assert(sizeof(edgewise_stream_triangle) == sizeof(StreamTriangle));
    edgewise_scene*& out = given(stream, "stream");
    out = new edgewise_scene{
        TriangleStream{.triangles = copied<StreamTriangle>(triangles, count, 0, "triangles")}};
  });
}

void edgewise_free_scene(edgewise_scene* scene) {
  delete scene;
}

edgewise_status edgewise_add_mesh(edgewise_scene* scene, const edgewise_mesh* mesh, size_t* index) {
  return status_of([&] { add<glm::vec3>(scene, given(mesh, "mesh"), mesh->positions, index); });
}

edgewise_status edgewise_add_mesh_f64(edgewise_scene* scene, const edgewise_mesh* mesh,
                                      const double* positions, size_t* index) {
  return status_of([&] {
    if (given(mesh, "mesh").positions != nullptr)
      throw std::invalid_argument("a mesh with positions in double must not have others");
    add<glm::dvec3>(scene, *mesh, positions, index);
  });
}

edgewise_status edgewise_set_positions(edgewise_scene* scene, size_t mesh, const float* positions,
                                       size_t vertex_count, size_t stride) {
  return status_of([&] {
    set_positions(meshes_of(scene), mesh, vertex_count,
                  [&] { return copied<glm::vec3>(positions, vertex_count, stride, "positions"); });
  });
}

edgewise_status edgewise_set_positions_f64(edgewise_scene* scene, size_t mesh, const double* positions,
                                           size_t vertex_count, size_t stride) {
  return status_of([&] {
    set_positions(meshes_of(scene), mesh, vertex_count,
                  [&] { return copied<glm::dvec3>(positions, vertex_count, stride, "positions"); });
  });
}

edgewise_status edgewise_name_triangles(edgewise_scene* scene, size_t mesh, size_t first, size_t count,
                                        const char* name) {
  return status_of([&] { add_part(meshes_of(scene), mesh, {&given(name, "name"), first, count}); });
}

edgewise_status edgewise_add_instance(edgewise_scene* scene, size_t mesh, const double matrix[16],
                                      size_t* index) {
  return status_of([&] {
    Scene& s = meshes_of(scene);
    Instance instance{.mesh = mesh};
    if (matrix != nullptr) instance.matrix = matrix_of(matrix);
    const std::size_t added = add_instance(s, instance);
    if (index != nullptr) *index = added;
  });
}

edgewise_status edgewise_set_instance(edgewise_scene* scene, size_t instance, const double matrix[16]) {
  return status_of([&] { set_instance(meshes_of(scene), instance, matrix_of(matrix)); });
}

edgewise_status edgewise_remove_instance(edgewise_scene* scene, size_t instance) {
  return status_of([&] { remove_instance(meshes_of(scene), instance); });
}

edgewise_status edgewise_set_light(edgewise_scene* scene, const double direction[3]) {
  return status_of(
      [&] { meshes_of(scene).to_light = checked_light(glm::make_vec3(&given(direction, "direction"))); });
}

edgewise_status edgewise_set_camera(edgewise_scene* scene, const double view[16],
                                    const double projection[16]) {
  return status_of([&] { meshes_of(scene).matrices = {matrix_of(view), matrix_of(projection)}; });
}

edgewise_status edgewise_view(const double position[3], float yaw, float pitch, double view[16]) {
  return status_of([&] {
    const Camera camera{.position = glm::make_vec3(&given(position, "position")), .yaw = yaw, .pitch = pitch};
    store(matrices_of(camera, 1.0).view, view, "view");
  });
}

edgewise_status edgewise_frame_scene(edgewise_scene* scene, double aspect) {
  return status_of([&] { frame_camera(meshes_of(scene), checked_aspect(aspect)); });
}

edgewise_status edgewise_perspective(double fov_y, double aspect, double near_z, double far_z,
                                     double projection[16]) {
  return status_of([&] { store(perspective_projection(fov_y, aspect, near_z, far_z), projection); });
}

edgewise_status edgewise_orthographic(double left, double right, double bottom, double top, double near_z,
                                      double far_z, double projection[16]) {
  return status_of(
      [&] { store(orthographic_projection(left, right, bottom, top, near_z, far_z), projection); });
}

edgewise_status edgewise_intrinsics(const double k[9], int width, int height, double first_centre,
                                    double near_z, double far_z, double projection[16]) {
  return status_of([&] {
    const glm::dmat3 by_rows = glm::make_mat3(&given(k, "k"));
    store(intrinsics_projection(glm::transpose(by_rows), width, height, first_centre, near_z, far_z),
          projection);
  });
}

edgewise_status edgewise_convert_projection(int z_from_minus_w, int y_down, int reversed,
                                            double projection[16]) {
  return status_of([&] {
    const ClipSpace space{z_from_minus_w != 0, y_down != 0, reversed != 0};
    store(projection_from(space, matrix_of(projection)), projection);
  });
}

edgewise_status edgewise_new_renderer(const char* backend, edgewise_renderer** renderer) {
  return status_of([&] {
    edgewise_renderer*& out = given(renderer, "renderer");
    auto made = std::make_unique<edgewise_renderer>();
    made->backend = find_backend(backend != nullptr ? backend : "tiled").make();
    out = made.release();
  });
}

void edgewise_free_renderer(edgewise_renderer* renderer) {
  delete renderer;
}

edgewise_options edgewise_default_options(void) {
  edgewise_options options{};
  options.threads = 1;
  options.background = 0xFF000000;
  options.scissor[2] = options.scissor[3] = contract::kMaxImageSide;
  options.subpixel_bits = FrontendOptions().subpixel_bits;
  return options;
}

edgewise_status edgewise_draw(edgewise_renderer* renderer, const edgewise_scene* scene,
                              const edgewise_options* options, edgewise_frame frame) {
  return status_of([&] {
    const edgewise_options o = options != nullptr ? *options : edgewise_default_options();
    const auto& [x, y, width, height] = o.scissor;
    const RenderPass pass{o.background, o.keep == 0, {x, y, width, height}};
    edgewise_renderer& r = given(renderer, "renderer");
    draw(given(scene, "scene").drawable, r.frontend, frontend_options(o, frame), *r.backend, view_of(frame),
         pass, {.threads = o.threads});
  });
}

edgewise_status edgewise_stats_of(const edgewise_renderer* renderer, edgewise_stats* stats) {
  return status_of([&] {
    given(stats, "stats") = std::bit_cast<edgewise_stats>(given(renderer, "renderer").frontend.stats());
  });
}

edgewise_status edgewise_visible_triangles(edgewise_frame ids, uint32_t* visible, size_t capacity,
                                           size_t* count) {
  return status_of([&] {
    if (capacity != 0) given(visible, "visible");
    size_t& found = given(count, "count");
    const auto all = visible_triangles(view_of(ids));
    std::copy_n(all.begin(), std::min(capacity, all.size()), visible);
    found = all.size();
  });
}

edgewise_status edgewise_pixels_per_triangle(edgewise_frame ids, uint32_t* pixels, size_t triangles) {
  return status_of([&] { copy_out(pixels_per_triangle(view_of(ids), triangles), pixels, "pixels"); });
}

edgewise_status edgewise_pixels_per_instance(edgewise_frame ids, const edgewise_scene* scene,
                                             uint32_t* pixels, size_t instances) {
  return status_of([&] {
    const Scene& s = meshes_of(scene);
    check_count("instances", instances, s.instances.size());
    copy_out(pixels_per_instance(view_of(ids), s), pixels, "pixels");
  });
}

edgewise_status edgewise_pixels_per_mesh(edgewise_frame ids, const edgewise_scene* scene, uint32_t* pixels,
                                         size_t meshes) {
  return status_of([&] {
    const Scene& s = meshes_of(scene);
    check_count("meshes", meshes, s.meshes.size());
    copy_out(pixels_per_mesh(view_of(ids), s), pixels, "pixels");
  });
}

edgewise_status edgewise_first_ids(const edgewise_scene* scene, size_t* first, size_t instances) {
  return status_of([&] {
    const Scene& s = meshes_of(scene);
    check_count("instances", instances, s.instances.size());
    copy_out(first_ids(s), first, "first");
  });
}

edgewise_status edgewise_objects(const edgewise_scene* scene,
                                 void (*each)(void* context, const char* name, const uint32_t* ids,
                                              size_t count),
                                 void* context) {
  return status_in_callers_state([&] {
    given(each, "each");
    for (const auto& [name, ids] : objects(meshes_of(scene)))
      each(context, name.c_str(), ids.data(), ids.size());
  });
}

edgewise_status edgewise_box_visible(const edgewise_scene* scene, const double low[3], const double high[3],
                                     edgewise_frame depth, int* is_visible) {
  return status_of([&] {
    const Bounds box{glm::make_vec3(&given(low, "low")), glm::make_vec3(&given(high, "high"))};
    given(is_visible, "is_visible") = edgewise::visible(box, meshes_of(scene), view_of(depth));
  });
}

edgewise_status edgewise_barycentrics(const edgewise_scene* scene, const edgewise_options* options,
                                      edgewise_frame ids, float* uv, ptrdiff_t uv_stride, float* distance,
                                      ptrdiff_t distance_stride) {
  return status_of([&] {
    const edgewise_options& o = given(options, "options");
    barycentrics(view_of(ids), given(scene, "scene").drawable, frontend_options(o, ids),
                 {uv, uv_stride, distance, distance_stride}, {.threads = o.threads});
  });
}

static_assert(EDGEWISE_DEPTH_CLEAR == contract::kDepthClear);

double edgewise_depth01(uint32_t depth) {
  const DefaultFloatState state;
  return contract::depth01(depth);
}

edgewise_status edgewise_hash(edgewise_frame frame, uint64_t* hash) {
  return status_of([&] {
    check(view_of(frame));
    given(hash, "hash") = hash_of(view_of(frame));
  });
}
