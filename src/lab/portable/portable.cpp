#include "lab/portable/portable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "core/grid.h"
#include "core/nearest_name.h"
#include "core/parallel.h"
#include "edgewise/contract.h"
#include "frontend/transform.h"
#include "frontend/view.h"
#include "lab/source_triangles.h"
#include "lab/truth/truth.h"

namespace edgewise::lab {

namespace {

constexpr DepthFormat kDepthFormats[] = {
    {"d16_unorm", 1.0 / 0xFFFF}, {"d24_unorm", 1.0 / 0xFFFFFF}, {"d32_sfloat", 0x1p-24}};
constexpr std::string_view kNames[kUnstableKinds] = {"portable", "depth", "edge", "tie", "clip"};

// The bounds are computed in doubles. This covers their rounding, in px, for coordinates within kMostPx.
constexpr double kDoubleError_px = 0x1p-30;
constexpr double kMostPx = 0x1p20;

double ulp_of(double magnitude) {
  return std::ldexp(1.0, std::ilogb(magnitude) - 23);
}

// A triangle, oriented so that its area is not negative. With V a vertex position of the model, |V - v| <= r
// in x and in y. Let the sample p lie in the triangle of such positions: p = sum l_i V_i with l_i >= 0 that
// add up to 1. Then q = sum l_i v_i lies in the triangle of the v_i, and |q - p| <= r. Hence:
// - If the square of radius r around p misses the triangle, no choice covers p.
// - If it lies inside, every choice covers p. Move the v_i straight to the V_i: p can leave the triangle only
//   across an edge, and then some q in the square lies on an edge of the v_i.
// - The depth at p is sum l_i z_i, the depth of the plane through the v_i at q.
class Bounds {
 public:
  Bounds(const PortableTriangle& t, int width, int height, const Conformance& model)
      : id(t.id), drawn_(t.drawn) {
    double reach_x = width, reach_y = height;
    for (int i = 0; i < 3; ++i) {
      x_[i] = double{t.at.x_px[i]}, y_[i] = double{t.at.y_px[i]}, z_[i] = double{t.at.z01[i]};
      beyond_ |= std::max({-x_[i], x_[i] - width, -y_[i], y_[i] - height}) > model.guard_band_px;
      reach_x = std::max(reach_x, std::abs(x_[i])), reach_y = std::max(reach_y, std::abs(y_[i]));
    }
    r_ = std::ldexp(1.0, -model.subpixel_bits) + model.transform_ulps * ulp_of(std::max(reach_x, reach_y)) +
         t.position_error_px + kDoubleError_px;
    area_ = (x_[1] - x_[0]) * (y_[2] - y_[0]) - (x_[2] - x_[0]) * (y_[1] - y_[0]);
    if (area_ < 0.0)
      std::swap(x_[1], x_[2]), std::swap(y_[1], y_[2]), std::swap(z_[1], z_[2]), area_ = -area_;
    for (int i = 0; i < 3; ++i) {
      dx_[i] = x_[(i + 1) % 3] - x_[i], dy_[i] = y_[(i + 1) % 3] - y_[i];
      reach_[i] = r_ * (std::abs(dx_[i]) + std::abs(dy_[i]));
    }
    set_depth(reach_x + r_, reach_y + r_, model.depth.step + kVertexDepthError + t.depth_error);
    clipped_ = t.clipped || beyond_;
  }

  // Whether every choice drops the triangle: it faces away in all of them.
  bool is_culled() const { return !drawn_ && least_area() > 0.0; }
  // Rows [first, last) in which the triangle may cover a sample.
  std::pair<int, int> rows() const {
    const auto [low, high] = std::minmax({y_[0], y_[1], y_[2]});
    return {first_sample(low - r_), first_sample(high + r_) + 1};
  }
  // Columns [first, last) of a row in which it may cover a sample, one too many at either end.
  std::pair<int, int> columns(int row) const {
    auto [low, high] = std::minmax({x_[0], x_[1], x_[2]});
    low -= r_, high += r_;
    for (int i = 0; i < 3; ++i) {
      if (dy_[i] == 0.0) continue;
      // dx (y - y_i) - dy (x - x_i) >= -reach
      const double x = x_[i] + (dx_[i] * (row + 0.5 - y_[i]) + reach_[i]) / dy_[i];
      if (dy_[i] > 0.0)
        high = std::min(high, x);
      else
        low = std::max(low, x);
    }
    if (!(low <= high + 2.0)) return {0, 0};
    return {first_sample(low) - 1, first_sample(high) + 2};
  }

