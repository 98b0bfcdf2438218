#include "workload.h"

#include "lab/measure.h"

namespace edgewise::bench {

const BackendInfo& reference_backend(bool fills) {
  return backends()[fills ? 0 : filling_backends().size()];
}

Workload::Workload(int width, int height, Cull mesh_cull, std::function<app::Source()> load)
    : width_(width), height_(height), mesh_cull_(mesh_cull), load_(std::move(load)) {}

FrontendOptions Workload::frontend_options(int threads) const {
  FrontendOptions options;
  options.width = width_;
  options.height = height_;
  options.cull = stream_ ? Cull::none : mesh_cull_;
  options.shade = !stream_;
  options.threads = threads;
  return options;
}

void Workload::prepare(bool keep_scene) {
  if (prepared_) return;
  source_ = load_();
  stream_ = source_->stream;
  Frontend frontend;
  const auto emitted = frontend.run(source_->drawable, frontend_options(1));
  triangles_.assign(emitted.begin(), emitted.end());
  submitted_ = frontend.stats().triangles;
  covered_px_ = lab::covered_pixels(triangles_, width_, height_);
  if (!keep_scene) source_.reset();
  prepared_ = true;
}

const BlockCounts& Workload::blocks() {
  if (!blocks_) blocks_ = count_blocks(triangles_, width_, height_);
  return *blocks_;
}

const Framebuffer& Workload::reference(bool fills) {
  std::optional<Framebuffer>& reference = fills ? filled_ : other_;
  if (!reference) {
    reference.emplace(width_, height_);
    Execution execution;
    execution.target = supported_targets().front();
    reference_backend(fills).make()->draw(triangles_, reference->view(), kBackground, execution);
  }
  return *reference;
}

}  // namespace edgewise::bench
