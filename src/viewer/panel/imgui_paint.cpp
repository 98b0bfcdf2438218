#include "viewer/panel/imgui_paint.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "edgewise/contract.h"

namespace edgewise::viewer {

namespace {

// A texel, times a colour, over a pixel.
std::uint32_t blended(std::uint32_t pixel, std::uint32_t texel, std::uint32_t colour) {
  constexpr std::uint32_t kOpaque = 255;
  const auto product = [&](int shift) {
    return ((texel >> shift & kOpaque) * (colour >> shift & kOpaque) + kOpaque / 2) / kOpaque;
  };
  const std::uint32_t alpha = product(24);
  std::uint32_t both = kOpaque << 24;
  for (int shift = 0; shift < 24; shift += 8)
    both |= (product(shift) * alpha + (pixel >> shift & kOpaque) * (kOpaque - alpha) + kOpaque / 2) / kOpaque
            << shift;
  return both;
}

std::uint32_t texel(const Image& texture, double u, double v) {
  const auto x = std::clamp(static_cast<int>(u * texture.width), 0, texture.width - 1),
             y = std::clamp(static_cast<int>(v * texture.height), 0, texture.height - 1);
  return texture.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) +
                        static_cast<std::size_t>(x)];
}

std::int32_t snapped(float px) {
  // Dear ImGui offsets lines by an approximate inverse square root, whose last bits depend on the processor:
  // 1/16 px is coarse enough to hide them.
  constexpr float kSteps = 16.0f;
  constexpr float kGuard = static_cast<float>(contract::kMaxImageSide) - 1.0f;
  return static_cast<std::int32_t>(std::floor(std::clamp(px, -kGuard, kGuard) * kSteps + 0.5f)) *
         (contract::kPixel_q15 / 16);
}

// All corners of a triangle have the same colour.
void paint_triangle(const ImDrawVert& a, const ImDrawVert& b, const ImDrawVert& c, const Image& texture,
                    const contract::PixelBox& clip, Image& image) {
  const ScreenTriangle t{{snapped(a.pos.x), snapped(b.pos.x), snapped(c.pos.x)},
                         {snapped(a.pos.y), snapped(b.pos.y), snapped(c.pos.y)},
                         {},
                         a.col};
  const contract::Oriented o = contract::orient(t);
  if (o.area == 0) return;
  const bool turned = contract::signed_area(t) < 0;
  const ImVec2 uv[] = {a.uv, turned ? c.uv : b.uv, turned ? b.uv : c.uv};
  // Of areas of one colour.
  const bool plain = uv[0].x == uv[1].x && uv[0].x == uv[2].x && uv[0].y == uv[1].y && uv[0].y == uv[2].y;
  std::uint32_t sample = texel(texture, uv[0].x, uv[0].y);
  contract::PixelBox box = contract::pixel_box(t, image.width, image.height);
  box = {std::max(box.x0, clip.x0), std::max(box.y0, clip.y0), std::min(box.x1, clip.x1),
         std::min(box.y1, clip.y1)};
  const double per_area = 1.0 / static_cast<double>(o.area);
  // Each edge's value at a pixel is the weight of the corner across from it.
  const contract::Edge edges[] = {contract::make_edge(o, 1), contract::make_edge(o, 2),
                                  contract::make_edge(o, 0)};
  for (int y = box.y0; y < box.y1; ++y) {
    std::uint32_t* const row = image.pixels.data() + std::ptrdiff_t{y} * image.width;
    for (int x = box.x0; x < box.x1; ++x) {
      const std::int64_t w[] = {edges[0].at(x, y), edges[1].at(x, y), edges[2].at(x, y)};
      if ((w[0] | w[1] | w[2]) < 0) continue;
      if (!plain) {
        double u = 0, v = 0;
        for (int i = 0; i < 3; ++i) {
          const double weight = static_cast<double>(w[i]) * per_area;
          u += weight * static_cast<double>(uv[i].x);
          v += weight * static_cast<double>(uv[i].y);
        }
        sample = texel(texture, u, v);
      }
      row[x] = blended(row[x], sample, a.col);
    }
  }
}

}  // namespace

void paint(const ImDrawData& drawn, Image& image) {
  for (int n = 0; n < drawn.CmdListsCount; ++n) {
    const ImDrawList& list = *drawn.CmdLists[n];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const Image& texture = *static_cast<const Image*>(command.GetTexID());
      const contract::PixelBox clip{
          static_cast<int>(command.ClipRect.x), static_cast<int>(command.ClipRect.y),
          static_cast<int>(command.ClipRect.z), static_cast<int>(command.ClipRect.w)};
      const ImDrawVert* const vertices = list.VtxBuffer.Data + command.VtxOffset;
      const ImDrawIdx* const indices = list.IdxBuffer.Data + command.IdxOffset;
      for (unsigned int i = 0; i < command.ElemCount; i += 3)
        paint_triangle(vertices[indices[i]], vertices[indices[i + 1]], vertices[indices[i + 2]], texture,
                       clip, image);
    }
  }
}

}  // namespace edgewise::viewer
