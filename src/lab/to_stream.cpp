#include "lab/to_stream.h"

#include <algorithm>

#include "edgewise/contract.h"

namespace edgewise::lab {

namespace {

bool floats_hold(const ScreenTriangle& t) {
  const auto holds = [](std::int32_t sub) { return double{static_cast<float>(sub)} == sub; };
  return std::ranges::all_of(t.x_sub, holds) && std::ranges::all_of(t.y_sub, holds);
}

template <typename Number, typename Triangle>
void append(std::span<const ScreenTriangle> triangles, std::vector<Triangle>& list) {
  const auto pixels = [](std::int32_t sub) { return static_cast<Number>(sub) / contract::kSub; };
  const auto depth01 = [](std::uint32_t z) { return static_cast<Number>(contract::depth01(z)); };
  list.reserve(triangles.size());
  for (const ScreenTriangle& t : triangles) {
    Triangle& out = list.emplace_back();
    for (int i = 0; i < 3; ++i) out.vertex[i] = {pixels(t.x_sub[i]), pixels(t.y_sub[i]), depth01(t.z[i])};
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

}  // namespace edgewise::lab
