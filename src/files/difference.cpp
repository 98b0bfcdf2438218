#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
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

double float_delta(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
  const double delta = std::fabs(static_cast<double>(a) - b);
  return std::isnan(delta) ? std::numeric_limits<double>::infinity() : delta;
}

// Two pixels: the difference of the channel that differs most, and the brightness of the first one, at most
// kBrightestGrey.
struct Compared {
  double delta;
  bool alpha_differs;
  std::uint32_t grey;
};

int scale_of(const Samples& a, const Samples& b) {
  return a.deep || b.deep ? 65535 : 255;
}
Compared compared(const Samples& a, const Samples& b, std::size_t i) {
  const Samples::Pixel &p = a.pixels[i], &q = b.pixels[i];
  int delta = 0;
  for (std::size_t c = 0; c < 3; ++c) delta = std::max(delta, std::abs(p[c] - q[c]));
  return {static_cast<double>(delta / (65535 / scale_of(a, b))), p[3] != q[3],
          (std::uint32_t{p[0]} + p[1] + p[2]) * kBrightestGrey / (3 * 65535)};
}

int scale_of(const FloatMap&, const FloatMap&) {
  return 1;
}
// A single channel is a depth, of which the nearer is brighter.
Compared compared(const FloatMap& a, const FloatMap& b, std::size_t i) {
  const auto channels = static_cast<std::size_t>(a.channels);
  double largest = 0.0;
  float sum = 0.0f;
  for (std::size_t c = i * channels; c < (i + 1) * channels; ++c) {
    const float value = a.values[c];
    largest = std::max(largest, float_delta(value, b.values[c]));
    if (value >= 0.0f && value <= 1.0f) sum += channels == 1 ? 1.0f - value : value;
  }
  return {
      largest, false,
      static_cast<std::uint32_t>(sum * static_cast<float>(kBrightestGrey) / static_cast<float>(channels))};
}

template <typename Kind>
Difference compare(const Kind& a, const Kind& b, const Samples* mask) {
  const auto columns = static_cast<std::size_t>(a.width),
             pixels = columns * static_cast<std::size_t>(a.height);
  Difference result;
  result.scale = scale_of(a, b);
  result.picture = {a.width, a.height, std::vector<std::uint32_t>(pixels)};
  const auto is_masked = [&](std::size_t i) {
    return mask != nullptr && (mask->pixels[i][0] | mask->pixels[i][1] | mask->pixels[i][2]) != 0;
  };
  double largest_finite = 0.0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto [delta, alpha_differs, grey] = compared(a, b, i);
    result.picture.pixels[i] = rgb(grey, grey, grey);
    if (is_masked(i)) {
      ++result.masked;
      result.masked_count += delta != 0.0;
      continue;
    }
    result.alpha_count += alpha_differs;
    if (delta == 0.0) continue;
    if (result.count++ == 0) {
      result.first_x = static_cast<int>(i % columns);
      result.first_y = static_cast<int>(i / columns);
    }
    result.largest = std::max(result.largest, delta);
    if (std::isfinite(delta)) largest_finite = std::max(largest_finite, delta);
  }
  for (std::size_t i = 0; result.count > 0 && i < pixels; ++i) {
    const double delta = is_masked(i) ? 0.0 : compared(a, b, i).delta;
    if (delta == 0.0) continue;
    const double share = std::isfinite(delta) ? delta / largest_finite : 1.0;
    result.picture.pixels[i] =
        rgb(static_cast<std::uint32_t>(kFaintestRed + (255.0 - kFaintestRed) * share), 0, 0);
  }
  return result;
}

}  // namespace

Difference difference(const Image& a, const Image& b) {
  return difference(to_samples(a), to_samples(b), nullptr);
}

Difference difference(const DepthMap& a, const DepthMap& b) {
  return difference(FloatMap{a.width, a.height, 1, a.depth01}, FloatMap{b.width, b.height, 1, b.depth01},
                    nullptr);
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
        if constexpr (std::is_same_v<Kind, FloatMap>)
          if (first.channels != second->channels)
            throw std::invalid_argument("a depth map cannot be compared with three channels of floats");
        return compare(first, *second, masks);
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
