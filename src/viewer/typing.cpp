#include "viewer/typing.h"

#include <algorithm>
#include <limits>

#include "viewer/session.h"

namespace edgewise::viewer {

namespace {

constexpr double kStroke_s = 0.1;  // how long a key is held

double seconds_of(const Stroke& stroke) {
  const double* const wait = std::get_if<double>(&stroke);
  return wait != nullptr ? *wait : kStroke_s;
}

}  // namespace

double seconds_of(std::span<const Stroke> strokes) {
  double seconds = 0;
  for (const Stroke& stroke : strokes) seconds += seconds_of(stroke);
  return seconds;
}

void type(Session& session, std::span<const Stroke> strokes, tools::Size size, Cell cell) {
  Film(session, size, cell, std::numeric_limits<double>::infinity(), nullptr).type(strokes);
}

Film::Film(Session& session, tools::Size size, Cell cell, double frame_s, std::function<void(Screen&)> show)
    : session_(session),
      size_(size),
      cell_(cell),
      frame_s_(frame_s),
      to_next_s_(frame_s),
      show_(std::move(show)) {
  session_.draw(size_, cell_);
}

void Film::type(std::span<const Stroke> strokes) {
  for (const Stroke& stroke : strokes) {
    const Key* const key = std::get_if<Key>(&stroke);
    if (key != nullptr) session_.press(*key);
    if (const Named* const named = std::get_if<Named>(&stroke)) session_.choose(named->method);
    pass(seconds_of(stroke));
    if (key != nullptr) session_.release(*key);
    session_.draw(size_, cell_);
  }
}

void Film::pass(double seconds) {
  // Tolerance for rounding errors of sums of 0.1 s.
  constexpr double kRounding_s = 1e-9;
  for (; to_next_s_ <= seconds + kRounding_s; to_next_s_ = frame_s_) {
    session_.advance(to_next_s_);
    seconds -= to_next_s_;
    show_(session_.draw(size_, cell_));
  }
  seconds = std::max(seconds, 0.0);
  session_.advance(seconds);
  to_next_s_ -= seconds;
}

}  // namespace edgewise::viewer
