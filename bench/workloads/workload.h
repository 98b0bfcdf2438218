// The input of a benchmark row: one scene at one size and culling mode, loaded when a row first needs it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/frontend.h"
#include "support/source.h"

namespace edgewise::bench {

inline constexpr std::uint32_t kBackground = 0xFF000000u;

class Workload {
 public:
  // Meshes are drawn with `mesh_cull` and shading, streams with neither.
  Workload(int width, int height, Cull mesh_cull, std::function<tools::Source()> load);

  // Loads the scene, runs the front end and counts the covered pixels. Later calls do nothing.
  // `keep_scene` is needed by rows that time the front end; otherwise the scene's memory is freed.
  void prepare(bool keep_scene);

  // The picture that every row must reproduce: the first backend on one thread, slowest SIMD target.
  const Framebuffer& reference();
  void drop_reference() { reference_.reset(); }

  // Before prepare(); 8 otherwise.
  void set_subpixel_bits(int bits) { subpixel_bits_ = bits; }

  // The timed work of a front end row: scene to screen triangles. Requires prepare(true).
  std::span<const ScreenTriangle> run(Frontend& frontend, const Execution& execution);

  // The timed work of a frame row. Requires prepare(true).
  void draw(Frontend& frontend, Backend& backend, FrameView frame, const Execution& execution);

  FrontendOptions frontend_options() const;
  const Drawable& drawable() const { return source_->drawable; }
  std::span<const ScreenTriangle> triangles() const { return triangles_; }
  std::uint64_t submitted() const { return submitted_; }    // the scene's triangles
  std::uint64_t covered_px() const { return covered_px_; }  // a pixel counts once per triangle that covers it
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  Framebuffer drawn() const;

  int width_, height_, subpixel_bits_ = FrontendOptions().subpixel_bits;
  Cull mesh_cull_;
  std::function<tools::Source()> load_;
  std::optional<tools::Source> source_;
  bool stream_ = false, prepared_ = false;
  std::vector<ScreenTriangle> triangles_;
  std::uint64_t submitted_ = 0, covered_px_ = 0;
  std::optional<Framebuffer> reference_;
};

}  // namespace edgewise::bench
