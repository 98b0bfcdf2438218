// Which pixels show the same triangle in every picture that a conformant rasterizer may draw.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "edgewise/frontend.h"
#include "edgewise/scene.h"
#include "lab/portable/conformance.h"

namespace edgewise::lab {

// Why a pixel may show different triangles. The strongest reason counts, and the last is the strongest.
enum class Unstable : std::uint8_t {
  no,
  depth,  // two triangles cover the pixel in every case, but rounding decides which one is nearer
  edge,   // an edge passes so closely that rounding decides whether its triangle covers the sample
  tie,    // as `edge`, with the sample exactly on it
  clip    // as `edge`, of a triangle that the near or far plane cuts or touches; or any sample of one that
          // reaches beyond the guard band
};
inline constexpr int kUnstableKinds = 5;
std::string_view name_of(Unstable reason);  // "portable", "depth", "edge", "tie", "clip"

struct PortablePixels {
  int width, height;              // px
  std::vector<Unstable> reasons;  // row by row from the top

  std::array<std::uint64_t, kUnstableKinds> counts() const;
};

// The input: triangles before snapping, in submission order. Those with the same id count as one triangle.
struct PortableTriangle {
  UnsnappedTriangle at;
  std::uint32_t id;
  bool drawn;    // false: culled for its facing, which rounding may reverse
  bool clipped;  // a piece of a triangle that the near or far plane cuts or touches
  // How much further than the model's roundings the vertices may be off.
  double position_error_px = 0.0, depth_error = 0.0;
};

// Conservative: a pixel is `no` only if every choice that the model allows shows the same triangle, or the
// background. Depths must be finite, and coordinates within 2^20 px. Throws std::invalid_argument for a
// coordinate, a size or a model out of range.
PortablePixels portable_pixels(std::span<const PortableTriangle> triangles, int width, int height,
                               const Conformance& model, int threads);

// The triangles of a drawable. `options` are those of the picture that is drawn.
std::vector<PortableTriangle> portable_triangles(const Drawable& drawable, FrontendOptions options);

}  // namespace edgewise::lab
