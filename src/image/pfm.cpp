// PFM, as defined by Debevec's HDRShop: "Pf" or, with three channels, "PF", width, height, a scale, then rows
// of floats, the bottom row first. A negative scale means little endian. The scale's size is a unit of light
// and is ignored.
#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "core/float_state.h"
#include "core/little_endian.h"
#include "core/numbers.h"
#include "edgewise/contract.h"
#include "image/format.h"
#include "image/netpbm.h"

namespace edgewise {

DepthMap to_depth_map(const ConstFrameView& frame) {
  const DefaultFloatState state;
  DepthMap map{frame.width, frame.height, {}};
  map.depth01.reserve(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x)
      map.depth01.push_back(static_cast<float>(contract::depth01(frame.depth[y * frame.stride + x])));
  return map;
}

void write_pfm(std::ostream& out, const DepthMap& map) {
  out << "Pf\n" << map.width << ' ' << map.height << "\n-1.0\n";
  const auto row = static_cast<std::size_t>(map.width);
  for (int y = map.height - 1; y >= 0; --y)
    write_words(out, std::as_bytes(std::span(map.depth01).subspan(static_cast<std::size_t>(y) * row, row)));
}

FloatMap read_pfm(const std::filesystem::path& path, InputFile file) {
  netpbm::Reader reader(path, std::move(file), "Pf or PF");
  const netpbm::Size size = reader.size();
  const std::string text = reader.word();
  const double scale = parse_number(text);
  if (!std::isfinite(scale) || scale == 0.0)
    throw FileError(path, "malformed header: '" + text + "' is not a scale");
  const std::size_t channels = reader.kind() == 'f' ? 1 : 3;
  FloatMap map{size.width, size.height, static_cast<int>(channels),
               reader.samples<float>(size.pixels() * channels)};
  convert_words(std::as_writable_bytes(std::span(map.values)),
                scale > 0.0 ? std::endian::big : std::endian::little);
  const auto row = static_cast<std::ptrdiff_t>(channels) * map.width;
  for (int top = 0, bottom = map.height - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(map.values.begin() + top * row, map.values.begin() + (top + 1) * row,
                     map.values.begin() + bottom * row);
  return map;
}

}  // namespace edgewise
