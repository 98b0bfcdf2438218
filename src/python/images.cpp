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

using Shorts = Array<std::uint16_t>;
using From = std::variant<Path, Words, Shorts, Floats>;  // Words: colours, Shorts: 16-bit grey

// What the reader of a file warns of.
using Notes = std::vector<std::string>;

// An Image, a Grey16 or a DepthMap.
template <typename Of, typename Pixel>
Of image_of(const Array<Pixel>& pixels, const char* name) {
  check(pixels, name, {-1, -1});
  return {side(pixels.shape(1)), side(pixels.shape(0)), copied<Pixel>(pixels)};
}

Samples samples_of(const Words& colours) {
  const auto image = image_of<Image>(colours, "a picture");
  const Released released;
  return to_samples(image);
}

Samples samples_of(const Shorts& grey) {
  const auto image = image_of<Grey16>(grey, "a picture of 16-bit grey");
  const Released released;
  Samples samples{image.width, image.height, true, true, {}};
  samples.pixels.reserve(image.pixels.size());
  for (const std::uint16_t g : image.pixels) samples.pixels.push_back({g, g, g, 65535});
  return samples;
}

// (height, width), or (height, width, 3).
FloatMap map_of(const Floats& values) {
  const bool colour = values.ndim() == 3;
  if (colour)
    check(values, "a map of floats", {-1, -1, 3});
  else
    check(values, "a depth map", {-1, -1});
  return {side(values.shape(1)), side(values.shape(0)), colour ? 3 : 1, copied<float>(values)};
}

Picture picture_of(const From& from, Notes& notes) {
  if (const auto* const path = std::get_if<Path>(&from))
    return with_file_only([&] { return read_picture(*path, &notes); });
  if (const auto* const colours = std::get_if<Words>(&from)) return samples_of(*colours);
  if (const auto* const grey = std::get_if<Shorts>(&from)) return samples_of(*grey);
  return map_of(std::get<Floats>(from));
}

py::tuple diff(const From& a_from, const From& b_from, const std::optional<From>& mask_from) {
  Notes notes;
  const Picture a = picture_of(a_from, notes), b = picture_of(b_from, notes);
  std::optional<Picture> mask;
  if (mask_from) mask = picture_of(*mask_from, notes);
  const Difference d = [&] {
    const Released released;
    return difference(a, b, mask ? &*mask : nullptr);
  }();
  const py::object first =
      d.count == 0 ? py::object(py::none()) : py::object(py::make_tuple(d.first_x, d.first_y));
  return py::make_tuple(d.count, d.largest, d.scale, first, d.masked, d.masked_count,
                        as_array(d.picture.pixels, d.picture.width, d.picture.height), d.alpha_count,
                        list_of(notes, text_of));
}

// 16-bit grey stays what it is.
py::tuple read_colours(const Path& path) {
  Notes notes;
  const auto image = with_file_only([&]() -> std::variant<Image, Grey16> {
    const Picture picture = read_picture(path, &notes);
    const auto* const samples = std::get_if<Samples>(&picture);
    if (samples == nullptr || !samples->deep || !samples->grey) return to_image(path, picture);
    return to_grey16(*samples);
  });
  return std::visit(
      [&](const auto& read) {
        return py::make_tuple(as_array(read.pixels, read.width, read.height), list_of(notes, text_of));
      },
      image);
}

template <typename Of, typename Pixel>
auto writer(void (*write)(const Path&, const Of&), const char* name) {
  return [=](const Path& path, const Array<Pixel>& pixels) {
    const auto image = image_of<Of>(pixels, name);
    with_file_only([&] { write(path, image); });
  };
}

}  // namespace

void define_images(py::module_& m) {
  m.def("read_image", read_colours);
  m.def("write_colours", writer<Image, std::uint32_t>(write_image, "colours"));
  m.def("write_grey16", writer<Grey16, std::uint16_t>(write_grey16, "16-bit grey"));
  m.def("write_pfm", writer<DepthMap, float>(write_pfm, "a depth map"));
  m.def("read_pfm", [](const Path& path) {
    const FloatMap map = with_file_only([&] { return read_pfm(path, open_input(path)); });
    std::vector<py::ssize_t> shape{map.height, map.width};
    if (map.channels != 1) shape.push_back(map.channels);
    return new_array(shape, map.values.data());
  });
  m.def("diff", diff);
}

}  // namespace edgewise::python
