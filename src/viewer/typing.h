// Keys typed into a session by nobody: to begin with, as a step of a demonstration, or for an animation.
#pragma once

#include <functional>
#include <span>

#include "support/options.h"
#include "viewer/keys.h"
#include "viewer/text.h"

namespace edgewise::viewer {

class Session;

// How long these take: a tenth of a second for each key or method, and the times to wait.
double seconds_of(std::span<const Stroke> strokes);

// Types them one after the other; draws before and after each, since some keys ask for what was seen.
void type(Session& session, std::span<const Stroke> strokes, app::Size size, Cell cell);

// The same as time goes by, with frames in equal distances, the first one distance after the beginning.
class Film {
 public:
  // `show` gets each frame, drawn, and may paint into it.
  Film(Session& session, app::Size size, Cell cell, double frame_s, std::function<void(Screen&)> show);
  void type(std::span<const Stroke> strokes);

 private:
  void pass(double seconds);

  Session& session_;
  app::Size size_;
  Cell cell_;
  double frame_s_, to_next_s_;
  std::function<void(Screen&)> show_;
};

}  // namespace edgewise::viewer
