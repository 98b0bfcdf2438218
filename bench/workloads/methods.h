// The laboratory's methods on one of its scenes, as rows.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lab/scenes.h"

namespace edgewise::bench {

// A scene of the laboratory with the memory into which all its methods draw.
class MethodScene {
 public:
  explicit MethodScene(lab::LabScene info) : info_(std::move(info)) {}
  const lab::LabScene& info() const { return info_; }

  // Makes the scene. Later calls do nothing.
  void load();
  // After load():
  const lab::AnyScene& scene() const { return *scene_; }
  lab::Size size() const;
  std::size_t triangles() const;  // facing: faces

  // The memory that a family's methods draw into.
  std::optional<lab::Canvas> canvas;
  std::optional<lab::ClippingFrame> clipped;
  lab::VisibilityFrame visible;
  std::vector<std::uint8_t> front;

 private:
  lab::LabScene info_;
  std::optional<lab::AnyScene> scene_;
};

// One method in one form (threads and SIMD target).
struct MethodDraw {
  std::shared_ptr<MethodScene> scene;
  std::variant<const lab::CoverageMethod*, const lab::VisibilityMethod*, const lab::FacingMethod*,
               const lab::ClippingMethod*>
      method;
  Execution execution;

  std::string_view name() const;
  // Loads the scene, and returns the timed draw. `error` says why it must not be timed: it draws other pixels
  // than its scalar form on one thread, so that the times would compare different work.
  std::function<void()> prepare(std::string& error) const;
};

// All forms of the methods of the scene's family: scalar and with the widest SIMD target, on one thread and
// on two, where they have these.
std::vector<MethodDraw> method_draws(lab::LabScene scene);

}  // namespace edgewise::bench
