// The conformance suite's pipelines: every registered backend on every SIMD target of the machine, with the
// front end on the same target.
//
// The suite checks this rasterizer as Khronos' conformance tests (KhronosGroup/VK-GL-CTS) check a driver:
// their groups rasterization.fill_rules and rasterization.culling (modules/gles2/functional/
// es2fRasterizationTests.cpp, external/vulkancts/modules/vulkan/rasterization/), clipping (es2fClippingTests.
// cpp: triangle_vertex, polygon, polygon_edge; vulkan/clipping/vktClippingTests.cpp: clip_volume). Those
// compare pictures with tolerances, since drivers may snap differently. Here the comparison is exact, except
// that samples within 1/64 px of an edge that clipping has rounded are judged by hit counts only
// (clipping_test.cpp).
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "conformance/streams.h"
#include "edgewise/backend.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "lab/cases/backend_comparison.h"

namespace edgewise::conformance {

// The conformance suite's own truth: the winding number of a polygon around a sample. It shares no arithmetic
// with the contract, a backend or the laboratory: it has no biased edge functions and no triangles.
//
// The top-left rule: move each sample right by an infinitesimal step, and down by an infinitely smaller one.
// The moved sample lies on no edge. A ray from it to the right crosses an edge if the edge spans the sample's
// height, upper end included and lower end excluded, strictly to the right of the sample.

// 2^-15 px, as snapped positions are; up to 2^37.
using SubPosition = glm::vec<2, std::int64_t>;
using Product = contract::int128;
inline constexpr std::int64_t kPixel = 1 << kMaxSubpixelBits;
inline constexpr int kBits[] = {kMinSubpixelBits, 8, 12, kMaxSubpixelBits};  // that the suite draws

// The winding number around a pixel's sample: positive is clockwise on the y-down screen, that is front.
// Triangles that fill the polygon with its orientation must draw the pixel this many times in total.
inline int winding(std::span<const SubPosition> polygon, int px, int py) {
  const std::int64_t sx = px * kPixel + kPixel / 2, sy = py * kPixel + kPixel / 2;
  int turns = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const SubPosition &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const bool down = p.y <= sy && sy < q.y, up = q.y <= sy && sy < p.y;
    if (!down && !up) continue;
    const Product side = Product{q.x - p.x} * (sy - p.y) - Product{q.y - p.y} * (sx - p.x);
    if (down && side > 0) ++turns;
    if (up && side < 0) --turns;
  }
  return turns;
}

inline std::vector<int> windings(std::span<const SubPosition> polygon, int width, int height) {
  std::vector<int> all;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) all.push_back(winding(polygon, x, y));
  return all;
}

// Twice the area; positive is clockwise.
inline Product area(std::span<const SubPosition> polygon) {
  Product sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const SubPosition &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    sum += Product{p.x} * q.y - Product{p.y} * q.x;
  }
  return sum;
}

inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFF;  // payload where nothing was drawn

struct View {
  int width = 64, height = 64;  // px
  Cull cull = Cull::none;
  int subpixel_bits = 8;

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

class Pipeline {
 public:
  Pipeline(const BackendInfo& info, SimdTarget target)
      : name_(std::string(info.name) + " on " + std::string(name_of(target))),
        target_(target),
        backend_(info.make()) {}

  const std::string& name() const { return name_; }

  // The front end's screen triangles; payloads are the indices of the source triangles.
  std::span<const ScreenTriangle> triangles(const Drawable& drawable, const View& view) {
    FrontendOptions options{.width = view.width, .height = view.height, .cull = view.cull};
    options.payload = Payload::id;
    options.subpixel_bits = view.subpixel_bits;
    return frontend_.run(drawable, options, {.target = target_});
  }
  const FrontendStats& stats() const { return frontend_.stats(); }

