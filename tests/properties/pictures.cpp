#include "properties/pictures.h"

#include <cmath>

#include "frontend/fixed.h"
#include "lab/truth/oracle.h"
#include "support.h"

namespace edgewise::testing {

std::int32_t snapped_to_grid(float px) {
  return static_cast<std::int32_t>(std::lrint(double{px} * Coarse::kSub)) * (1 << Coarse::kSpareBits);
}

std::vector<ScreenTriangle> snapped(const TriangleStream& stream, Payload payload) {
  std::vector<ScreenTriangle> triangles;
  for (const StreamTriangle& t : stream.triangles) {
    const auto id = static_cast<std::uint32_t>(triangles.size());
    ScreenTriangle& out = triangles.emplace_back();
    out.payload = payload == Payload::id ? id : t.colour;
    for (int i = 0; i < 3; ++i) {
      out.x_q15[i] = snapped_to_grid(t.vertex[i].x);
      out.y_q15[i] = snapped_to_grid(t.vertex[i].y);
      out.z[i] = quantize_depth(t.vertex[i].z);
    }
  }
  return triangles;
}

std::vector<Painter> painters(std::span<const BackendInfo> infos) {
  std::vector<Painter> all;
  for (const BackendInfo& info : infos) all.push_back({info.name, info});
  return all;
}

std::span<const lab::DrawOptions> two_executions() {
  static const lab::DrawOptions list[] = {{{1, 64, SimdTarget::scalar}}, {{1, 64, SimdTarget::best}}};
  return list;
}

Framebuffer drawn(const Painter& painter, std::span<const ScreenTriangle> triangles, int width, int height,
                  const lab::DrawOptions& how) {
  Framebuffer frame(width, height);
  lab::poison(frame);
  painter.with(how.tiles).draw(triangles, frame.view(), {kBackground}, how.execution);
  return frame;
}

void compare_pictures(Verdict& verdict, const Framebuffer& expected, std::span<const Painter> painters,
                      std::span<const ScreenTriangle> triangles, std::span<const lab::DrawOptions> ways,
                      const std::string& what) {
  for (const Painter& painter : painters)
    for (const lab::DrawOptions& way : ways) {
      const Framebuffer frame = drawn(painter, triangles, expected.width(), expected.height(), way);
      verdict.compare(difference_text(expected, frame),
                      what + ", " + std::string(painter.name) + ", " + describe(way));
    }
}

Property like_the_oracles(const std::vector<Painter>& painters, std::vector<lab::DrawOptions> ways) {
  return [&painters, ways = std::move(ways)](const TriangleStream& stream) {
    Verdict verdict{.replay = {stream}};
    Framebuffer expected(stream.width, stream.height);
    for (const Payload payload : {Payload::id, Payload::colour}) {
      const auto triangles = snapped(stream, payload);
      lab::draw_oracle(triangles, expected, kBackground);
      compare_pictures(verdict, expected, painters, triangles, ways,
                       payload == Payload::id ? "depth and ids" : "depth and colours");
    }
    return verdict;
  };
}

}  // namespace edgewise::testing
