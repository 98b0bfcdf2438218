// PFM, as defined by Debevec's HDRShop: "Pf", width, height, a scale, then rows of floats, the bottom row
// first. A negative scale means little endian. The scale's size is a unit of light and is ignored.
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <span>
#include <string>

#include "core/atomic_file.h"
#include "core/little_endian.h"
#include "edgewise/image.h"
#include "image/netpbm.h"

namespace edgewise {

namespace {

double read_scale(const std::filesystem::path& path, netpbm::Reader& reader) {
  const std::string text = reader.word();
  double scale = 0.0;
  const auto [end, error] =
      std::from_chars(text.data() + text.starts_with('+'), text.data() + text.size(), scale);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(scale) || scale == 0.0)
    throw file_error(path, "malformed header: '" + text + "' is not a scale");
  return scale;
}

}  // namespace

void write_pfm(const std::filesystem::path& path, const DepthMap& map) {
  netpbm::check_pixels(path, map.width, map.height, map.depth01.size());
  AtomicFile file(path);
  file.stream() << "Pf\n" << map.width << ' ' << map.height << "\n-1.0\n";
  const auto row = static_cast<std::size_t>(map.width);
  for (int y = map.height - 1; y >= 0; --y)
    write_words(file.stream(),
                std::as_bytes(std::span(map.depth01).subspan(static_cast<std::size_t>(y) * row, row)));
  file.commit();
}

DepthMap read_pfm(const std::filesystem::path& path) {
  netpbm::Reader reader(path, "Pf");
  const netpbm::Size size = reader.size();
  const double scale = read_scale(path, reader);

  DepthMap map{size.width, size.height, reader.samples<float>(size.pixels())};
  convert_words(std::as_writable_bytes(std::span(map.depth01)),
                scale > 0.0 ? std::endian::big : std::endian::little);
  for (int top = 0, bottom = map.height - 1; top < bottom; ++top, --bottom) {
    const auto row = [&](int y) { return map.depth01.begin() + std::ptrdiff_t{y} * map.width; };
    std::swap_ranges(row(top), row(top + 1), row(bottom));
  }
  return map;
}

}  // namespace edgewise