  struct Cover {
    bool possible, sure, tie;
  };
  Cover at(int px, int row) const {
    Cover cover{true, drawn_ && !beyond_, false};
    for (int i = 0; i < 3; ++i) {
      const double e = dx_[i] * (row + 0.5 - y_[i]) - dy_[i] * (px + 0.5 - x_[i]);
      cover.possible &= e >= -reach_[i] && e <= area_ + reach_[i];
      cover.sure &= e > reach_[i];
      cover.tie |= e == 0.0;
    }
    return cover;
  }
  double nearest(int px, int row) const { return std::max(least_z_, depth(px, row) - depth_error_); }
  double furthest(int px, int row) const { return std::min(most_z_, depth(px, row) + depth_error_); }

  Unstable reason(const Cover& cover) const {
    return cover.sure  ? Unstable::depth
           : clipped_  ? Unstable::clip
           : cover.tie ? Unstable::tie
                       : Unstable::edge;
  }

  std::uint32_t id;

 private:
  static int first_sample(double x) { return static_cast<int>(std::ceil(std::clamp(x, -1e6, 1e6) - 0.5)); }
  double depth(int px, int row) const { return z_[0] + zx_ * (px + 0.5 - x_[0]) + zy_ * (row + 0.5 - y_[0]); }
  // A lower bound of the area of all choices.
  double least_area() const { return area_ - (reach_[0] + reach_[1] + reach_[2] + 8.0 * r_ * r_); }
  // `own` is the error of a vertex's depth.
  void set_depth(double reach_x, double reach_y, double own) {
    const auto [low, high] = std::minmax({z_[0], z_[1], z_[2]});
    const double plane = float_plane_error(
        std::max(std::abs(low), std::abs(high)), high - low, std::abs(dx_[0]) + std::abs(dx_[2]) + 4.0 * r_,
        std::abs(dy_[0]) + std::abs(dy_[2]) + 4.0 * r_, least_area(), reach_x, reach_y);
    least_z_ = low - own - plane, most_z_ = high + own + plane;
    if (!std::isfinite(plane)) {
      depth_error_ = plane;
      return;
    }
    const double dz1 = z_[1] - z_[0], dz2 = z_[2] - z_[0];
    zx_ = (dz2 * dy_[0] + dz1 * dy_[2]) / -area_;
    zy_ = (dz2 * dx_[0] + dz1 * dx_[2]) / area_;
    depth_error_ = own + plane + r_ * (std::abs(zx_) + std::abs(zy_));
  }

