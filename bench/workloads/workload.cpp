#include "bench/workloads/workload.h"

#include "edgewise/draw.h"
#include "lab/cases/backend_comparison.h"

namespace edgewise::bench {

Workload::Workload(int width, int height, Cull mesh_cull, std::function<tools::Source()> load)
    : width_(width), height_(height), mesh_cull_(mesh_cull), load_(std::move(load)) {}

FrontendOptions Workload::frontend_options() const {
  FrontendOptions options;
  options.width = width_;
  options.height = height_;
  options.cull = stream_ ? Cull::none : mesh_cull_;
  options.shade = !stream_;
  options.subpixel_bits = subpixel_bits_;
  return options;
}

std::span<const ScreenTriangle> Workload::run(Frontend& frontend, const Execution& execution) {
  return frontend.run(source_->drawable, frontend_options(), execution);
}

void Workload::draw(Frontend& frontend, Backend& backend, FrameView frame, const Execution& execution) {
  edgewise::draw(source_->drawable, frontend, frontend_options(), backend, frame, {kBackground}, execution);
}

void Workload::prepare(bool keep_scene) {
  if (prepared_) return;
  source_ = load_();
  stream_ = source_->stream;
  Frontend frontend;
  const auto emitted = frontend.run(source_->drawable, frontend_options());
  triangles_.assign(emitted.begin(), emitted.end());
  submitted_ = frontend.stats().triangles;
  covered_px_ = lab::covered_pixels(triangles_, width_, height_);
  if (!keep_scene) source_.reset();
  prepared_ = true;
}

Framebuffer Workload::drawn() const {
  Framebuffer frame(width_, height_);
  backends().front().make()->draw(triangles_, frame.view(), {kBackground},
                                  {.target = supported_targets().front()});
  return frame;
}

const Framebuffer& Workload::reference() {
  if (!reference_) reference_.emplace(drawn());
  return *reference_;
}

}  // namespace edgewise::bench
