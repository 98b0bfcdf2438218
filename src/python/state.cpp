#include "python/state.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <utility>
#include <variant>
#include <vector>

#include "frontend/scene_edits.h"
#include "frontend/submission.h"

namespace edgewise::python {

namespace {

// All that a mesh holds, by its name in a pickle. Clusters are made anew.
template <typename MeshType, typename Visit>
void visit_fields(MeshType& mesh, Visit&& visit) {
  visit("positions", mesh.positions);
  visit("triangles", mesh.triangles);
  visit("colours", mesh.colours);
  visit("flags", mesh.flags);
  visit("normals", mesh.normals);
  visit("origin", mesh.origin);
  visit("parts", mesh.parts);
}

template <typename T>
py::object to_python(const std::vector<T>& values) {
  return python::as_array(values);
}
template <typename T>
py::object to_python(const std::vector<glm::vec<3, T>>& values) {
  return Array<T>({static_cast<py::ssize_t>(values.size()), py::ssize_t{3}},
                  reinterpret_cast<const T*>(values.data()));
}

py::object to_python(const glm::dvec3& v) {
  return Matrix(3, glm::value_ptr(v));
}
py::object to_python(const std::vector<MeshPart>& parts) {
  py::list all;
  for (const MeshPart& part : parts) all.append(py::make_tuple(py::bytes(part.name), part.first, part.count));
  return all;
}

template <typename T>
void from_python(const char* name, const py::object& from, std::vector<T>& values) {
  const auto array = from.cast<Array<T>>();
  check(array, name, {-1});
  values = copied<T>(array);
}
template <typename T>
void from_python(const char* name, const py::object& from, std::vector<glm::vec<3, T>>& values) {
  const auto array = from.cast<Array<T>>();
  check(array, name, {-1, 3});
  values = copied<glm::vec<3, T>>(array);
}

void from_python(const char* name, const py::object& from, glm::dvec3& v) {
  const auto array = from.cast<Matrix>();
  check(array, name, {3});
  v = glm::make_vec3(array.data());
}
void from_python(const char*, const py::object& from, std::vector<MeshPart>& parts) {
  for (const auto& [name, first, count] :
       from.cast<std::vector<std::tuple<std::string, std::size_t, std::size_t>>>())
    parts.push_back({name, first, count});
}

py::list meshes_of(const Scene& scene) {
  py::list meshes;
  for (const Mesh& mesh : scene.meshes) {
    py::dict fields;
    visit_fields(mesh, [&](const char* name, const auto& values) { fields[name] = to_python(values); });
    meshes.append(fields);
  }
  return meshes;
}

using Placed = std::vector<std::pair<std::size_t, glm::dmat4>>;
Placed placed_of(const Scene& scene) {
  Placed placed;
  for (const Instance& instance : scene.instances)
    placed.emplace_back(instance.mesh, model_matrix({}, instance));  // draws use this matrix, too
  return placed;
}
py::list as_list(const Placed& placed) {
  py::list instances;
  for (const auto& [mesh, matrix] : placed) instances.append(py::make_tuple(mesh, rows_of(matrix)));
  return instances;
}

Floats as_array(const glm::vec3& v) {
  return Floats(3, glm::value_ptr(v));
}

py::tuple arrays_of(const TriangleStream& stream) {
  const auto count = static_cast<py::ssize_t>(stream.triangles.size());
  Floats vertices({count, py::ssize_t{3}, py::ssize_t{3}});
  Words colours(count);
  for (std::size_t i = 0; i < stream.triangles.size(); ++i) {
    const StreamTriangle& t = stream.triangles[i];
    std::memcpy(vertices.mutable_data() + 9 * i, t.vertex, sizeof t.vertex);
    colours.mutable_data()[i] = t.colour;
  }
  return py::make_tuple(vertices, colours);
}

py::dict state_of(Drawn& self) {
  // Copied first: no array of Python's may be made while other threads wait for the scene.
  const Drawable copy = self.use([](const Drawable& drawable) { return drawable; });
  py::dict state;
  if (const auto* const scene = std::get_if<Scene>(&copy)) {
    state["meshes"] = meshes_of(*scene);
    state["instances"] = as_list(placed_of(*scene));
    state["light"] = as_array(scene->to_light);
  } else {
    const auto& stream = std::get<TriangleStream>(copy);
    state["stream"] = arrays_of(stream) + py::make_tuple(stream.width, stream.height);
  }
  return state;
}

std::unique_ptr<Drawn> from_state(const py::dict& state) {
  if (state.contains("stream")) {
    const auto [vertices, colours, width, height] =
        state["stream"].cast<std::tuple<Floats, Words, int, int>>();
    return stream(vertices, width, height, colours);
  }
  Scene scene;
  for (const py::handle fields : state["meshes"]) {
    Mesh mesh;
    visit_fields(
        mesh, [&](const char* name, auto& values) { from_python(name, py::object(fields[name]), values); });
    add_mesh(scene, std::move(mesh));
  }
  for (const py::handle instance : state["instances"]) {
    const auto [mesh, rows] = instance.cast<std::pair<std::size_t, Matrix>>();
    add_instance(scene, {.mesh = mesh, .matrix = matrix_of(rows, "matrix")});
  }
  const auto light = state["light"].cast<Floats>();
  check(light, "light", {3});
  scene.to_light = checked_light(glm::make_vec3(light.data()));
  return std::make_unique<Drawn>(std::move(scene));
}

}  // namespace

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
  return std::make_unique<Drawn>(std::move(made));
}

void define_state(py::class_<Drawn>& drawn_class) {
  // Not py::pickle, which fails with protocols below 2, and has no copy of its own for deepcopy().
  drawn_class.def(py::init(&from_state))
      .def("__reduce__",
           [](const py::object& self) {
             return py::make_tuple(py::type::of(self), py::make_tuple(state_of(self.cast<Drawn&>())));
           })
      .def("__deepcopy__",
           [](Drawn& self, const py::dict&) {
             return std::make_unique<Drawn>(self.use([](const Drawable& drawable) { return drawable; }));
           })
      .def("meshes",
           [](Drawn& self) { return meshes_of(self.use_scene([](const Scene& scene) { return scene; })); })
      .def("instances", [](Drawn& self) { return as_list(self.use_scene(placed_of)); })
      .def("light",
           [](Drawn& self) {
             return as_array(self.use_scene([](const Scene& scene) { return scene.to_light; }));
           })
      .def("arrays", [](Drawn& self) {
        return arrays_of(
            self.use([](const Drawable& drawable) { return std::get<TriangleStream>(drawable); }));
      });
}

}  // namespace edgewise::python
