#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <string>

namespace edgewise::app {

namespace {

constexpr int kBarWidth = 24, kLabelWidth = 24;  // fits 60 columns
constexpr std::string_view kErase = "\r\033[K";
volatile std::sig_atomic_t on_screen = 0;

}  // namespace

Progress::Progress() : terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  erase();
}

void Progress::show(double fraction, std::string_view label) {
  if (!terminal_) return;
  const int percent = static_cast<int>(100.0 * std::clamp(fraction, 0.0, 1.0));
  if (percent == shown_percent_) return;
  shown_percent_ = percent;
  const auto filled = static_cast<std::size_t>(percent * kBarWidth / 100);
  const std::string line = fmt::format("{}[{:<{}}] {:3}% {:.{}}", kErase, std::string(filled, '#'), kBarWidth,
                                       percent, label, kLabelWidth);
  on_screen = 1;
  std::fwrite(line.data(), 1, line.size(), stderr);
  std::fflush(stderr);
}

void Progress::erase() {
  if (on_screen == 0) return;
  std::fwrite(kErase.data(), 1, kErase.size(), stderr);
  std::fflush(stderr);
  on_screen = 0;
  shown_percent_ = -1;
}

void erase_progress_on_signal() {
  if (on_screen != 0 && write(STDERR_FILENO, kErase.data(), kErase.size()) < 0) on_screen = 0;
}

}  // namespace edgewise::app
