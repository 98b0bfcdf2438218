// Pictures, depth maps and their differences.
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "edgewise/image.h"
#include "image/format.h"
#include "python/drawn.h"

namespace edgewise::python {

namespace {

Samples samples_of(const std::variant<Path, Words>& from) {
  if (const auto* const path = std::get_if<Path>(&from))
    return with_file_only([&] { return read_samples(*path); });
  const Words& colours = std::get<Words>(from);
  check(colours, "a picture", {-1, -1});
  Samples samples{side(colours.shape(1)), side(colours.shape(0)), false, {}};
  const auto pixels = copied<std::uint32_t>(colours);
  const Released released;
  samples.pixels.reserve(pixels.size());
  for (const std::uint32_t c : pixels) {
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
    const Released released;
    return difference(a, b, mask ? &*mask : nullptr);
  }();
  const Difference& d = found.outside;
  const py::object first =
      d.count == 0 ? py::object(py::none()) : py::object(py::make_tuple(d.first_x, d.first_y));
  return py::make_tuple(d.count, d.largest, found.scale, first, found.masked, found.ignored,
                        as_array(d.picture.pixels, d.picture.width, d.picture.height));
}

}  // namespace

void define_images(py::module_& m) {
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
}

}  // namespace edgewise::python
