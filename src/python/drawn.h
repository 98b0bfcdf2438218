// A scene or stream that Python draws. Options, file errors and text, which the files of this folder share.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <chrono>
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

#include "core/float_state.h"
#include "core/input_file.h"
#include "core/nearest_name.h"
#include "edgewise/barycentrics.h"
#include "edgewise/draw.h"
#include "python/arrays.h"
#include "python/gil.h"

namespace edgewise::python {

using Path = std::filesystem::path;

inline Cull cull_of(std::string_view name) {
  return find_named("culling mode", name, cull_modes(), [](Cull cull) { return name_of(cull); });
}

inline FrontendOptions options_of(int width, int height, std::string_view cull, int subpixel_bits = 8) {
  FrontendOptions options;
  options.width = width, options.height = height, options.subpixel_bits = subpixel_bits;
  options.cull = cull_of(cull);
  options.payload = Payload::id;
  return options;
}

// The counts of edgewise.Stats, in its order.
using Counts = std::array<std::uint64_t, 15>;
static_assert(sizeof(Counts) == sizeof(FrontendStats));

// Text that may hold bytes of a file or of its name.
inline py::str text_of(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeFSDefaultAndSize(bytes.data(), static_cast<Py_ssize_t>(bytes.size())));
}

// Calls f() for a file. What is wrong with the file becomes an OSError: FileNotFoundError, PermissionError
// and so on where the system says why.
template <typename F>
auto with_file(F&& f) {
  try {
    return f();
  } catch (const FileError& error) {
    const py::object os_error = py::reinterpret_borrow<py::object>(PyExc_OSError);
    const py::object made = error.code != 0
                                ? os_error(error.code, text_of(error.reason), text_of(error.path.string()))
                                : os_error(text_of(error.what()));
    PyErr_SetObject(py::type::of(made).ptr(), made.ptr());
  } catch (const std::runtime_error& error) {
    PyErr_SetObject(PyExc_OSError, text_of(error.what()).ptr());
  }
  throw py::error_already_set();
}
// The same, without the GIL.
template <typename F>
auto with_file_only(F&& f) {
  return with_file([&] {
    const Released released;
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
    if (drawer_->process != getpid()) drawer_.reset(new Drawer);
    const Released released;
    const std::lock_guard lock(drawer_->busy);
    const DefaultFloatState state;  // for the laboratory
    return f(drawable_);
  }
  template <typename F>
  auto use_scene(F&& f) {
    return use([&](Drawable& drawable) { return f(std::get<Scene>(drawable)); });
  }
  // Calls f(drawable, view) for each view, seen by its camera. After each turn of views, signals are handled,
  // and progress(number of views in the turn) is called, which may use the drawable as other threads may.
  template <typename F>
  void for_each_view(const std::vector<CameraMatrices>& cameras, std::size_t views, F&& f,
                     const py::object& progress = py::none()) {
    const bool is_scene = std::holds_alternative<Scene>(drawable_);
    if (cameras.size() != (is_scene ? views : 0))
      throw std::invalid_argument(std::to_string(cameras.size()) + " cameras for " +
                                  (is_scene ? std::to_string(views) + " views" : "a stream"));
    for (std::size_t next = 0; next < views;) {
      const std::size_t first = next;
      use([&](Drawable& drawable) {
        auto* const scene = std::get_if<Scene>(&drawable);
        const auto end = std::chrono::steady_clock::now() + kTurn;
        do {
          if (scene != nullptr) scene->matrices = cameras[next];
          f(drawable, next++);
        } while (next < views && std::chrono::steady_clock::now() < end);
      });
      handle_signals();
      report(progress, next - first);
    }
  }

  // Returns the counts summed over the views.
  Counts draw(const Matrix& views, const Matrix& projections, const std::optional<py::array>& payload,
              const py::array& depth, bool ids, std::uint32_t first_id, const std::string& cull,
              int subpixel_bits, int threads, bool shade, const std::string& backend,
              std::uint32_t background, bool clear, const std::optional<std::array<int, 4>>& scissor,
              const py::object& progress) {
    const auto cameras = cameras_of(views, projections);
    const Frames frames(payload, depth, true);
    FrontendOptions options = options_of(frames.width, frames.height, cull, subpixel_bits);
    options.payload = ids ? Payload::id : Payload::colour;
    options.first_id = first_id;
    options.shade = shade;
    RenderPass pass{.background = background, .clear = clear};
    if (scissor) pass.scissor = {(*scissor)[0], (*scissor)[1], (*scissor)[2], (*scissor)[3]};
    FrontendStats stats;
    const auto draw_view = [&](const Drawable& drawable, std::size_t i) {
      const BackendInfo& found = find_backend(backend);
      auto& made = drawer_->backends[backend];
      if (made == nullptr) made = found.make();
      edgewise::draw(drawable, drawer_->frontend, options, *made, frames[i], pass, {.threads = threads});
      stats += drawer_->frontend.stats();
    };
    for_each_view(cameras, frames.views, draw_view, progress);
    return std::bit_cast<Counts>(stats);
  }

  py::tuple barycentrics(const Matrix& views, const Matrix& projections,
                         const std::optional<py::array>& payload, const py::array& depth,
                         std::uint32_t first_id, const std::string& cull, int subpixel_bits, int threads,
                         const py::object& progress) {
    const auto cameras = cameras_of(views, projections);
    const Frames frames(payload, depth, false);
    FrontendOptions options = options_of(frames.width, frames.height, cull, subpixel_bits);
    options.first_id = first_id;
    Floats uv(frames.shape({frames.height, frames.width, 2})),
        distance(frames.shape({frames.height, frames.width}));
    float *const uvs = uv.mutable_data(), *const distances = distance.mutable_data();
    const std::size_t pixels =
        static_cast<std::size_t>(frames.width) * static_cast<std::size_t>(frames.height);
    const auto fill_view = [&](const Drawable& drawable, std::size_t i) {
      edgewise::barycentrics(frames[i], drawable, options,
                             {uvs + 2 * pixels * i, 2 * frames.width, distances + pixels * i, frames.width},
                             {.threads = threads});
    };
    for_each_view(cameras, frames.views, fill_view, progress);
    return py::make_tuple(uv, distance);
  }

 private:
  // Short for a person. Far longer than taking the GIL, for which Python may need 5 ms.
  static constexpr std::chrono::milliseconds kTurn{50};

  // A forked child makes a new one: a thread of its parent may have been drawing with the old one, which
  // stays.
  struct Drawer {
    pid_t process = getpid();
    std::mutex busy;
    Frontend frontend;
    std::map<std::string, std::unique_ptr<Backend>> backends;
  };
  struct Delete {
    void operator()(Drawer* drawer) const {
      if (drawer->process == getpid()) delete drawer;
    }
  };

  Drawable drawable_;
  std::unique_ptr<Drawer, Delete> drawer_{new Drawer};
};

// Pictures, depth maps and their differences.
void define_images(py::module_& m);

}  // namespace edgewise::python
