// The extension behind edgewise/__init__.py, which documents it and converts its arguments' types.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <glm/gtc/type_ptr.hpp>
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/atomic_file.h"
#include "core/nearest_name.h"
#include "edgewise/backend.h"
#include "edgewise/barycentrics.h"
#include "edgewise/camera.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "edgewise/hash.h"
#include "edgewise/image.h"
#include "edgewise/obj_file.h"
#include "edgewise/scene.h"
#include "edgewise/tri_file.h"
#include "edgewise/visible.h"
#include "frontend/scene_edits.h"
#include "frontend/submission.h"
#include "image/format.h"
#include "lab/needs/needs.h"
#include "lab/portable/portable.h"
#include "lab/view_space.h"
#include "raster/checks.h"

namespace py = pybind11;
using namespace edgewise;

namespace {

using Path = std::filesystem::path;
template <typename T>
using Array = py::array_t<T, py::array::c_style>;
using Matrix = Array<double>;
using Words = Array<std::uint32_t>;
using Floats = Array<float>;

// Throws unless an array has these sides; -1: any.
void check(const py::array& array, const char* name, std::initializer_list<py::ssize_t> sides) {
  bool same = array.ndim() == static_cast<py::ssize_t>(sides.size());
  std::string wanted;
  py::ssize_t i = 0;
  for (const py::ssize_t side : sides) {
    same = same && (side < 0 || array.shape(i) == side);
    wanted += (i++ == 0 ? "" : ", ") + (side < 0 ? std::string("n") : std::to_string(side));
  }
  if (!same) throw std::invalid_argument(std::string(name) + " must have the shape (" + wanted + ")");
}

// numpy stores rows, glm columns.
glm::dmat4 matrix_at(const double* rows) {
  return glm::transpose(glm::make_mat4(rows));
}
glm::dmat4 matrix_of(const Matrix& rows, const char* name) {
  check(rows, name, {4, 4});
  return matrix_at(rows.data());
}
Matrix rows_of(const glm::dmat4& matrix) {
  Matrix rows({4, 4});
  const glm::dmat4 transposed = glm::transpose(matrix);
  std::copy_n(glm::value_ptr(transposed), 16, rows.mutable_data());
  return rows;
}

template <typename To, typename From>
std::vector<To> copied(const Array<From>& from) {
  std::vector<To> to(static_cast<std::size_t>(from.nbytes()) / sizeof(To));
  if (!to.empty()) std::memcpy(to.data(), from.data(), static_cast<std::size_t>(from.nbytes()));
  return to;
}

// `height` rows.
template <typename T>
Array<T> as_array(const std::vector<T>& values, int width, int height) {
  return Array<T>({height, width}, values.data());
}
template <typename T>
Array<T> as_array(const std::vector<T>& values) {
  return Array<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

// One camera per view; none for a stream.
std::vector<CameraMatrices> cameras_of(const Matrix& views, const Matrix& projections) {
  std::vector<CameraMatrices> cameras;
  if (views.size() == 0 && projections.size() == 0) return cameras;
  check(views, "views", {-1, 4, 4}), check(projections, "projections", {views.shape(0), 4, 4});
  for (py::ssize_t i = 0; i < views.shape(0); ++i)
    cameras.push_back({matrix_at(views.data(i)), matrix_at(projections.data(i))});
  return cameras;
}

// A side in px; one too large for a frame stays so.
int side(py::ssize_t length) {
  return static_cast<int>(std::min(length, py::ssize_t{std::numeric_limits<int>::max()}));
}

// A plane of one frame, (height, width), or of several, (views, height, width), in the caller's memory.
struct Plane {
  std::uint32_t* first;
  py::ssize_t views, height, width;
  py::ssize_t view_stride, stride;  // px

  Plane(const py::array& array, const char* name, bool written) {
    const auto require = [&](bool met, const char* what) {
      if (!met) throw std::invalid_argument(std::string(name) + " must " + what);
    };
    constexpr py::ssize_t kPixel = sizeof(std::uint32_t);
    const py::ssize_t dims = array.ndim();
    require(py::isinstance<py::array_t<std::uint32_t>>(array), "be an array of uint32");
    require(dims == 2 || dims == 3, "have the shape (height, width) or (views, height, width)");
    require(!written || array.writeable(), "not be read-only");
    views = dims == 3 ? array.shape(0) : 1, height = array.shape(dims - 2), width = array.shape(dims - 1);
    // The stride of an axis means nothing if no element is followed by another along it.
    const auto step = [&](py::ssize_t axis, py::ssize_t otherwise) {
      if (array.shape(axis) <= 1 || array.size() == 0) return otherwise;
      require(array.strides(axis) % kPixel == 0, "be aligned");
      return array.strides(axis) / kPixel;
    };
    require(reinterpret_cast<std::uintptr_t>(array.data()) % kPixel == 0, "be aligned");
    require(step(dims - 1, 1) == 1, "have contiguous rows");
    stride = step(dims - 2, width);
    require(stride >= width, "have rows that follow one another");
    view_stride = dims == 3 ? step(0, height * stride) : 0;
    require(views <= 1 || view_stride >= (height - 1) * stride + width, "have views that follow one another");
    first = static_cast<std::uint32_t*>(const_cast<void*>(array.data()));
  }
  const std::uint32_t* end() const {
    return first + (views - 1) * view_stride + (height - 1) * stride + width;
  }
};

// The planes of frames of one size.
class Frames {
 public:
  Frames(const std::optional<py::array>& payload, const py::array& depth, bool written)
      : depth_(depth, "depth", written) {
    views = static_cast<std::size_t>(depth_.views), width = side(depth_.width), height = side(depth_.height);
    is_stack = depth.ndim() == 3;
    if (!payload) return;
    payload_.emplace(*payload, "payload", written);
    const auto shape_of = [](const Plane& p) { return std::array{p.views, p.height, p.width}; };
    const auto strides_of = [](const Plane& p) { return std::array{p.view_stride, p.stride}; };
    if (payload->ndim() != depth.ndim() || shape_of(*payload_) != shape_of(depth_))
      throw std::invalid_argument("payload and depth must have the same shape");
    if (strides_of(*payload_) != strides_of(depth_))
      throw std::invalid_argument("payload and depth must have the same strides");
    if (written && payload_->first < depth_.end() && depth_.first < payload_->end())
      throw std::invalid_argument("payload and depth must not overlap");
  }

  std::size_t views;
  int width, height;  // px
  bool is_stack;      // with an axis of views

  FrameView operator[](std::size_t view) const {
    const py::ssize_t at = static_cast<py::ssize_t>(view) * depth_.view_stride;
    return {depth_.first + at, payload_ ? payload_->first + at : nullptr, width, height, depth_.stride};
  }
  // The shape of an array with something for each view: (views, …), or (…).
  std::vector<py::ssize_t> shape(std::initializer_list<py::ssize_t> of_view) const {
    std::vector<py::ssize_t> all(of_view);
    if (is_stack) all.insert(all.begin(), depth_.views);
    return all;
  }

 private:
  Plane depth_;
  std::optional<Plane> payload_;
};

Cull cull_of(std::string_view name) {
  return find_named("culling mode", name, cull_modes(), [](Cull cull) { return name_of(cull); });
}

FrontendOptions options_of(int width, int height, std::string_view cull, int threads) {
  FrontendOptions options;
  options.width = width, options.height = height;
  options.cull = cull_of(cull);
  options.payload = Payload::id;
  options.threads = threads;
  return options;
}

// Text that may hold bytes of a file or of its name.
py::str text_of(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeFSDefaultAndSize(bytes.data(), static_cast<Py_ssize_t>(bytes.size())));
}

// Calls f() for a file. What is wrong with the file becomes an OSError.
template <typename F>
auto with_file(F&& f) {
  try {
    return f();
  } catch (const std::runtime_error& error) {
    PyErr_SetObject(PyExc_OSError, text_of(error.what()).ptr());
  }
  throw py::error_already_set();
}
// The same, without the GIL.
template <typename F>
auto with_file_only(F&& f) {
  return with_file([&] {
    const py::gil_scoped_release released;
    return f();
  });
}

// A scene or a stream, and what draws it. Calls take turns.
class Drawn {
 public:
  explicit Drawn(Drawable drawable) : drawable_(std::move(drawable)) {}

