#include "lab/needs/ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "edgewise/contract.h"
#include "frontend/transform.h"
#include "frontend/view.h"
#include "lab/coverage/plot.h"

namespace edgewise::lab {

namespace {

using contract::int128;

constexpr std::uint16_t kSides[kViewPlanes] = {kNear, kFar, kGuard};

// The largest edge value at a sample in the triangle's box and the window, and twice the area.
int128 largest_edge_value(const UnsnappedTriangle& t, int subpixel_bits, Window window) {
  const int bits = std::max(subpixel_bits, 1);  // samples lie at half a pixel
  int128 x[3], y[3];
  for (int i = 0; i < 3; ++i) {
    const auto snap = [&](float px) {
      return int128{round_half_even(double{px} * (1 << subpixel_bits))} << (bits - subpixel_bits);
    };
    x[i] = snap(t.x_px[i]), y[i] = snap(t.y_px[i]);
  }
  const int128 one = int128{1} << bits, half = one / 2;
  // The first sample from `low` on and the last one up to `high`, in the window.
  const auto samples = [&](const int128(&v)[3], int begin_px, int end_px) {
    const auto [low, high] = std::minmax({v[0], v[1], v[2]});
    return std::pair{std::max((low + half - 1) >> bits, int128{begin_px}) * one + half,
                     std::min((high - half) >> bits, int128{end_px - 1}) * one + half};
  };
  const auto [x0, x1] = samples(x, window.x0, window.x1());
  const auto [y0, y1] = samples(y, window.y0, window.y1());
  if (x0 > x1 || y0 > y1) return 0;
  const auto magnitude = [](int128 v) { return v < 0 ? -v : v; };
  int128 largest = magnitude((x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]));
  if (largest == 0) return 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    for (const int128 sx : {x0, x1})
      for (const int128 sy : {y0, y1})  // linear, so largest at a corner
        largest = std::max(largest, magnitude((x[j] - x[i]) * (sy - y[i]) - (y[j] - y[i]) * (sx - x[i])));
  }
  return largest;
}

int width_of(int128 value) {
  int bits = 1;  // the sign
  for (; value != 0; value >>= 1) ++bits;
  return bits;
}

}  // namespace

std::array<Reach, kViewPlanes> Ranges::add(const StudiedFrame& frame) {
  add_edge_values(frame);
  std::array<Reach, kViewPlanes> reach{};
  if (!std::holds_alternative<Scene>(frame.drawable)) return reach;
  const auto& scene = std::get<Scene>(frame.drawable);
  const int width = frame.options.width, height = frame.options.height;
  const ViewVolume view = view_volume(camera_of(scene), width, height);
  near_z_ = view.near_z, far_z_ = view.far_z;
  std::vector<ClipVertex> vertices;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes.at(instance.mesh);
    const ScreenTransform to_screen({scene.camera, width, height}, model_matrix(mesh, instance));
    vertices.clear();
    for (const glm::vec3 p : mesh.positions) vertices.push_back(as_clip_vertex(transform(to_screen, p)));
    for (const glm::uvec3 t : mesh.triangles) {
      std::uint16_t any = 0, all = kInvisible;
      for (int k = 0; k < 3; ++k) {
        const std::uint16_t sides = outside_of(vertices.at(t[k]), view);
        any |= sides, all &= sides;
      }
      if ((any & kNotFinite) != 0) continue;
      for (int k = 0; k < 3; ++k) add_vertex(vertices[t[k]]);
      for (std::size_t i = 0; i < reach.size(); ++i) {
        if ((any & kSides[i]) == 0) continue;
        ++reach[i].beyond;
        if (all == 0) ++reach[i].crossing;
      }
    }
  }
  for (std::size_t i = 0; i < reach.size(); ++i)
    reach_[i].beyond += reach[i].beyond, reach_[i].crossing += reach[i].crossing;
  return reach;
}

void Ranges::add_vertex(const ClipVertex& v) {
  const double w = v.w;
  nearest_ = std::min(nearest_, w), farthest_ = std::max(farthest_, w);
  if (w >= near_z_) largest_px_ = std::max({largest_px_, std::abs(v.x / w), std::abs(v.y / w)});
}

void Ranges::add_edge_values(const StudiedFrame& frame) {
  FrontendOptions options = frame.options;
  options.keep_unsnapped = true;
  Frontend frontend;
  frontend.run(frame.drawable, options);
  const Window window{options.width, options.height};
  for (int bits = 0; bits <= kMostSubpixelBits; ++bits) {
    int128 largest = 0;
    for (const UnsnappedTriangle& t : frontend.unsnapped())
      largest = std::max(largest, largest_edge_value(t, bits, window));
    const auto n = static_cast<std::size_t>(bits);
    largest_[n] = std::max(largest_[n], static_cast<double>(largest));
    width_[n] = std::max(width_[n], width_of(largest));
  }
}

std::string Ranges::describe(ViewPlane plane) const {
  switch (plane) {
    case ViewPlane::near:
      return fmt::format("the nearest vertex is at {:.4g}, the plane at {:.4g}", nearest_, near_z_);
    case ViewPlane::far:
      return fmt::format("the farthest vertex is at {:.4g}, the plane at {:.4g}", farthest_, far_z_);
    case ViewPlane::guard:
      break;
  }
  return fmt::format("the largest coordinate is {:.4g} px of {}", largest_px_, contract::kMaxImageSide);
}

// A sample in the box spans with an edge at most its area, as does twice a triangle's area.
double largest_box_px2(int integer_bits, int subpixel_bits) {
  return std::floor((std::ldexp(1.0, integer_bits - 1) - 1.0) /
                    std::ldexp(1.0, 2 * std::max(subpixel_bits, 1)));
}

Question Ranges::edge_values(int subpixel_bits) const {
  const auto n = static_cast<std::size_t>(subpixel_bits);
  Question question{"edge values at " + bits_name(subpixel_bits, "subpixel"), {}};
  question.answers.push_back({fmt::format("{}-bit integers", width_[n] <= 16   ? 16
                                                             : width_[n] <= 32 ? 32
                                                                               : 64)});
  question.proof =
      fmt::format("the largest in all frames is {:.3g}: {} with its sign", largest_[n], bits_name(width_[n]));
  return question;
}

}  // namespace edgewise::lab
