// Types keys into a session: the keys of --keys, of a demo's step, or of an animation.
#pragma once

#include <functional>
#include <span>

#include "support/options.h"
#include "viewer/keys.h"
#include "viewer/text.h"

namespace edgewise::viewer {

class Session;

// The duration of these strokes: 0.1 s per key or method, plus the times to wait.
double seconds_of(std::span<const Stroke> strokes);

// Types the strokes in sequence. Draws before and after each, because some keys depend on the last frame.
void type(Session& session, std::span<const Stroke> strokes, tools::Size size, Cell cell);

// Types strokes and draws frames at equal time intervals, the first after one interval.
class Film {
 public:
  // `show` is called with each drawn frame and may paint into it.
  Film(Session& session, tools::Size size, Cell cell, double frame_s, std::function<void(Screen&)> show);
  void type(std::span<const Stroke> strokes);

 private:
  void pass(double seconds);

  Session& session_;
  tools::Size size_;
  Cell cell_;
  double frame_s_, to_next_s_;
  std::function<void(Screen&)> show_;
};

}  // namespace edgewise::viewer