  // Calls f(drawable) without the GIL, so f touches nothing of Python's.
  template <typename F>
  auto use(F&& f) {
    const py::gil_scoped_release released;
    const std::lock_guard lock(busy_);
    return f(drawable_);
  }
  template <typename F>
  auto use_scene(F&& f) {
    return use([&](Drawable& drawable) { return f(std::get<Scene>(drawable)); });
  }
  // Calls f(drawable, view) for each view, seen by its camera.
  template <typename F>
  void for_each_view(const std::vector<CameraMatrices>& cameras, std::size_t views, F&& f) {
    use([&](Drawable& drawable) {
      auto* const scene = std::get_if<Scene>(&drawable);
      if (scene != nullptr && cameras.size() != views)
        throw std::invalid_argument(std::to_string(cameras.size()) + " cameras for " + std::to_string(views) +
                                    " views");
      for (std::size_t i = 0; i < views; ++i) {
        if (scene != nullptr) scene->matrices = cameras[i];
        f(drawable, i);
      }
    });
  }

  void draw(const Matrix& views, const Matrix& projections, const std::optional<py::array>& payload,
            const py::array& depth, bool ids, std::uint32_t first_id, const std::string& cull, bool shade,
            int threads, const std::string& backend, std::uint32_t background, bool clear,
            const std::optional<std::array<int, 4>>& scissor) {
    const auto cameras = cameras_of(views, projections);
    const Frames frames(payload, depth, true);
    FrontendOptions options = options_of(frames.width, frames.height, cull, threads);
    options.payload = ids ? Payload::id : Payload::colour;
    options.first_id = first_id;
    options.shade = shade;
    RenderPass pass{.background = background, .clear = clear};
    if (scissor) pass.scissor = {(*scissor)[0], (*scissor)[1], (*scissor)[2], (*scissor)[3]};
    for_each_view(cameras, frames.views, [&](const Drawable& drawable, std::size_t i) {
      auto& made = backends_[backend];
      if (made == nullptr) made = find_backend(backend).make();
      edgewise::draw(drawable, frontend_, options, *made, frames[i], pass, {.threads = threads});
    });
  }

