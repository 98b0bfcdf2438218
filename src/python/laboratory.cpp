// The extension behind edgewise/lab.py: what the laboratory says of what the extension _native holds.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/execution.h"
#include "core/parallel.h"
#include "lab/needs/needs.h"
#include "lab/portable/portable.h"
#include "lab/view_space.h"
#include "python/drawn.h"

namespace edgewise::python {

namespace {

py::object as_tuple(const std::optional<lab::Witness>& w) {
  if (!w) return py::none();
  return py::make_tuple(w->frame, w->x_px, w->y_px, py::tuple(py::cast(w->right)),
                        py::tuple(py::cast(w->drawn)));
}

py::list as_list(const std::vector<lab::Question>& questions) {
  return list_of(questions, [](const lab::Question& q) {
    const auto answer = [](const lab::Answer& a) {
      return py::make_tuple(a.name, as_tuple(a.witness), a.wrong_px);
    };
    const auto text = [](bool there, const std::string& s) -> py::object {
      return there ? py::object(py::str(s)) : py::none();
    };
    const lab::Answer* const needed = q.needed();
    return py::make_tuple(q.name, text(needed != nullptr, needed != nullptr ? needed->name : ""),
                          text(!q.proof.empty(), q.proof), q.trials, q.trial, q.error,
                          list_of(q.answers, answer));
  });
}

py::list as_list(const std::vector<lab::Curve>& curves, std::uint64_t frames) {
  return list_of(curves, [&](const lab::Curve& c) {
    const auto level = [&](const lab::Level& l) {
      const auto mean = [&](std::uint64_t px) {
        return static_cast<double>(px) / static_cast<double>(frames);
      };
      return py::make_tuple(l.name, mean(l.wrong_px), l.worst_px, mean(l.hidden_px), l.farthest_px(),
                            as_tuple(l.witness));
    };
    return py::make_tuple(name_of(c.stage), list_of(c.levels, level));
  });
}

py::tuple needs(Drawn& self, const Matrix& views, const Matrix& projections, int width, int height,
                const std::string& cull, std::optional<double> displacement, std::uint64_t tolerance,
                int threads, const py::object& progress) {
  if (displacement && !(*displacement >= 0.0 && *displacement <= 1e6))
    throw std::invalid_argument("displacement must be 0 to 10^6");
  const auto cameras = cameras_of(views, projections);
  const FrontendOptions options = options_of(width, height, cull);
  checked({.threads = threads});
  lab::Needs found({.tolerance_px = tolerance, .displacement = displacement, .threads = threads});
  lab::Minima minima;
  const auto add = [&](const Drawable& drawable, std::size_t) {
    found.add(lab::with_camera(drawable, {width, height}), options);
  };
  self.for_each_view(cameras, std::max<std::size_t>(cameras.size(), 1), add, progress);
  const DefaultFloatState state;
  {
    const Released released;
    minima = found.minima();
  }
  py::dict reach;
  const bool is_stream = cameras.empty();
  for (int i = 0; !is_stream && i < lab::kViewPlanes; ++i) {
    const lab::Reach& r = found.ranges().reach(static_cast<lab::ViewPlane>(i));
    reach[py::str(name_of(static_cast<lab::Stage>(i)))] = py::make_tuple(r.beyond, r.crossing);
  }
  std::vector<int> bits;
  for (int i = 0; i <= lab::kMostSubpixelBits; ++i) bits.push_back(found.ranges().edge_value_bits(i));
  const py::object closest =
      minima.right.empty() ? py::object(py::make_tuple(minima.closest, minima.closest_px)) : py::none();
  return py::make_tuple(found.frames(), minima.right, closest, as_list(found.curves(), found.frames()),
                        as_list(found.edges()), reach, bits);
}

Array<std::uint8_t> portable(Drawn& self, const Matrix& views, const Matrix& projections, int width,
                             int height, const std::string& cull, int bits, int ulps, int guard_band,
                             const std::string& depth, int threads) {
  const lab::Conformance model{bits, ulps, guard_band, lab::find_depth_format(depth)};
  const auto cameras = cameras_of(views, projections);
  const FrontendOptions options = options_of(width, height, cull, std::clamp(bits, 8, kMaxSubpixelBits));
  checked({.threads = threads});
  lab::PortablePixels found{};
  self.for_each_view(cameras, 1, [&](const Drawable& drawable, std::size_t) {
    const Drawable seen = lab::with_camera(drawable, {width, height});
    found = lab::portable_pixels(lab::portable_triangles(seen, options), width, height, model, threads);
  });
  static_assert(sizeof(lab::Unstable) == 1);
  return new_array({height, width}, reinterpret_cast<const std::uint8_t*>(found.reasons.data()));
}

}  // namespace

PYBIND11_MODULE(_lab, m) {
  // This extension has a copy of the library.
  const py::capsule of_native = py::module_::import("edgewise._native").attr("PARALLEL_FOR");
  detail::parallel_for = *of_native.get_pointer<detail::ParallelFor>();
  py::list reasons;
  for (int i = 0; i < lab::kUnstableKinds; ++i)
    reasons.append(std::string(name_of(static_cast<lab::Unstable>(i))));
  m.attr("UNSTABLE") = reasons;
  m.def("needs", needs).def("portable", portable);
}

}  // namespace edgewise::python
