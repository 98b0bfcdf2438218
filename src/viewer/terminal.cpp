// Terminal input and output; the session does everything else.
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <map>
#include <stdexcept>

#include "edgewise/contract.h"
#include "support/console.h"
#include "support/process.h"
#include "viewer/session.h"
#include "viewer/terminal_io.h"
#include "viewer/window.h"

namespace edgewise::viewer {

namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::milliseconds;

constexpr Milliseconds kFrame(33), kIdle(200);
// Terminals don't report key releases: a key counts as released once it has not repeated for this long.
constexpr Milliseconds kKeyTimeout(200);
constexpr Milliseconds kEscapeTimeout(50);

// Alternate screen, hidden cursor; and the way back, which the signal handler uses too.
constexpr char kEnter[] = "\x1b[?1049h\x1b[?25l";
constexpr char kLeave[] = "\x1b[0m\x1b[?25h\x1b[?1049l";
termios mode_before;

void leave() {
  // A failed write is ignored: nothing can be done about it here.
  [[maybe_unused]] const auto written = write(STDOUT_FILENO, kLeave, sizeof(kLeave) - 1);
  tcsetattr(STDIN_FILENO, TCSANOW, &mode_before);
}

// Writes all bytes. False if the terminal is gone.
bool put(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR && errno != EAGAIN) return false;
    if (written < 0 && errno == EAGAIN) {
      pollfd out{STDOUT_FILENO, POLLOUT, 0};
      poll(&out, 1, -1);
    }
    bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
  }
  return true;
}

class RawTerminal {
 public:
  RawTerminal() {
    if (isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0 || tcgetattr(STDIN_FILENO, &mode_before) != 0)
      throw std::runtime_error("--terminal needs a terminal as standard input and output");
    if (!tools::moves_cursor(STDOUT_FILENO))
      throw std::runtime_error("--terminal needs a terminal with cursor control: TERM is unset or 'dumb'");
    tools::call_before_stopping(leave);
    termios raw = mode_before;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | IEXTEN);
    raw.c_iflag &= ~static_cast<tcflag_t>(ICRNL | IXON);
    raw.c_cc[VSUSP] = _POSIX_VDISABLE;  // suspending would leave the terminal in raw mode
    raw.c_cc[VMIN] = raw.c_cc[VTIME] = 0;
    tcsetattr(STDIN_FILENO, TCSANOW, &raw);
    put(kEnter);
  }
  ~RawTerminal() {
    leave();
    tools::call_before_stopping(nullptr);
  }
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  tools::Size size_px() const {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0)
      size.ws_col = 80, size.ws_row = 24;
    // The last row shows the status.
    return {std::min<int>(size.ws_col, contract::kMaxImageSide),
            std::clamp<int>(size.ws_row * 2 - 2, 1, contract::kMaxImageSide)};
  }
};

// One line: the message, or the demo's step, or methods, errors and times.
std::string status_of(const Session& session) {
  const State& state = session.state();
  if (!state.message.empty()) return state.message;
  if (state.help) return "`edgewise view --help` lists all keys";
  if (state.step > 0)
    return fmt::format("{}/{} {}", state.step, session.steps().size(),
                       session.steps()[state.step - 1].notice);
  const Side& side = session.side(state.active);
  const bool counted = side.judgement && state.errors != Errors::off;
  return fmt::format("{}, {}{:.1f} ms  [h] help", describe(side.choice),
                     counted ? errors_of(*side.judgement) + ", " : "", state.frame_ms);
}

class Loop {
 public:
  explicit Loop(Session& session) : session_(session) {}

  void run() {
    Clock::time_point last = Clock::now();
    while (!session_.done()) {
      const Clock::time_point now = Clock::now();
      session_.advance(std::chrono::duration<double>(std::min<Clock::duration>(now - last, kIdle)).count());
      last = now;
      const Screen& screen = session_.draw(terminal_.size_px());
      if (!put(picture_.show(screen, status_of(session_)))) return;
      // Any event ends the pause, because it may change the picture.
      if (!read_until(now + (session_.still() ? kIdle : kFrame))) return;
      release_old();
    }
  }

 private:
  // Handles input until the first event or the time `until`. False if the terminal is gone.
  bool read_until(Clock::time_point until) {
    auto pause = std::chrono::duration_cast<Milliseconds>(until - Clock::now());
    if (!pending_.empty()) pause = std::min(pause, kEscapeTimeout);
    pollfd in{STDIN_FILENO, POLLIN, 0};
    const int ready = poll(&in, 1, static_cast<int>(std::max<std::int64_t>(pause.count(), 0)));
    if (ready < 0) return errno == EINTR;
    if (ready > 0) {
      char bytes[1024];
      const ssize_t size = read(STDIN_FILENO, bytes, sizeof(bytes));
      if (size <= 0) return size < 0 && (errno == EINTR || errno == EAGAIN);
      pending_.append(bytes, static_cast<std::size_t>(size));
    }
    for (const Key key : take_keys(pending_, ready == 0)) {
      session_.press(key);
      held_until_[key] = Clock::now() + kKeyTimeout;
    }
    return true;
  }

  void release_old() {
    std::erase_if(held_until_, [&](const auto& held) {
      if (Clock::now() < held.second) return false;
      session_.release(held.first);
      return true;
    });
  }

  RawTerminal terminal_;
  Session& session_;
  std::string pending_;  // input
  TerminalPicture picture_;
  std::map<Key, Clock::time_point> held_until_;
};

}  // namespace

void show_in_terminal(Session& session) {
  Loop(session).run();
}

}  // namespace edgewise::viewer
