// Deliberately wrong backends.
#pragma once

#include <memory>
#include <span>

#include "edgewise/backend.h"

namespace edgewise::testing {

// The pass in which another backend draws the part.
inline RenderPass pass_of(const FramePart& part) {
  return {part.background, part.clear, {part.x0, part.y0}};
}

// Draws by kDraw(right backend, triangles, part, execution).
template <auto kDraw>
class DrawnBy : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, const FramePart& part,
                    const Execution& execution) override {
    kDraw(*right_, triangles, part, execution);
  }
  std::unique_ptr<Backend> right_ = backends()[0].make();
};

// Draws the right picture, and then calls kSpoil(frame, background, execution).
template <auto kSpoil>
class Spoiled : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, const FramePart& part,
                    const Execution& execution) override {
    right_->draw(triangles, part.frame, pass_of(part), execution);
    kSpoil(part.frame, part.background, execution);
  }
  std::unique_ptr<Backend> right_ = backends()[0].make();
};

// Wrong only if it draws from a source: it draws nothing.
class IgnoresSources : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, const FramePart& part,
                    const Execution& execution) override {
    right_->draw(triangles, part.frame, pass_of(part), execution);
  }
  bool draw_source(TriangleSource&, const FramePart& part, const Execution& execution) override {
    right_->draw(std::span<const ScreenTriangle>(), part.frame, pass_of(part), execution);
    return true;
  }
  std::unique_ptr<Backend> right_ = backends()[0].make();
};

template <typename Wrong>
BackendInfo wrong_backend() {
  return {"wrong", "a wrong backend", [] { return std::unique_ptr<Backend>(std::make_unique<Wrong>()); }};
}

}  // namespace edgewise::testing