  py::tuple barycentrics(const Matrix& views, const Matrix& projections,
                         const std::optional<py::array>& payload, const py::array& depth,
                         std::uint32_t first_id, const std::string& cull, int threads) {
    const auto cameras = cameras_of(views, projections);
    const Frames frames(payload, depth, false);
    FrontendOptions options = options_of(frames.width, frames.height, cull, threads);
    options.first_id = first_id;
    if (frames.is_stack) throw std::invalid_argument("barycentrics need a frame of one view");
    Floats uv({frames.height, frames.width, 2}), distance({frames.height, frames.width});
    const BarycentricsView out{uv.mutable_data(), 2 * frames.width, distance.mutable_data(), frames.width};
    for_each_view(cameras, 1, [&](const Drawable& drawable, std::size_t) {
      edgewise::barycentrics(frames[0], drawable, options, out);
    });
    return py::make_tuple(uv, distance);
  }

 private:
  Drawable drawable_;
  Frontend frontend_;
  std::map<std::string, std::unique_ptr<Backend>> backends_;
  std::mutex busy_;
};

std::unique_ptr<Drawn> drawn(Drawable drawable) {
  return std::make_unique<Drawn>(std::move(drawable));
}

std::vector<std::size_t> first_ids_of(const Drawable& drawable) {
  if (const auto* const scene = std::get_if<Scene>(&drawable)) return first_ids(*scene);
  return {0, std::get<TriangleStream>(drawable).triangles.size()};
}

// Counts of pixels by view, as count(frame, drawable) finds them.
template <typename Count>
Words pixels_per(Drawn& self, const std::optional<py::array>& payload, const py::array& depth,
                 Count&& count) {
  const Frames frames(payload, depth, false);
  std::vector<std::uint32_t> all;
  std::size_t kinds = 0;
  self.use([&](const Drawable& drawable) {
    for (std::size_t i = 0; i < frames.views; ++i) {
      const auto counts = count(frames[i], drawable);
      kinds = counts.size();
      all.insert(all.end(), counts.begin(), counts.end());
    }
  });
  return Words(frames.shape({static_cast<py::ssize_t>(kinds)}), all.data());
}

std::size_t add_arrays(Drawn& self, const Floats& positions, const Words& triangles,
                       const std::optional<Words>& colours, bool two_sided) {
  check(positions, "positions", {-1, 3}), check(triangles, "triangles", {-1, 3});
  if (colours) check(*colours, "colours", {triangles.shape(0)});
  Mesh mesh{
      .positions = copied<glm::vec3>(positions), .triangles = copied<glm::uvec3>(triangles), .colours = {}};
  if (colours) mesh.colours = copied<std::uint32_t>(*colours);
  if (two_sided) mesh.flags.assign(mesh.triangles.size(), kTwoSided);
  return self.use_scene([&](Scene& scene) { return add_mesh(scene, std::move(mesh)); });
}

std::unique_ptr<Drawn> stream(const Floats& vertices, int width, int height,
                              const std::optional<Words>& colours) {
  check(vertices, "vertices", {-1, 3, 3});
  if (colours) check(*colours, "colours", {vertices.shape(0)});
  TriangleStream made{width, height, {}};
  made.triangles.resize(static_cast<std::size_t>(vertices.shape(0)));
  for (std::size_t i = 0; i < made.triangles.size(); ++i) {
    StreamTriangle& t = made.triangles[i];
    std::memcpy(t.vertex, vertices.data() + 9 * i, sizeof t.vertex);
    t.colour = colours ? colours->data()[i] : kLightGrey;
  }
  return drawn(std::move(made));
}

py::object as_tuple(const std::optional<lab::Witness>& w) {
  if (!w) return py::none();
  return py::make_tuple(w->frame, w->x_px, w->y_px, py::tuple(py::cast(w->right)),
                        py::tuple(py::cast(w->drawn)));
}

py::list as_list(const std::vector<lab::Question>& questions) {
  py::list all;
  for (const lab::Question& q : questions) {
    py::list answers;
    for (const lab::Answer& a : q.answers)
      answers.append(py::make_tuple(a.name, as_tuple(a.witness), a.wrong_px));
    const auto text = [](bool there, const std::string& s) -> py::object {
      return there ? py::object(py::str(s)) : py::none();
    };
    const lab::Answer* const needed = q.needed();
    all.append(py::make_tuple(q.name, text(needed != nullptr, needed != nullptr ? needed->name : ""),
                              text(!q.proof.empty(), q.proof), q.trials, q.trial, q.error, answers));
  }
  return all;
}

py::tuple needs(Drawn& self, const Matrix& views, const Matrix& projections, int width, int height,
                const std::string& cull, std::optional<double> displacement, int threads) {
  if (displacement && !(*displacement >= 0.0 && *displacement <= 1e6))
    throw std::invalid_argument("displacement must be 0 to 10^6");
  const auto cameras = cameras_of(views, projections);
  const FrontendOptions options = options_of(width, height, cull, threads);
  check_threads(threads);
  lab::Needs found({.displacement = displacement, .threads = threads});
  lab::LeastPrecise least;
  self.for_each_view(cameras, std::max<std::size_t>(cameras.size(), 1),
                     [&](const Drawable& drawable, std::size_t) {
                       found.add(lab::with_camera(drawable, {width, height}), options);
                     });
  {
    const py::gil_scoped_release released;
    least = found.least_precise();
  }
  py::dict reach;
  const bool is_stream = cameras.empty();
  for (int i = 0; !is_stream && i < lab::kViewPlanes; ++i) {
    const auto plane = static_cast<lab::ViewPlane>(i);
    const lab::Reach& r = found.ranges().reach(plane);
    reach[py::str(std::string(name_of(plane)))] = py::make_tuple(r.beyond, r.crossing);
  }
  std::vector<int> bits;
  for (int i = 0; i <= lab::kMostSubpixelBits; ++i) bits.push_back(found.ranges().edge_value_bits(i));
  return py::make_tuple(found.frames(), as_list(least.stages), least.orders, least.others,
                        is_stream ? 0 : found.unlike_scene(), as_list(found.stages()), as_list(found.edges()),
                        reach, bits);
}

Array<std::uint8_t> portable(Drawn& self, const Matrix& views, const Matrix& projections, int width,
                             int height, const std::string& cull, int bits, int ulps, int guard_band,
                             const std::string& depth, int threads) {
  const lab::Conformance model{bits, ulps, guard_band, lab::find_depth_format(depth)};
  const auto cameras = cameras_of(views, projections);
  const FrontendOptions options = options_of(width, height, cull, threads);
  lab::PortablePixels found{};
  self.for_each_view(cameras, 1, [&](const Drawable& drawable, std::size_t) {
    const Drawable seen = lab::with_camera(drawable, {width, height});
    found = lab::portable_pixels(lab::portable_triangles(seen, options), width, height, model, threads);
  });
  static_assert(sizeof(lab::Unstable) == 1);
  return Array<std::uint8_t>({height, width}, reinterpret_cast<const std::uint8_t*>(found.reasons.data()));
}

Samples samples_of(const std::variant<Path, Words>& from) {
  if (const auto* const path = std::get_if<Path>(&from))
    return with_file_only([&] { return read_samples(*path); });
  const Words& colours = std::get<Words>(from);
  check(colours, "a picture", {-1, -1});
  Samples samples{side(colours.shape(1)), side(colours.shape(0)), false, {}};
  for (const std::uint32_t c : copied<std::uint32_t>(colours)) {
    const auto sample = [&](int shift) { return static_cast<std::uint16_t>((c >> shift & 255) * 257); };
    samples.pixels.push_back({sample(0), sample(8), sample(16)});
  }
  return samples;
}

DepthMap map_of(const Floats& depth) {
  check(depth, "a depth map", {-1, -1});
  return {side(depth.shape(1)), side(depth.shape(0)), copied<float>(depth)};
}
DepthMap map_of(const std::variant<Path, Floats>& from) {
  const auto* const path = std::get_if<Path>(&from);
  return path == nullptr ? map_of(std::get<Floats>(from)) : with_file_only([&] { return read_pfm(*path); });
}

template <typename T>
py::tuple diff(const T& a, const T& b, const std::optional<std::variant<Path, Words>>& mask_from) {
  std::optional<Samples> mask;
  if (mask_from) mask = samples_of(*mask_from);
  const MaskedDifference found = [&] {
    const py::gil_scoped_release released;
    return difference(a, b, mask ? &*mask : nullptr);
  }();
  const Difference& d = found.outside;
  const py::object first =
      d.count == 0 ? py::object(py::none()) : py::object(py::make_tuple(d.first_x, d.first_y));
  return py::make_tuple(d.count, d.largest, found.scale, first, found.masked, found.ignored,
                        as_array(d.picture.pixels, d.picture.width, d.picture.height));
}

}  // namespace

