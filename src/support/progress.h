// A progress bar: one line on stderr, redrawn in place, only on a terminal that moves its cursor.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace edgewise::app {

class Progress {
 public:
  Progress();
  ~Progress();  // erases the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(double fraction, std::string_view label);
  void erase();  // before a line is printed beside it

 private:
  bool terminal_;
  int shown_percent_ = -1;
};

// Says how long work will still take, from how long it has taken so far.
class TimeLeft {
 public:
  // "2:05 left, LABEL"; LABEL alone until the guess is worth something.
  std::string label(double fraction, std::string_view label) const;

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// For the signal handler: erases a bar if one is on the screen. Async-signal-safe.
void erase_progress_on_signal();

}  // namespace edgewise::app
