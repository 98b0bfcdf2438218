#include "support/console.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <set>
#include <string>

#include "support/printable.h"

namespace edgewise::tools {

namespace {
std::FILE* printed = stdout;
}

void print(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), printed);
}

void print_to_stderr() {
  printed = stderr;
}

bool stdout_is_whole() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  pollfd out{STDOUT_FILENO, POLLOUT, 0};
  return poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

void print_error(std::string_view message, std::string_view program) {
  const std::string line = std::string(program) + ": " + printable(message, ' ') + '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

void print_note(std::string_view message) {
  static std::mutex mutex;
  static std::set<std::string> earlier;
  const std::string line = printable(message, ' ') + '\n';
  const std::lock_guard lock(mutex);
  if (earlier.insert(line).second) std::fwrite(line.data(), 1, line.size(), stderr);
}

bool moves_cursor(int descriptor) {
  const char* const term = std::getenv("TERM");
  return isatty(descriptor) != 0 && term != nullptr && std::string_view(term) != "dumb";
}

int terminal_width(int descriptor) {
  winsize size{};
  return ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace edgewise::tools
