// The extension behind edgewise/__init__.py, which documents it and converts its arguments' types.
#include <cstdint>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "core/parallel.h"
#include "edgewise/camera.h"
#include "edgewise/contract.h"
#include "edgewise/hash.h"
#include "edgewise/limits.h"
#include "edgewise/obj_file.h"
#include "edgewise/scene.h"
#include "edgewise/tri_file.h"
#include "edgewise/visible.h"
#include "files/atomic_file.h"
#include "frontend/checked_edits.h"
#include "python/drawn.h"
#include "raster/checks.h"

namespace edgewise::python {

namespace {

std::unique_ptr<Drawn> drawn(Drawable drawable) {
  return std::make_unique<Drawn>(std::move(drawable));
}

std::vector<std::size_t> first_ids_of(const Drawable& drawable) {
  if (const auto* const scene = std::get_if<Scene>(&drawable)) return first_ids(*scene);
  return {0, std::get<TriangleStream>(drawable).size()};
}

// Counts of pixels by view, as count(frame, drawable) finds them.
template <typename Count>
auto pixels_per(Count count) {
  return [count](Drawn& self, const std::optional<py::array>& payload, const py::array& depth) {
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
    return new_array(frames.shape({static_cast<py::ssize_t>(kinds)}), all.data());
  };
}

// A vertex of an array of float or double.
template <typename Coordinate>
using Point = glm::vec<3, Coordinate>;

template <typename Coordinate>
std::size_t add_arrays(Drawn& self, const Array<Coordinate>& positions, const Words& triangles,
                       const std::optional<Words>& colours, const std::optional<Array<std::uint8_t>>& flags,
                       const std::optional<Floats>& normals, const std::optional<Matrix>& origin,
                       const std::vector<std::tuple<std::string, std::size_t, std::size_t>>& parts) {
  check(positions, "positions", {-1, 3}), check(triangles, "triangles", {-1, 3});
  const py::ssize_t count = triangles.shape(0);
  if (colours) check(*colours, "colours", {count});
  if (flags) check(*flags, "flags", {count});
  if (normals) check(*normals, "normals", {count, 3});
  if (origin) check(*origin, "origin", {3});
  Mesh mesh{.positions = {}, .triangles = copied<glm::uvec3>(triangles), .colours = {}};
  set_vertices(mesh, copied<Point<Coordinate>>(positions));
  if (colours) mesh.colours = copied<std::uint32_t>(*colours);
  if (flags) mesh.flags = copied<std::uint8_t>(*flags);
  if (normals) mesh.normals = copied<glm::vec3>(*normals);
  if (origin) mesh.origin = glm::make_vec3(origin->data());
  return self.use_scene([&](Scene& scene) {
    const std::size_t added = add_mesh(scene, std::move(mesh));
    for (const auto& [name, first, in_part] : parts) add_part(scene, added, {name, first, in_part});
    return added;
  });
}

// The arguments of add_arrays(), by mesh.
py::list arrays_of(const Scene& scene) {
  const auto or_none = [](const auto& values) {
    return values.empty() ? py::object(py::none()) : py::object(as_array(values));
  };
  const auto part_of = [](const MeshPart& part) {
    return py::make_tuple(py::bytes(part.name), part.first, part.count);
  };
  return list_of(scene.meshes, [&](const Mesh& mesh) {
    return py::make_tuple(as_array(mesh.positions), as_array(mesh.triangles), as_array(mesh.colours),
                          or_none(mesh.flags), or_none(mesh.normals), Matrix(3, glm::value_ptr(mesh.origin)),
                          list_of(mesh.parts, part_of));
  });
}

template <auto list, typename Coordinate>
std::unique_ptr<Drawn> stream(const Array<Coordinate>& vertices, const std::optional<Words>& colours,
                              int width, int height) {
  check(vertices, "vertices", {-1, 3, 3});
  if (colours) check(*colours, "colours", {vertices.shape(0)});
  TriangleStream made{width, height, {}};
  auto& triangles = made.*list;
  triangles.resize(static_cast<std::size_t>(vertices.shape(0)));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    auto& t = triangles[i];
    std::memcpy(t.vertex, vertices.data() + 9 * i, sizeof t.vertex);
    t.colour = colours ? colours->data()[i] : kLightGrey;
  }
  return drawn(std::move(made));
}

template <typename Coordinate, typename Triangle>
py::tuple arrays_of(const TriangleStream& stream, const std::vector<Triangle>& triangles) {
  const auto count = static_cast<py::ssize_t>(triangles.size());
  Array<Coordinate> vertices({count, py::ssize_t{3}, py::ssize_t{3}});
  Words colours(count);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    std::memcpy(vertices.mutable_data() + 9 * i, t.vertex, sizeof t.vertex);
    colours.mutable_data()[i] = t.colour;
  }
  return py::make_tuple(vertices, colours, stream.width, stream.height);
}
// The arguments of stream(). Python's streams have triangles of one kind.
py::tuple arrays_of(const TriangleStream& stream) {
  return stream.exact.empty() ? arrays_of<float>(stream, stream.triangles)
                              : arrays_of<double>(stream, stream.exact);
}

