#include "support/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <string>

#include "support/console.h"

namespace edgewise::tools {

namespace {

constexpr int kBarWidth = 24;
constexpr int kColumnsBesideBar = 8;  // columns of brackets, blanks and "100%"
constexpr std::string_view kErase = "\r\033[K";
volatile std::sig_atomic_t on_screen = 0;

}  // namespace

Progress::Progress() : terminal_(moves_cursor(STDERR_FILENO)) {}

void Progress::show(std::optional<double> fraction, std::string_view label) {
  if (!terminal_) return;
  if (fraction) fraction = std::clamp(*fraction, 0.0, 1.0);
  const int percent = fraction ? static_cast<int>(100.0 * *fraction) : -1;
  const auto now = std::chrono::steady_clock::now();
  if (fraction.value_or(0.0) < counted_) start_ = now;  // another count begins
  counted_ = fraction.value_or(0.0);
  if (percent == shown_percent_ && now - shown_at_ < std::chrono::seconds(1)) return;
  shown_percent_ = percent;
  shown_at_ = now;
  // Leave the last column free: some terminals wrap when it is filled.
  const int room = terminal_width(STDERR_FILENO) - 1;
  std::string line(kErase);
  int label_room = room;
  if (fraction) {
    const int bar = std::clamp(room - kColumnsBesideBar, 0, kBarWidth);
    const auto filled = static_cast<std::size_t>(percent * bar / 100);
    line += fmt::format("[{:<{}}] {:3}% ", std::string(filled, '#'), bar, percent);
    label_room -= kColumnsBesideBar + bar;
  }
  std::string text(label);
  const double spent_s = std::chrono::duration<double>(now - start_).count();
  if (percent >= 1 && spent_s >= 1.0) {
    const auto left_s = static_cast<int>(spent_s * (1.0 - *fraction) / *fraction + 0.5);
    text = fmt::format("{}:{:02} left, {}", left_s / 60, left_s % 60, label);
  }
  line += printable_within(text, static_cast<std::size_t>(std::max(0, label_room)));
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

}  // namespace edgewise::tools
