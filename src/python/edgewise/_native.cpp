// The extension behind edgewise/__init__.py, which documents it. Arrays are checked here; conversions of their
// types are made there.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/barycentrics.h"
#include "edgewise/camera.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "edgewise/hash.h"
#include "edgewise/image.h"
#include "edgewise/obj_file.h"
#include "edgewise/scene.h"
#include "edgewise/visible.h"

namespace py = pybind11;
using namespace edgewise;

namespace {

template <typename T>
using Array = py::array_t<T, py::array::c_style>;
using Matrix = Array<double>;

// Throws ValueError unless an array has these sides; -1: any.
template <typename T>
void check(const Array<T>& array, const char* name, std::initializer_list<py::ssize_t> sides) {
  bool same = array.ndim() == static_cast<py::ssize_t>(sides.size());
  std::string wanted;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const py::ssize_t side = sides.begin()[i];
    same = same && (side < 0 || array.shape(static_cast<py::ssize_t>(i)) == side);
    wanted += (i == 0 ? "" : ", ") + (side < 0 ? std::string("n") : std::to_string(side));
  }
  if (!same) throw std::invalid_argument(std::string(name) + " must have the shape (" + wanted + ")");
}

// numpy stores rows, glm columns.
glm::dmat4 matrix_of(const Matrix& rows, const char* name) {
  check(rows, name, {4, 4});
  return glm::transpose(glm::make_mat4(rows.data()));
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

struct Views {
  std::vector<CameraMatrices> cameras;

  Views(const Matrix& views, const Matrix& projections) {
    check(views, "views", {-1, 4, 4}), check(projections, "projections", {views.shape(0), 4, 4});
    for (py::ssize_t i = 0; i < views.shape(0); ++i)
      cameras.push_back({glm::transpose(glm::make_mat4(views.data(i))),
                         glm::transpose(glm::make_mat4(projections.data(i)))});
  }
};

// Frames of one size, one after the other.
struct Frames {
  std::uint32_t *depth, *payload;
  int width, height;

  Frames(std::optional<Array<std::uint32_t>>& payloads, Array<std::uint32_t>& depths) {
    check(depths, "depth", {-1, -1, -1});
    if (payloads) check(*payloads, "payload", {depths.shape(0), depths.shape(1), depths.shape(2)});
    depth = depths.mutable_data(), payload = payloads ? payloads->mutable_data() : nullptr;
    constexpr py::ssize_t kTooLarge = contract::kMaxImageSide + 1;
    height = static_cast<int>(std::min(depths.shape(1), kTooLarge));
    width = static_cast<int>(std::min(depths.shape(2), kTooLarge));
  }
  FrameView operator[](std::size_t i) const {
    const std::size_t at = i * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return {depth + at, payload != nullptr ? payload + at : nullptr, width, height, width};
  }
};

Cull cull_of(const std::string& name) {
  for (const Cull cull : cull_modes())
    if (name == name_of(cull)) return cull;
  throw std::invalid_argument("cull must be none, back, front or both, not " + name);
}

// A scene, and what draws it. Draws of one scene take turns.
struct DrawnScene {
  Scene scene;
  Frontend frontend;
  std::map<std::string, std::unique_ptr<Backend>> backends;
  std::mutex busy;

  Backend& backend(const std::string& name) {
    auto& made = backends[name];
    if (made == nullptr) made = find_backend(name).make();
    return *made;
  }
};

}  // namespace

