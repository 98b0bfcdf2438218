#include "app/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cctype>
#include <cstdio>
#include <string>

namespace edgewise::app {

void print(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
}

bool stdout_is_whole() {
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

void print_error(std::string_view message) {
  std::string line = "edgewise: ";
  // A file name may hold anything; the message stays one line whatever it quotes.
  for (const char c : message) line += std::iscntrl(static_cast<unsigned char>(c)) ? ' ' : c;
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

int terminal_width() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

}  // namespace edgewise::app
