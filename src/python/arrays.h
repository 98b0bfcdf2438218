// Arrays of numpy as matrices, cameras and planes of frames, and back. Checks throw std::invalid_argument.
#pragma once

#include <pybind11/numpy.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <initializer_list>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "edgewise/camera.h"
#include "edgewise/framebuffer.h"

namespace edgewise::python {

namespace py = pybind11;

template <typename T>
using Array = py::array_t<T, py::array::c_style>;
using Matrix = Array<double>;
using Words = Array<std::uint32_t>;
using Floats = Array<float>;

// Throws unless an array has these sides; -1: any, written as a letter.
inline void check(const py::array& array, const char* name, std::initializer_list<py::ssize_t> sides) {
  bool same = array.ndim() == static_cast<py::ssize_t>(sides.size());
  std::string wanted;
  py::ssize_t i = 0;
  for (const py::ssize_t side : sides) {
    same = same && (side < 0 || array.shape(i) == side);
    wanted += (i == 0 ? "" : ", ") + (side < 0 ? std::string(1, "nmk"[i]) : std::to_string(side));
    ++i;
  }
  if (!same) throw std::invalid_argument(std::string(name) + " must have the shape (" + wanted + ")");
}

// A copy. pybind11's own constructor lets numpy copy, which releases the GIL and takes it back, and so would
// unwind the stack while Python ends (gil.h).
template <typename T>
Array<T> new_array(const std::vector<py::ssize_t>& shape, const T* values) {
  Array<T> array(shape);
  std::copy_n(values, array.size(), array.mutable_data());
  return array;
}

// numpy stores rows, glm columns.
inline glm::dmat4 matrix_at(const double* rows) {
  return glm::transpose(glm::make_mat4(rows));
}
inline glm::dmat4 matrix_of(const Matrix& rows, const char* name) {
  check(rows, name, {4, 4});
  return matrix_at(rows.data());
}
inline Matrix rows_of(const glm::dmat4& matrix) {
  return new_array({4, 4}, glm::value_ptr(glm::transpose(matrix)));
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
  return new_array({height, width}, values.data());
}
template <typename T>
Array<T> as_array(const std::vector<T>& values) {
  return new_array({static_cast<py::ssize_t>(values.size())}, values.data());
}
template <typename T>
Array<T> as_array(const std::vector<glm::vec<3, T>>& rows) {
  return new_array({static_cast<py::ssize_t>(rows.size()), 3}, reinterpret_cast<const T*>(rows.data()));
}

// convert(value) of each.
template <typename Values, typename Convert>
py::list list_of(const Values& values, Convert&& convert) {
  py::list all;
  for (const auto& value : values) all.append(convert(value));
  return all;
}

// One camera per view; none for a stream.
inline std::vector<CameraMatrices> cameras_of(const Matrix& views, const Matrix& projections) {
  std::vector<CameraMatrices> cameras;
  if (views.size() == 0 && projections.size() == 0) return cameras;
  check(views, "views", {-1, 4, 4}), check(projections, "projections", {views.shape(0), 4, 4});
  for (py::ssize_t i = 0; i < views.shape(0); ++i)
    cameras.push_back({matrix_at(views.data(i)), matrix_at(projections.data(i))});
  return cameras;
}

// A side in px; one too large for a frame stays so.
inline int side(py::ssize_t length) {
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

}  // namespace edgewise::python
