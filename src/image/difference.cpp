#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>

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

template <typename A, typename B>
void require_same_size(const A& a, const B& b, const char* of = "") {
  if (a.width != b.width || a.height != b.height)
    throw std::invalid_argument("sizes differ: " + size_text(a.width, a.height) + " and " +
                                size_text(b.width, b.height) + " pixels" + of);
}

// `delta(i)` is the difference at pixel i, and `alpha(i)` whether alpha differs there; `grey(i)` is the
// brightness of an equal pixel, at most kBrightestGrey.
template <typename Delta, typename Alpha, typename Grey>
Difference compare(int width, int height, int scale, const Samples* mask, const Delta& delta,
                   const Alpha& alpha, const Grey& grey) {
  Difference result;
  result.scale = scale;
  const auto columns = static_cast<std::size_t>(width), pixels = columns * static_cast<std::size_t>(height);
  const auto masked = [mask](std::size_t i) {
    return mask != nullptr && (mask->pixels[i][0] | mask->pixels[i][1] | mask->pixels[i][2]) != 0;
  };
  double largest_finite = 0.0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const double d = delta(i);
    if (masked(i)) {
      ++result.masked;
      result.masked_count += d != 0.0;
      continue;
    }
    result.alpha_count += alpha(i);
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
    const double d = masked(i) ? 0.0 : delta(i), share = std::isfinite(d) ? d / largest_finite : 1.0;
    const std::uint32_t g = d == 0.0 ? grey(i) : 0;
    result.picture.pixels[i] =
        d == 0.0 ? rgb(g, g, g)
                 : rgb(static_cast<std::uint32_t>(kFaintestRed + (255.0 - kFaintestRed) * share), 0, 0);
  }
  return result;
}

double float_delta(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
  const double delta = std::fabs(static_cast<double>(a) - b);
  return std::isnan(delta) ? std::numeric_limits<double>::infinity() : delta;
}

Difference compare(const Samples& a, const Samples& b, const Samples* mask) {
  const int unit = a.deep || b.deep ? 1 : 257;
  return compare(
      a.width, a.height, 65535 / unit, mask,
      [&](std::size_t i) {
        int delta = 0;
        for (std::size_t c = 0; c < 3; ++c)
          delta = std::max(delta, std::abs(a.pixels[i][c] - b.pixels[i][c]));
        return delta / unit;
      },
      [&](std::size_t i) { return a.pixels[i][3] != b.pixels[i][3]; },
      [&](std::size_t i) {
        const Samples::Pixel& p = a.pixels[i];
        return (std::uint32_t{p[0]} + p[1] + p[2]) * kBrightestGrey / (3 * 65535);
      });
}

// Of a pixel the channel that differs most counts. A single channel is a depth, of which the nearer is
// brighter.
Difference compare(int width, int height, int channels, const std::vector<float>& a,
                   const std::vector<float>& b, const Samples* mask) {
  const auto count = static_cast<std::size_t>(channels);
  return compare(
      width, height, 1, mask,
      [&](std::size_t i) {
        double largest = 0.0;
        for (std::size_t c = i * count; c < (i + 1) * count; ++c)
          largest = std::max(largest, float_delta(a[c], b[c]));
        return largest;
      },
      [](std::size_t) { return false; },
      [&](std::size_t i) {
        float sum = 0.0f;
        for (std::size_t c = i * count; c < (i + 1) * count; ++c)
          if (a[c] >= 0.0f && a[c] <= 1.0f) sum += channels == 1 ? 1.0f - a[c] : a[c];
        return static_cast<std::uint32_t>(sum * static_cast<float>(kBrightestGrey) /
                                          static_cast<float>(channels));
      });
}

}  // namespace

Difference difference(const Image& a, const Image& b) {
  const DefaultFloatState state;
  require_same_size(a, b);
  return compare(to_samples(a), to_samples(b), nullptr);
}

Difference difference(const DepthMap& a, const DepthMap& b) {
  const DefaultFloatState state;
  require_same_size(a, b);
  return compare(a.width, a.height, 1, a.depth01, b.depth01, nullptr);
}

Difference difference(const Picture& a, const Picture& b, const Picture* mask) {
  const DefaultFloatState state;
  const auto* const masks = mask == nullptr ? nullptr : std::get_if<Samples>(mask);
  if (mask != nullptr && masks == nullptr)
    throw std::invalid_argument("a mask must be a picture, not floats");
  return std::visit(
      [&](const auto& first) {
        using Kind = std::decay_t<decltype(first)>;
        const auto* const second = std::get_if<Kind>(&b);
        if (second == nullptr)
          throw std::invalid_argument("a picture cannot be compared with a depth map or other floats");
        require_same_size(first, *second);
        if (masks != nullptr) require_same_size(first, *masks, " of the mask");
        if constexpr (std::is_same_v<Kind, Samples>) {
          return compare(first, *second, masks);
        } else {
          if (first.channels != second->channels)
            throw std::invalid_argument("a depth map cannot be compared with three channels of floats");
          return compare(first.width, first.height, first.channels, first.values, second->values, masks);
        }
      },
      a);
}

Difference difference(const std::filesystem::path& a, const std::filesystem::path& b,
                      const std::filesystem::path& mask, std::vector<std::string>* warnings) {
  const Picture first = read_picture(a, warnings), second = read_picture(b, warnings);
  const Picture masks = mask.empty() ? Picture() : read_picture(mask, warnings);
  try {
    return difference(first, second, mask.empty() ? nullptr : &masks);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(a.string() + " and " + b.string() + ": " + error.what());
  }
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

}  // namespace edgewise
