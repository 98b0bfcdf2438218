// The frames of the chart for choosing a method, as rows.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lab/choice/choice.h"

namespace edgewise::bench {

// A scene of the chart, and what its rows share after the first is prepared.
struct ChoiceFrame {
  lab::ChoiceScene scene;
  std::optional<Drawable> drawable;
  std::optional<lab::FrameDrawer> drawer;
};

struct ChoiceDraw {
  std::shared_ptr<ChoiceFrame> frame;
  lab::ChoiceMethod method;

  // Returns the timed draw: from the vertices of the first frame to its picture. `error` says that it draws
  // other pixels than in scalar code.
  std::function<void()> prepare(std::string& error) const;
};

}  // namespace edgewise::bench
