// The conformance suite's pipelines: every registered backend on every SIMD target of the machine, with the
// front end on the same target.
//
// The suite checks this rasterizer as Khronos' conformance tests (KhronosGroup/VK-GL-CTS) check a driver:
// their groups rasterization.fill_rules and rasterization.culling (modules/gles2/functional/
// es2fRasterizationTests.cpp, external/vulkancts/modules/vulkan/rasterization/), clipping (es2fClippingTests.
// cpp: triangle_vertex, polygon, polygon_edge; vulkan/clipping/vktClippingTests.cpp: clip_volume). Those
// compare pictures with tolerances, since drivers may snap differently. Here the comparison is exact, except
// that samples within 1/64 px of an edge that clipping has rounded are judged by hit counts only (outline.h).
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "conformance/winding.h"
#include "edgewise/backend.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "lab/measure.h"

namespace edgewise::conformance {

inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFF;  // payload where nothing was drawn

struct View {
  int width = 64, height = 64;  // px
  Cull cull = Cull::none;
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
    options.target = target_;
    return frontend_.run(drawable, options);
  }
  const FrontendStats& stats() const { return frontend_.stats(); }

  const Framebuffer& draw(const Drawable& drawable, const View& view) {
    return draw(triangles(drawable, view), view);
  }
  const Framebuffer& draw(std::span<const ScreenTriangle> triangles, const View& view) {
    if (!frame_ || frame_->width() != view.width || frame_->height() != view.height)
      frame_ = std::make_unique<Framebuffer>(view.width, view.height);
    lab::poison(*frame_);
    backend_->draw(triangles, frame_->view(), kNoTriangle, {.target = target_});
    return *frame_;
  }

  // The number of triangles that draw each pixel, row by row. Draws each triangle alone.
  std::vector<int> hits(const Drawable& drawable, const View& view) {
    std::vector<int> all(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height), 0);
    for (const ScreenTriangle& triangle : triangles(drawable, view)) {
      const Framebuffer& frame = draw(std::span(&triangle, 1), view);
      auto hit = all.begin();
      for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x, ++hit) *hit += frame.payload_row(y)[x] != kNoTriangle;
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
    const auto pixels = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
    expect_visible_triangles(drawable, view, std::vector<std::uint32_t>(pixels, kNoTriangle), what);
  }

 private:
  std::vector<Pipeline> pipelines_ = pipelines();
  std::uint64_t cases_ = 0;
};

// The snapped position of a float: half to even, exact (a float times 256 is a double). Only in range.
inline SubPosition snapped(glm::vec3 v) {
  const auto one = [](float px) { return std::llrint(static_cast<double>(px) * 256.0); };
  return {one(v.x), one(v.y)};
}

inline std::vector<SubPosition> snapped(std::span<const glm::vec3> polygon) {
  std::vector<SubPosition> all;
  for (const glm::vec3 v : polygon) all.push_back(snapped(v));
  return all;
}

inline TriangleStream stream_of(const std::vector<glm::vec3>& vertices,
                                const std::vector<glm::uvec3>& triangles) {
  TriangleStream stream{64, 64, {}};
  for (const glm::uvec3 t : triangles)
    stream.triangles.push_back({{vertices.at(t.x), vertices.at(t.y), vertices.at(t.z)}, 0});
  return stream;
}

}  // namespace edgewise::conformance