  const Framebuffer& draw(const Drawable& drawable, const View& view) {
    return draw(triangles(drawable, view), view);
  }
  const Framebuffer& draw(std::span<const ScreenTriangle> triangles, const View& view) {
    if (!frame_ || frame_->width() != view.width || frame_->height() != view.height)
      frame_ = std::make_unique<Framebuffer>(view.width, view.height);
    lab::poison(*frame_);
    backend_->draw(triangles, frame_->view(), {kNoTriangle}, {.target = target_});
    return *frame_;
  }

  // The number of triangles that draw each pixel, row by row. Draws each triangle alone.
  std::vector<int> hits(const Drawable& drawable, const View& view) {
    std::vector<int> all(view.pixels(), 0);
    for (const ScreenTriangle& triangle : triangles(drawable, view)) {
      const auto payloads = lab::payloads_of(draw(std::span(&triangle, 1), view));
      for (std::size_t i = 0; i < all.size(); ++i) all[i] += payloads[i] != kNoTriangle;
    }
    return all;
  }

 private:
  std::string name_;
  SimdTarget target_;
  std::unique_ptr<Backend> backend_;
  std::unique_ptr<Framebuffer> frame_;
  Frontend frontend_;
};

inline std::vector<Pipeline> pipelines() {
  std::vector<Pipeline> all;
  for (const BackendInfo& backend : backends())
    for (const SimdTarget target : supported_targets()) all.emplace_back(backend, target);
  return all;
}

// Creates the pipelines once, and counts the compared pictures for the test's report.
class Conformance : public ::testing::Test {
 protected:
  ~Conformance() override { RecordProperty("cases", std::to_string(cases_)); }

  // Calls judge(pipeline) for each, until one fails.
  template <typename Judge>
  void with_each(const std::string& what, Judge&& judge) {
    for (Pipeline& pipeline : pipelines_) {
      SCOPED_TRACE(what + ", " + pipeline.name());
      judge(pipeline);
      ++cases_;
      if (HasFailure()) return;
    }
  }

  // Every pixel must be hit as often as `expected` says.
  void expect_hits(const Drawable& drawable, const View& view, const std::vector<int>& expected,
                   const std::string& what) {
    with_each(what, [&](Pipeline& pipeline) {
      const auto hits = pipeline.hits(drawable, view);
      for (std::size_t i = 0; i < hits.size(); ++i) {
        const auto width = static_cast<std::size_t>(view.width);
        ASSERT_EQ(hits[i], expected[i]) << "hits at pixel (" << i % width << ", " << i / width << ")";
      }
    });
  }

  // Every pixel must have this payload; kNoTriangle where nothing may be drawn.
  void expect_visible_triangles(const Drawable& drawable, const View& view,
                                const std::vector<std::uint32_t>& expected, const std::string& what) {
    with_each(what, [&](Pipeline& pipeline) {
      const Framebuffer& frame = pipeline.draw(drawable, view);
      auto visible_it = expected.begin();
      for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x, ++visible_it) {
          ASSERT_EQ(frame.payload_row(y)[x], *visible_it)
              << "visible triangle at pixel (" << x << ", " << y << ")";
          if (*visible_it == kNoTriangle) {
            ASSERT_EQ(frame.depth_row(y)[x], contract::kDepthClear);
          }
        }
    });
  }

  void expect_nothing(const Drawable& drawable, const View& view, const std::string& what) {
    expect_visible_triangles(drawable, view, std::vector(view.pixels(), kNoTriangle), what);
  }

 private:
  std::vector<Pipeline> pipelines_ = pipelines();
  std::uint64_t cases_ = 0;
};

// The snapped position of a float: half to even, exact (a float times a power of 2 is a double). Only in
// range.
inline SubPosition snapped(glm::vec3 v, int bits) {
  const auto one = [bits](float px) {
    return std::llrint(std::ldexp(double{px}, bits)) << (kMaxSubpixelBits - bits);
  };
  return {one(v.x), one(v.y)};
}

inline std::vector<SubPosition> snapped(std::span<const glm::vec3> polygon, int bits) {
  std::vector<SubPosition> all;
  for (const glm::vec3 v : polygon) all.push_back(snapped(v, bits));
  return all;
}

}  // namespace edgewise::conformance
