// A progress bar: one line on stderr, redrawn in place, only where stderr is a terminal.
#pragma once

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

// For the signal handler: erases a bar if one is on the screen. Async-signal-safe.
void erase_progress_on_signal();

}  // namespace edgewise::app
