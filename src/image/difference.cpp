#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/float_state.h"
#include "edgewise/contract.h"
#include "edgewise/image.h"
#include "edgewise/scene.h"
#include "image/format.h"

namespace edgewise {

namespace {

// Equal pixels have a third of their brightness, so even the faintest red, at half brightness, stands out.
constexpr std::uint32_t kBrightestGrey = 85;
constexpr double kFaintestRed = 128.0;

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// `delta(i)` is the difference at pixel i; `grey(i)` is the brightness of an equal pixel, at most
// kBrightestGrey.
template <typename Delta, typename Grey>
Difference compare(int width, int height, const Delta& delta, const Grey& grey) {
  Difference result;
  const auto columns = static_cast<std::size_t>(width), pixels = columns * static_cast<std::size_t>(height);
  double largest_finite = 0.0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const double d = delta(i);
    if (d == 0.0) continue;
    if (result.count++ == 0) {
      result.first_x = static_cast<int>(i % columns);
      result.first_y = static_cast<int>(i / columns);
    }
    result.largest = std::max(result.largest, d);
    if (std::isfinite(d)) largest_finite = std::max(largest_finite, d);
  }

  result.picture = {width, height, std::vector<std::uint32_t>(pixels)};
  for (std::size_t i = 0; i < pixels; ++i) {
    const double d = delta(i), share = std::isfinite(d) ? d / largest_finite : 1.0;
    const std::uint32_t g = d == 0.0 ? grey(i) : 0;
    result.picture.pixels[i] =
        d == 0.0 ? rgb(g, g, g)
                 : rgb(static_cast<std::uint32_t>(kFaintestRed + (255.0 - kFaintestRed) * share), 0, 0);
  }
  return result;
}

template <typename A, typename B>
void require_same_size(const A& a, const B& b) {
  if (a.width != b.width || a.height != b.height)
    throw std::invalid_argument("sizes differ: " + size_text(a.width, a.height) + " and " +
                                size_text(b.width, b.height));
}

double channel_delta(std::uint32_t a, std::uint32_t b) {
  int largest = 0;
  for (int shift = 0; shift < 24; shift += 8)
    largest =
        std::max(largest, std::abs(static_cast<int>(a >> shift & 255) - static_cast<int>(b >> shift & 255)));
  return largest;
}

double depth_delta(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
  const double delta = std::fabs(static_cast<double>(a) - b);
  return std::isnan(delta) ? std::numeric_limits<double>::infinity() : delta;
}

template <typename Picture, typename Pixels>
MaskedDifference compare_outside(const Picture& a, Picture b, Pixels pixels, int scale, const Samples* mask) {
  MaskedDifference result{difference(a, b), scale};
  if (mask == nullptr) return result;
  require_same_size(a, *mask);
  const std::uint64_t all = result.outside.count;
  for (std::size_t i = 0; i < mask->pixels.size(); ++i) {
    if (mask->pixels[i] == Samples::Pixel{}) continue;
    ++result.masked;
    (b.*pixels)[i] = (a.*pixels)[i];
  }
  result.outside = difference(a, b);
  result.ignored = all - result.outside.count;
  return result;
}

}  // namespace

Difference difference(const Image& a, const Image& b) {
  const DefaultFloatState state;
  require_same_size(a, b);
  return compare(
      a.width, a.height, [&](std::size_t i) { return channel_delta(a.pixels[i], b.pixels[i]); },
      [&](std::size_t i) {
        const std::uint32_t p = a.pixels[i], sum = (p & 255) + (p >> 8 & 255) + (p >> 16 & 255);
        return sum * kBrightestGrey / (3 * 255);
      });
}

Difference difference(const Samples& a, const Samples& b) {
  require_same_size(a, b);
  const double unit = a.deep || b.deep ? 1.0 : 257.0;
  return compare(
      a.width, a.height,
      [&](std::size_t i) {
        int largest = 0;
        for (std::size_t c = 0; c < 3; ++c)
          largest = std::max(largest, std::abs(a.pixels[i][c] - b.pixels[i][c]));
        return largest / unit;
      },
      [&](std::size_t i) {
        const auto& [r, g, blue] = a.pixels[i];
        return (std::uint32_t{r} + g + blue) * kBrightestGrey / (3 * 65535);
      });
}

Difference difference(const DepthMap& a, const DepthMap& b) {
  const DefaultFloatState state;
  require_same_size(a, b);
  return compare(
      a.width, a.height, [&](std::size_t i) { return depth_delta(a.depth01[i], b.depth01[i]); },
      [&](std::size_t i) {
        const float depth = a.depth01[i];
        const float nearness = depth >= 0.0f && depth <= 1.0f ? 1.0f - depth : 0.0f;
        return static_cast<std::uint32_t>(nearness * static_cast<float>(kBrightestGrey));
      });
}

Image enlarge(const Image& image, int factor) {
  if (factor < 1 || image.width > contract::kMaxImageSide / factor ||
      image.height > contract::kMaxImageSide / factor)
    throw std::invalid_argument("an image of " + size_text(image.width, image.height) +
                                " cannot be enlarged by " + std::to_string(factor));
  Image large{image.width * factor, image.height * factor, {}};
  large.pixels.reserve(static_cast<std::size_t>(large.width) * static_cast<std::size_t>(large.height));
  for (int y = 0; y < large.height; ++y)
    for (int x = 0; x < large.width; ++x)
      large.pixels.push_back(
          image.pixels[static_cast<std::size_t>(y / factor) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x / factor)]);
  return large;
}

MaskedDifference difference(const Samples& a, Samples b, const Samples* mask) {
  const int scale = a.deep || b.deep ? 65535 : 255;
  return compare_outside(a, std::move(b), &Samples::pixels, scale, mask);
}

MaskedDifference difference(const DepthMap& a, DepthMap b, const Samples* mask) {
  return compare_outside(a, std::move(b), &DepthMap::depth01, 1, mask);
}

}  // namespace edgewise
