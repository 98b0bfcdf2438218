#include "lab/cases/to_stream.h"

#include <algorithm>

#include "edgewise/contract.h"

namespace edgewise::lab {

namespace {

bool floats_hold(const ScreenTriangle& t) {
  const auto holds = [](std::int32_t q15) { return double{static_cast<float>(q15)} == q15; };
  return std::ranges::all_of(t.x_q15, holds) && std::ranges::all_of(t.y_q15, holds);
}

template <typename Number, typename Triangle>
void append(std::span<const ScreenTriangle> triangles, std::vector<Triangle>& list) {
  const auto pixels = [](std::int32_t q15) { return static_cast<Number>(q15) / contract::kPixel_q15; };
  const auto depth01 = [](std::uint32_t z) { return static_cast<Number>(contract::depth01(z)); };
  list.reserve(triangles.size());
  for (const ScreenTriangle& t : triangles) {
    Triangle& out = list.emplace_back();
    for (int i = 0; i < 3; ++i) out.vertex[i] = {pixels(t.x_q15[i]), pixels(t.y_q15[i]), depth01(t.z[i])};
    out.colour = t.payload;
  }
}

}  // namespace

TriangleStream to_stream(std::span<const ScreenTriangle> triangles, int width, int height) {
  TriangleStream stream{width, height, {}};
  if (std::ranges::all_of(triangles, floats_hold))
    append<float>(triangles, stream.triangles);
  else
    append<double>(triangles, stream.exact);
  return stream;
}

std::vector<FloatTriangle> as_floats(std::span<const ScreenTriangle> triangles) {
  std::vector<FloatTriangle> list;
  for (const ScreenTriangle& t : triangles) {
    FloatTriangle& out = list.emplace_back(FloatTriangle{{}, t.payload});
    for (int i = 0; i < 3; ++i) {
      out.at.x_px[i] = static_cast<float>(t.x_q15[i]) / contract::kPixel_q15;
      out.at.y_px[i] = static_cast<float>(t.y_q15[i]) / contract::kPixel_q15;
      out.at.z01[i] = static_cast<float>(contract::depth01(t.z[i]));
    }
  }
  return list;
}

std::optional<Drawable> in_floats(const Drawable& drawable) {
  const auto* stream = std::get_if<TriangleStream>(&drawable);
  if (stream == nullptr || stream->exact.empty()) return {};
  TriangleStream rounded{stream->width, stream->height, {}};
  for (const auto& [v, colour] : stream->exact)
    rounded.triangles.push_back({{glm::vec3(v[0]), glm::vec3(v[1]), glm::vec3(v[2])}, colour});
  return rounded;
}

}  // namespace edgewise::lab
