#include "app/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "app/printable.h"

namespace edgewise::app {

void print(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
}

bool stdout_is_whole() {
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

void print_error(std::string_view message, std::string_view program) {
  const std::string line = std::string(program) + ": " + printable(message, ' ') + '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

int terminal_width(int descriptor) {
  winsize size{};
  if (ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

}  // namespace edgewise::app