PYBIND11_MODULE(_native, m) {
  using namespace py::literals;
  using Words = Array<std::uint32_t>;
  using Floats = Array<float>;

  m.def("perspective", [](double fov_y, double aspect, double near_z, double far_z) {
    return rows_of(perspective_projection(fov_y, aspect, near_z, far_z));
  });
  m.def("orthographic", [](double left, double right, double bottom, double top, double near_z, double far_z) {
    return rows_of(orthographic_projection(left, right, bottom, top, near_z, far_z));
  });
  m.def("intrinsics",
        [](const Matrix& k, int width, int height, double first_centre, double near_z, double far_z) {
          check(k, "k", {3, 3});
          const glm::dmat3 rows = glm::make_mat3(k.data());
          return rows_of(intrinsics_projection(glm::transpose(rows), width, height, first_centre, near_z, far_z));
        });
  m.def("projection_from", [](const Matrix& projection, bool z_from_minus_w, bool y_down, bool reversed) {
    return rows_of(projection_from({z_from_minus_w, y_down, reversed}, matrix_of(projection, "projection")));
  });

  m.attr("DEPTH_HEAD") = contract::kDepthHead;
  m.attr("DEPTH_RANGE") = contract::kDepthRange;
  m.def("pixel_hash", [](Words payload, Words depth) {
    std::optional<Words> payloads = payload;
    const Frames frames(payloads, depth);
    if (depth.shape(0) != 1) throw std::invalid_argument("a hash is that of one view");
    return hash_of(frames[0]);
  });
  m.def("visible_triangles", [](Words payload, Words depth) {
    std::optional<Words> payloads = payload;
    const Frames frames(payloads, depth);
    std::vector<Words> views;
    for (std::size_t i = 0; i < static_cast<std::size_t>(depth.shape(0)); ++i) {
      const auto ids = visible_triangles(frames[i]);
      views.emplace_back(static_cast<py::ssize_t>(ids.size()), ids.data());
    }
    return views;
  });

  py::class_<DrawnScene>(m, "Scene")
      .def(py::init<>())
      .def_static("read_obj",
                  [](const std::filesystem::path& path) {
                    auto read = std::make_unique<DrawnScene>();
                    const py::gil_scoped_release released;
                    read->scene = read_obj(path);
                    return read;
                  })
      .def("add_mesh",
           [](DrawnScene& self, const Floats& positions, const Words& triangles, const std::optional<Words>& colours,
              bool two_sided) {
             check(positions, "positions", {-1, 3}), check(triangles, "triangles", {-1, 3});
             const auto count = static_cast<std::size_t>(triangles.shape(0));
             Mesh mesh{.positions = copied<glm::vec3>(positions),
                       .triangles = copied<glm::uvec3>(triangles),
                       .colours = std::vector<std::uint32_t>(count, rgb(200, 200, 200))};
             if (colours) {
               check(*colours, "colours", {triangles.shape(0)});
               mesh.colours = copied<std::uint32_t>(*colours);
             }
             for (const glm::uvec3 t : mesh.triangles)
               if (const std::uint32_t most = std::max({t.x, t.y, t.z}); most >= mesh.positions.size())
                 throw std::invalid_argument("a triangle names vertex " + std::to_string(most) + " of " +
                                             std::to_string(mesh.positions.size()));
             if (two_sided) mesh.flags.assign(count, kTwoSided);
             mesh.clusters = clusters_of(mesh);
             const std::lock_guard lock(self.busy);
             self.scene.meshes.push_back(std::move(mesh));
             return self.scene.meshes.size() - 1;
           })
      .def("add_instance",
           [](DrawnScene& self, std::size_t mesh, const Matrix& matrix) {
             const std::lock_guard lock(self.busy);
             if (mesh >= self.scene.meshes.size())
               throw std::invalid_argument("mesh " + std::to_string(mesh) + " of " +
                                           std::to_string(self.scene.meshes.size()));
             self.scene.instances.push_back({.mesh = mesh, .matrix = matrix_of(matrix, "matrix")});
             return self.scene.instances.size() - 1;
           })
      .def("set_instance",
           [](DrawnScene& self, std::size_t instance, const Matrix& matrix) {
             const std::lock_guard lock(self.busy);
             if (instance >= self.scene.instances.size())
               throw std::invalid_argument("instance " + std::to_string(instance) + " of " +
                                           std::to_string(self.scene.instances.size()));
             self.scene.instances[instance].matrix = matrix_of(matrix, "matrix");
           })
      .def("set_light",
           [](DrawnScene& self, double x, double y, double z) {
             const std::lock_guard lock(self.busy);
             self.scene.to_light = glm::dvec3(x, y, z);
           })
      .def("first_ids",
           [](DrawnScene& self) {
             const std::lock_guard lock(self.busy);
             return first_ids(self.scene);
           })
      .def("camera",
           [](DrawnScene& self, double aspect) {
             const std::lock_guard lock(self.busy);
             frame_camera(self.scene, aspect);
             const CameraMatrices m = matrices_of(self.scene.camera, aspect);
             return py::make_tuple(rows_of(m.view), rows_of(m.projection));
           })
      .def("draw",
           [](DrawnScene& self, const Matrix& views, const Matrix& projections, std::optional<Words> payload, Words depth,
              const std::string& cull, bool ids, bool shade, int threads, const std::string& backend,
              std::uint32_t background, bool clear, const std::optional<std::array<int, 4>>& scissor) {
             const Views cameras(views, projections);
             const Frames frames(payload, depth);
             if (static_cast<py::ssize_t>(cameras.cameras.size()) != depth.shape(0))
               throw std::invalid_argument("there must be one frame per camera");
             FrontendOptions options{.width = frames.width, .height = frames.height, .cull = cull_of(cull), .shade = shade};
             options.payload = ids ? Payload::id : Payload::colour;
             options.threads = threads;
             RenderPass pass{.background = background, .clear = clear};
             if (scissor) pass.scissor = {(*scissor)[0], (*scissor)[1], (*scissor)[2], (*scissor)[3]};
             const py::gil_scoped_release released;
             const std::lock_guard lock(self.busy);
             for (std::size_t i = 0; i < cameras.cameras.size(); ++i) {
               self.scene.matrices = cameras.cameras[i];
               draw(self.scene, self.frontend, options, self.backend(backend), frames[i], pass, {.threads = threads});
             }
           })
      .def("barycentrics", [](DrawnScene& self, const Matrix& view, const Matrix& projection, Words payload, Words depth,
                              const std::string& cull, int threads) {
        const CameraMatrices camera{matrix_of(view, "view"), matrix_of(projection, "projection")};
        std::optional<Words> payloads = payload;
        const Frames frames(payloads, depth);
        FrontendOptions options{.width = frames.width, .height = frames.height, .cull = cull_of(cull)};
        options.payload = Payload::id;
        options.threads = threads;
        Floats uv({depth.shape(1), depth.shape(2), py::ssize_t{2}}), distance({depth.shape(1), depth.shape(2)});
        const BarycentricsView out{uv.mutable_data(), 2 * frames.width, distance.mutable_data(), frames.width};
        {
          const py::gil_scoped_release released;
          const std::lock_guard lock(self.busy);
          self.scene.matrices = camera;
          barycentrics(frames[0], self.scene, options, out);
        }
        return py::make_tuple(uv, distance);
      });
}
