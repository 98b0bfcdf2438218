// Parses any bytes as a command line, one word per line: the result is either a message that a terminal can
// show, or an action, which is not performed.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "cli/basic/run.h"
#include "fuzz.h"
#include "support/console.h"

using namespace edgewise;

namespace {

// The words as main() gets them.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words{"edgewise"};
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    words.emplace_back(text.substr(0, std::min(text.substr(0, end).find('\0'), end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < ' ' || c == '\x7F';
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> words = words_of({reinterpret_cast<const char*>(data), size});
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  try {
    fuzz::require(tools::parse(static_cast<int>(words.size()), argv.data(), tools::all_commands()) != nullptr,
                  "neither an action nor an error");
  } catch (const std::invalid_argument& error) {
    const std::string line = tools::printable(error.what(), ' ');
    fuzz::require(!line.empty() && std::none_of(line.begin(), line.end(), is_control),
                  "a message that is not one printable line");
  }
  return 0;
}
