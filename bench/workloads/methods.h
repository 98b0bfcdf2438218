// The laboratory's coverage methods on one of its scenes, as rows.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lab/scenes.h"

namespace edgewise::bench {

// A scene of the laboratory with the memory into which all its methods draw.
struct MethodScene {
  lab::LabScene info;
  // After a row is prepared:
  std::optional<lab::CoverageScene> scene = {};
  std::optional<lab::Canvas> canvas = {};
};

// One method in one form (threads and SIMD target).
struct MethodDraw {
  std::shared_ptr<MethodScene> scene;
  const lab::CoverageMethod* method;
  Execution execution;

  // Makes the scene, and returns the timed draw. `error` says why it must not be timed: it draws other pixels
  // than its scalar form on one thread, so that the times would compare different work.
  std::function<void()> prepare(std::string& error) const;
};

// All forms of all coverage methods: scalar and with the widest SIMD target, on one thread and on two, where
// they have these.
std::vector<MethodDraw> method_draws(lab::LabScene scene);

}  // namespace edgewise::bench