PYBIND11_MODULE(_native, m) {
  using OptionalArray = std::optional<py::array>;

  m.attr("VERSION") = EDGEWISE_VERSION;
  m.attr("DEPTH_HEAD") = contract::kDepthHead;
  m.attr("DEPTH_RANGE") = contract::kDepthRange;
  m.attr("DEPTH_CLEAR") = contract::kDepthClear;
  m.attr("MAX_SIDE") = contract::kMaxImageSide;
  py::list names, reasons;
  for (const BackendInfo& backend : backends()) names.append(std::string(backend.name));
  for (int i = 0; i < lab::kUnstableKinds; ++i)
    reasons.append(std::string(name_of(static_cast<lab::Unstable>(i))));
  m.attr("BACKENDS") = names;
  m.attr("UNSTABLE") = reasons;

  m.def("perspective", [](double fov_y, double aspect, double near_z, double far_z) {
    return rows_of(perspective_projection(fov_y, aspect, near_z, far_z));
  });
  m.def("orthographic",
        [](double left, double right, double bottom, double top, double near_z, double far_z) {
          return rows_of(orthographic_projection(left, right, bottom, top, near_z, far_z));
        });
  m.def("intrinsics",
        [](const Matrix& k, int width, int height, double first_centre, double near_z, double far_z) {
          check(k, "k", {3, 3});
          const glm::dmat3 columns = glm::transpose(glm::make_mat3(k.data()));
          return rows_of(intrinsics_projection(columns, width, height, first_centre, near_z, far_z));
        });
  m.def("projection_from", [](const Matrix& projection, bool z_from_minus_w, bool y_down, bool reversed) {
    return rows_of(projection_from({z_from_minus_w, y_down, reversed}, matrix_of(projection, "projection")));
  });

  m.def("pixel_hash", [](const OptionalArray& payload, const py::array& depth) {
    const Frames frames(payload, depth, false);
    if (frames.is_stack) throw std::invalid_argument("a hash is that of a frame of one view");
    const py::gil_scoped_release released;
    (void)checked(frames[0], Execution{});
    return hash_of(frames[0]);
  });
  m.def("visible_triangles", [](const OptionalArray& payload, const py::array& depth) {
    const Frames frames(payload, depth, false);
    std::vector<std::vector<std::uint32_t>> views;
    {
      const py::gil_scoped_release released;
      for (std::size_t i = 0; i < frames.views; ++i) views.push_back(visible_triangles(frames[i]));
    }
    py::list arrays;
    for (const auto& ids : views) arrays.append(as_array(ids));
    return arrays;
  });

  m.def("read_image", [](const Path& path) {
    const Image image = with_file_only([&] { return read_image(path); });
    return as_array(image.pixels, image.width, image.height);
  });
  m.def("write_image", [](const Path& path, const Words& colours) {
    check(colours, "colours", {-1, -1});
    const Image image{side(colours.shape(1)), side(colours.shape(0)), copied<std::uint32_t>(colours)};
    with_file_only([&] { write_image(path, image); });
  });
  m.def("read_pfm", [](const Path& path) {
    const DepthMap map = with_file_only([&] { return read_pfm(path); });
    return as_array(map.depth01, map.width, map.height);
  });
  m.def("write_pfm", [](const Path& path, const Floats& depth) {
    const DepthMap map = map_of(depth);
    with_file_only([&] { write_pfm(path, map); });
  });
  using Picture = std::variant<Path, Words>;
  using Depths = std::variant<Path, Floats>;
  m.def("diff_pictures", [](const Picture& a, const Picture& b, const std::optional<Picture>& mask) {
    return diff(samples_of(a), samples_of(b), mask);
  });
  m.def("diff_depths", [](const Depths& a, const Depths& b, const std::optional<Picture>& mask) {
    return diff(map_of(a), map_of(b), mask);
  });

  m.def("read_obj", [](const Path& path) {
    ObjReport report;
    auto read = with_file_only([&] { return drawn(read_obj(path, {}, &report)); });
    py::list warnings;
    for (const std::string& warning : report.warnings) warnings.append(text_of(warning));
    return std::pair(std::move(read), warnings);
  });
  m.def("read_tri", [](const Path& path) { return with_file_only([&] { return drawn(read_tri(path)); }); });
  m.def("stream", stream);

  py::class_<Drawn>(m, "Drawable")
      .def(py::init([] { return drawn(Scene{}); }))
      .def("add_mesh", add_arrays)
      .def("add_instance",
           [](Drawn& self, std::size_t mesh, const Matrix& rows) {
             const Instance instance{.mesh = mesh, .matrix = matrix_of(rows, "matrix")};
             return self.use_scene([&](Scene& scene) { return add_instance(scene, instance); });
           })
      .def("set_instance",
           [](Drawn& self, std::size_t index, const Matrix& rows) {
             const glm::dmat4 matrix = matrix_of(rows, "matrix");
             self.use_scene([&](Scene& scene) { set_instance(scene, index, matrix); });
           })
      .def("remove_instance",
           [](Drawn& self, std::size_t index) {
             self.use_scene([&](Scene& scene) { remove_instance(scene, index); });
           })
      .def("set_positions",
           [](Drawn& self, std::size_t mesh, const Floats& positions) {
             check(positions, "positions", {-1, 3});
             auto moved = copied<glm::vec3>(positions);
             self.use_scene([&](Scene& scene) {
               set_positions(scene, mesh, moved.size(), [&](auto& of_mesh) { of_mesh.swap(moved); });
             });
           })
      .def("set_light",
           [](Drawn& self, double x, double y, double z) {
             self.use_scene([&](Scene& scene) { scene.to_light = checked_light({x, y, z}); });
           })
      .def("bounds",
           [](Drawn& self) {
             const Bounds box = self.use_scene([](const Scene& scene) { return bounds_of(scene); });
             const auto corner = [](const glm::dvec3& p) { return Matrix(3, glm::value_ptr(p)); };
             return py::make_tuple(corner(box.low), corner(box.high));
           })
      .def("camera",
           [](Drawn& self, double aspect) {
             const CameraMatrices camera = self.use_scene([&](Scene& scene) {
               frame_camera(scene, checked_aspect(aspect));
               return matrices_of(scene.camera, aspect);
             });
             return py::make_tuple(rows_of(camera.view), rows_of(camera.projection));
           })
      .def("size",
           [](Drawn& self) {
             return self.use([](const Drawable& drawable) {
               const auto& triangles = std::get<TriangleStream>(drawable);
               return std::pair(triangles.width, triangles.height);
             });
           })
      .def("write_tri",
           [](Drawn& self, const Path& path) {
             with_file([&] {
               self.use([&](const Drawable& drawable) {
                 AtomicFile file(path);
                 write_tri(file.stream(), std::get<TriangleStream>(drawable));
                 file.commit();
               });
             });
           })
      .def("first_ids", [](Drawn& self) { return self.use(first_ids_of); })
      .def("pixels_per_triangle",
           [](Drawn& self, const OptionalArray& payload, const py::array& depth) {
             return pixels_per(self, payload, depth, [](const FrameView& ids, const Drawable& drawable) {
               return pixels_per_triangle(ids, first_ids_of(drawable).back());
             });
           })
      .def("pixels_per_instance",
           [](Drawn& self, const OptionalArray& payload, const py::array& depth) {
             return pixels_per(self, payload, depth, [](const FrameView& ids, const Drawable& drawable) {
               return pixels_per_instance(ids, std::get<Scene>(drawable));
             });
           })
      .def("pixels_per_mesh",
           [](Drawn& self, const OptionalArray& payload, const py::array& depth) {
             return pixels_per(self, payload, depth, [](const FrameView& ids, const Drawable& drawable) {
               return pixels_per_mesh(ids, std::get<Scene>(drawable));
             });
           })
      .def("visible",
           [](Drawn& self, const Matrix& low, const Matrix& high, const Matrix& views,
              const Matrix& projections, const py::array& depth) {
             check(low, "low", {-1, 3}), check(high, "high", {low.shape(0), 3});
             const auto cameras = cameras_of(views, projections);
             const Frames frames({}, depth, false);
             Array<bool> seen(low.shape(0));
             bool* const out = seen.mutable_data();
             const std::size_t boxes = static_cast<std::size_t>(low.shape(0));
             const double *const lows = low.data(), *const highs = high.data();
             self.for_each_view(cameras, frames.views, [&](const Drawable& drawable, std::size_t) {
               for (std::size_t i = 0; i < boxes; ++i)
                 out[i] = visible({glm::make_vec3(lows + 3 * i), glm::make_vec3(highs + 3 * i)},
                                  std::get<Scene>(drawable), frames[0]);
             });
             return seen;
           })
      .def("draw", &Drawn::draw)
      .def("barycentrics", &Drawn::barycentrics)
      .def("needs", needs)
      .def("portable", portable);
}
