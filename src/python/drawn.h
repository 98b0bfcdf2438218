// A scene or stream that Python draws. Options, file errors and text, which the files of this folder share.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
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

#include "core/nearest_name.h"
#include "edgewise/backend.h"
#include "edgewise/barycentrics.h"
#include "edgewise/frontend.h"
#include "edgewise/scene.h"
#include "python/arrays.h"

namespace edgewise::python {

using Path = std::filesystem::path;
using Counts = std::array<std::uint64_t, sizeof(FrontendStats) / sizeof(std::uint64_t)>;

inline Cull cull_of(std::string_view name) {
  return find_named("culling mode", name, cull_modes(), [](Cull cull) { return name_of(cull); });
}

inline FrontendOptions options_of(int width, int height, std::string_view cull, int threads) {
  FrontendOptions options;
  options.width = width, options.height = height;
  options.cull = cull_of(cull);
  options.payload = Payload::id;
  options.threads = threads;
  return options;
}

// Text that may hold bytes of a file or of its name.
inline py::str text_of(const std::string& bytes) {
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

  // Returns the counts of edgewise.Stats, summed over the views.
  Counts draw(const Matrix& views, const Matrix& projections, const std::optional<py::array>& payload,
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
    FrontendStats stats;
    for_each_view(cameras, frames.views, [&](const Drawable& drawable, std::size_t i) {
      auto& made = backends_[backend];
      if (made == nullptr) made = find_backend(backend).make();
      edgewise::draw(drawable, frontend_, options, *made, frames[i], pass, {.threads = threads});
      stats += frontend_.stats();
    });
    return std::bit_cast<Counts>(stats);
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

// Pictures, depth maps and their differences.
void define_images(py::module_& m);
// What the laboratory says of a drawable.
void define_laboratory(py::module_& m, py::class_<Drawn>& drawable);

}  // namespace edgewise::python
