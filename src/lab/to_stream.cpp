#include "lab/to_stream.h"

#include "edgewise/contract.h"

namespace edgewise::lab {

TriangleStream to_stream(std::span<const ScreenTriangle> triangles, int width, int height) {
  const auto pixels = [](std::int32_t q15) { return static_cast<float>(q15) / contract::kPixel_q15; };
  const auto depth01 = [](std::uint32_t z) { return static_cast<float>(contract::depth01(z)); };
  TriangleStream stream{width, height, {}};
  stream.triangles.reserve(triangles.size());
  for (const ScreenTriangle& t : triangles) {
    StreamTriangle& out = stream.triangles.emplace_back();
    for (int i = 0; i < 3; ++i) out.vertex[i] = {pixels(t.x_q15[i]), pixels(t.y_q15[i]), depth01(t.z[i])};
    out.colour = t.payload;
  }
  return stream;
}

}  // namespace edgewise::lab