template <typename Coordinate>
void move_vertices(Drawn& self, std::size_t mesh, const Array<Coordinate>& positions) {
  check(positions, "positions", {-1, 3});
  auto moved = copied<Point<Coordinate>>(positions);
  self.use_scene(
      [&](Scene& scene) { set_positions(scene, mesh, moved.size(), [&] { return std::move(moved); }); });
}

}  // namespace

PYBIND11_MODULE(_native, m) {
  using OptionalArray = std::optional<py::array>;

  m.attr("VERSION") = EDGEWISE_VERSION;
  m.attr("PYBIND11") = py::make_tuple(PYBIND11_VERSION_MAJOR, PYBIND11_VERSION_MINOR);
  m.attr("MAX_THREADS") = kMaxThreads;
  m.attr("MIN_SUBPIXEL_BITS") = kMinSubpixelBits;
  m.attr("MAX_SUBPIXEL_BITS") = kMaxSubpixelBits;
  m.attr("DEPTH_HEAD") = contract::kDepthHead;
  m.attr("DEPTH_RANGE") = contract::kDepthRange;
  m.attr("DEPTH_CLEAR") = contract::kDepthClear;
  m.attr("MAX_SIDE") = contract::kMaxImageSide;
  m.attr("BACKENDS") =
      list_of(backends(), [](const BackendInfo& backend) { return py::str(std::string(backend.name)); });
  m.attr("TWO_SIDED") = kTwoSided;
  m.attr("PARALLEL_FOR") = py::capsule(&detail::parallel_for);

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
    const Released released;
    check(frames[0]);
    return hash_of(frames[0]);
  });
  m.def("visible_triangles", [](const OptionalArray& payload, const py::array& depth) {
    const Frames frames(payload, depth, false);
    std::vector<std::vector<std::uint32_t>> views;
    {
      const Released released;
      for (std::size_t i = 0; i < frames.views; ++i) views.push_back(visible_triangles(frames[i]));
    }
    return list_of(views, [](const auto& ids) { return as_array(ids); });
  });

  m.def("read_obj", [](const Path& path) {
    ObjReport report;
    auto read = with_file_only([&] { return drawn(read_obj(path, {}, &report)); });
    return std::pair(std::move(read), list_of(report.warnings, text_of));
  });
  m.def("read_tri", [](const Path& path) { return with_file_only([&] { return drawn(read_tri(path)); }); });

  py::class_<Drawn>(m, "Drawable")
      .def(py::init([] { return drawn(Scene{}); }))
      .def(py::init(&stream<&TriangleStream::triangles, float>))
      .def(py::init(&stream<&TriangleStream::exact, double>))
      .def("__deepcopy__",
           [](Drawn& self, const py::dict&) {
             return drawn(self.use([](const Drawable& drawable) { return drawable; }));
           })
      // Copies first: while other threads wait for the scene, no Python array may be made.
      .def("arrays",
           [](Drawn& self) -> py::object {
             const Drawable copy = self.use([](const Drawable& drawable) { return drawable; });
             return std::visit([](const auto& held) -> py::object { return arrays_of(held); }, copy);
           })
      .def("triangles",  // by mesh, after the number of its vertices
           [](Drawn& self) {
             std::vector<std::pair<std::size_t, std::vector<glm::uvec3>>> held;
             self.use_scene([&](const Scene& scene) {
               for (const Mesh& mesh : scene.meshes) held.emplace_back(mesh.positions.size(), mesh.triangles);
             });
             return list_of(
                 held, [](const auto& mesh) { return py::make_tuple(mesh.first, as_array(mesh.second)); });
           })
      .def("instances",
           [](Drawn& self) {
             const auto held = self.use_scene([](const Scene& scene) { return scene.instances; });
             const DefaultFloatState state;
             return list_of(held, [](const Instance& instance) {  // draws use this matrix, too
               return py::make_tuple(instance.mesh, rows_of(model_matrix({}, instance)));
             });
           })
      .def("light",
           [](Drawn& self) {
             const glm::vec3 light = self.use_scene([](const Scene& scene) { return scene.to_light; });
             return new_array({3}, glm::value_ptr(light));
           })
      .def("add_mesh", add_arrays<float>)
      .def("add_mesh", add_arrays<double>)
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
      .def("set_positions", move_vertices<float>)
      .def("set_positions", move_vertices<double>)
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
               const auto& held = std::get<TriangleStream>(drawable);
               return std::pair(held.width, held.height);
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
      .def("objects",
           [](Drawn& self) {
             py::dict all;
             for (const auto& [name, ids] : self.use_scene([](const Scene& scene) { return objects(scene); }))
               all[text_of(name)] = as_array(ids);
             return all;
           })
      .def("pixels_per_triangle", pixels_per([](const FrameView& ids, const Drawable& drawable) {
             return pixels_per_triangle(ids, first_ids_of(drawable).back());
           }))
      .def("pixels_per_instance", pixels_per([](const FrameView& ids, const Drawable& drawable) {
             return pixels_per_instance(ids, std::get<Scene>(drawable));
           }))
      .def("pixels_per_mesh", pixels_per([](const FrameView& ids, const Drawable& drawable) {
             return pixels_per_mesh(ids, std::get<Scene>(drawable));
           }))
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
      .def("barycentrics", &Drawn::barycentrics);

  define_images(m);
}

}  // namespace edgewise::python