  bool drawn_, clipped_, beyond_ = false;
  double r_, area_;
  double x_[3], y_[3], z_[3], dx_[3], dy_[3], reach_[3];
  double zx_ = 0.0, zy_ = 0.0, depth_error_, least_z_, most_z_;
};

// Marks rows [begin, end) of the picture.
void mark_rows(std::span<const PortableTriangle> triangles, const Conformance& model, int begin, int end,
               PortablePixels& out) {
  const auto width = static_cast<std::size_t>(out.width);
  const std::size_t pixels = width * static_cast<std::size_t>(end - begin);
  // Of the triangles that surely cover a pixel, only the one with the nearest bound can be visible in every
  // case.
  std::vector<double> bound(pixels, std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> visible(pixels, kNoTriangle);
  const auto each = [&](auto&& visit) {
    for (const PortableTriangle& triangle : triangles) {
      const Bounds t(triangle, out.width, out.height, model);
      if (t.is_culled()) continue;
      const auto [top, bottom] = t.rows();
      for (int y = std::max(top, begin); y < std::min(bottom, end); ++y) {
        const auto [left, right] = t.columns(y);
        for (int x = std::max(left, 0); x < std::min(right, out.width); ++x)
          if (const auto cover = t.at(x, y); cover.possible)
            visit(t, cover, x, y, static_cast<std::size_t>(y - begin) * width + static_cast<std::size_t>(x));
      }
    }
  };
  each([&](const Bounds& t, const Bounds::Cover& cover, int x, int y, std::size_t at) {
    if (!cover.sure) return;
    const double z = t.furthest(x, y);
    if (z < bound[at]) bound[at] = z, visible[at] = t.id;
  });
  const auto mark = [&](std::size_t at, Unstable why) {
    Unstable& reason = out.reasons[static_cast<std::size_t>(begin) * width + at];
    reason = std::max(reason, why);
  };
  // A depth that rounds to the clear value leaves the background.
  for (std::size_t at = 0; at < pixels; ++at)
    if (visible[at] != kNoTriangle && bound[at] >= 1.0 - model.depth.step) mark(at, Unstable::depth);
  each([&](const Bounds& t, const Bounds::Cover& cover, int x, int y, std::size_t at) {
    if (t.id == visible[at] || t.nearest(x, y) > bound[at]) return;
    mark(at, t.reason(cover));
  });
}

void check(std::span<const PortableTriangle> triangles, int width, int height, const Conformance& model) {
  if (width < 1 || height < 1 || width > contract::kMaxImageSide || height > contract::kMaxImageSide)
    throw std::invalid_argument("the size of a picture must be 1 to " +
                                std::to_string(contract::kMaxImageSide) + " px on each side");
  if (model.subpixel_bits < 1 || model.subpixel_bits > Coarse::kSubBits)
    throw std::invalid_argument("subpixel bits must be 1 to " + std::to_string(Coarse::kSubBits) +
                                ": the library draws no more yet");
  if (model.transform_ulps < 0 || model.transform_ulps > 1000)
    throw std::invalid_argument("units in the last place must be 0 to 1000");
  if (model.guard_band_px < 0 || model.guard_band_px > kMostPx)
    throw std::invalid_argument("the guard band must be 0 to 2^20 px");
  for (const PortableTriangle& t : triangles)
    for (int i = 0; i < 3; ++i)
      if (!(std::abs(double{t.at.x_px[i]}) <= kMostPx && std::abs(double{t.at.y_px[i]}) <= kMostPx))
        throw std::invalid_argument("coordinates must lie within 2^20 px");
}

// The errors of vertices that clipping made. A coordinate c of such a vertex is interpolated from vertices a
// and b, with an error of at most kClipError max(|a|, |b|), and then divided by w, which errs as much.
class ClipErrors {
 public:
  ClipErrors(const Drawable& drawable, const FrontendOptions& options) : drawable_(drawable) {
    const auto* scene = std::get_if<Scene>(&drawable);
    if (scene == nullptr) return;
    sources_ = std::make_unique<SourceTriangles>(*scene);
    camera_ = camera_of(*scene);
    width_ = options.width, height_ = options.height;
    least_w_ = double{camera_.near_z};
  }
  void add_to(PortableTriangle& t) {
    Largest of{};
    if (sources_) {
      const auto [instance, mesh, index] = sources_->at(t.id);
      const ScreenTransform to_screen({camera_, width_, height_}, model_matrix(mesh, instance));
      const double depth_scale = double{camera_.far_z} / (double{camera_.far_z} - least_w_);
      for (int i = 0; i < 3; ++i) {
        const ClipVertex v = to_screen(mesh.positions[mesh.triangles[index][i]]);
        of.add({v.x, v.y, depth_scale * (v.w - least_w_), v.w});
      }
    } else {
      for (const glm::vec3 v : std::get<TriangleStream>(drawable_).triangles[t.id].vertex)
        of.add({v.x, v.y, v.z, 1.0f});
    }
    double largest_px = 0.0;
    for (int i = 0; i < 3; ++i)
      largest_px = std::max({largest_px, std::abs(double{t.at.x_px[i]}), std::abs(double{t.at.y_px[i]})});
    t.position_error_px = kClipError * (of.position + largest_px * of.w) / least_w_;
    t.depth_error = kClipError * (of.depth + of.w) / least_w_;
  }

 private:
  struct Largest {
    double position, depth, w;
    void add(glm::dvec4 v) {
      position = std::max({position, std::abs(v.x), std::abs(v.y)});
      depth = std::max(depth, std::abs(v.z)), w = std::max(w, std::abs(v.w));
    }
  };
  const Drawable& drawable_;
  std::unique_ptr<SourceTriangles> sources_;  // null for streams
  Camera camera_;
  int width_ = 0, height_ = 0;
  double least_w_ = 1.0;
};

// Or nearly so: rounding decides whether z / w is 1 where z is w.
bool touches_near(const UnsnappedTriangle& t) {
  return std::ranges::any_of(t.z01, [](float z) { return double{z} <= kVertexDepthError; });
}
bool touches_far(const UnsnappedTriangle& t) {
  return std::ranges::any_of(t.z01, [](float z) { return double{z} >= 1.0 - kVertexDepthError; });
}

}  // namespace

std::span<const DepthFormat> depth_formats() {
  return kDepthFormats;
}

const DepthFormat& find_depth_format(std::string_view name) {
  return find_named("depth format", name, depth_formats(), &DepthFormat::name);
}

double float_plane_error(double largest_z, double span_z, double dx_px, double dy_px, double area_px,
                         double reach_x_px, double reach_y_px) {
  constexpr double kRounding = 0x1p-24,
                   kRoundings = 8.0;  // successive roundings in the computation of a pixel's depth
  if (span_z == 0.0) return kRoundings * kRounding * largest_z;
  if (!(area_px > 0.0)) return std::numeric_limits<double>::infinity();
  return kRoundings * kRounding * (largest_z + span_z * (dy_px * reach_x_px + dx_px * reach_y_px) / area_px);
}

std::string_view name_of(Unstable reason) {
  return kNames[static_cast<std::size_t>(reason)];
}

std::array<std::uint64_t, kUnstableKinds> PortablePixels::counts() const {
  std::array<std::uint64_t, kUnstableKinds> counts{};
  for (const Unstable reason : reasons) ++counts[static_cast<std::size_t>(reason)];
  return counts;
}

PortablePixels portable_pixels(std::span<const PortableTriangle> triangles, int width, int height,
                               const Conformance& model, int threads) {
  check(triangles, width, height, model);
  PortablePixels result{width, height, {}};
  result.reasons.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const int bands = std::min(threads, height);
  parallel_for(threads, bands, [&](int band) {
    const auto row = [&](int of) { return static_cast<int>(std::int64_t{height} * of / bands); };
    mark_rows(triangles, model, row(band), row(band + 1), result);
  });
  return result;
}

std::vector<PortableTriangle> portable_triangles(const Drawable& drawable, FrontendOptions options) {
  Frontend frontend;
  options.payload = Payload::id;
  options.shade = false;
  std::vector<bool> drawn;
  for (const ScreenTriangle& t : frontend.run(drawable, options)) {
    if (t.payload >= drawn.size()) drawn.resize(t.payload + std::size_t{1});
    drawn[t.payload] = true;
  }
  options.cull = Cull::none;
  options.keep_unsnapped = options.keep_states = true;
  const auto triangles = frontend.run(drawable, options);
  ClipErrors clip_errors(drawable, options);
  std::vector<PortableTriangle> result;
  result.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::uint32_t id = triangles[i].payload;
    PortableTriangle t{frontend.unsnapped()[i], id, id < drawn.size() && drawn[id],
                       frontend.states()[id] == TriangleState::clipped};
    t.clipped = t.clipped || touches_near(t.at) || touches_far(t.at);
    if (t.clipped) clip_errors.add_to(t);
    // Our depth comes from the view distance, not from z / w.
    for (int k = 0; k < 3; ++k)
      t.depth_error =
          std::max(t.depth_error, std::abs(double{t.at.z01[k]} - contract::depth01(triangles[i].z[k])));
    result.push_back(t);
  }
  return result;
}

}  // namespace edgewise::lab
