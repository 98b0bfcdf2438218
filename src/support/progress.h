// A progress bar: one line on stderr, redrawn in place; only on a terminal with cursor control.
#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace edgewise::tools {

class Progress {
 public:
  Progress();
  ~Progress() { erase(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Redraws when the percentage changes, or after a second. "2:05 left, LABEL" from the first second and
  // percent on, estimated from the time since the fraction rose from its start. No fraction: the label alone.
  void show(std::optional<double> fraction, std::string_view label);
  void erase();  // call it before printing a line

 private:
  bool terminal_;
  int shown_percent_ = -1;
  double counted_ = 0.0;  // the last fraction
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), shown_at_;
};

// For the signal handler: erases a bar if one is on the screen. Async-signal-safe.
void erase_progress_on_signal();

}  // namespace edgewise::tools
