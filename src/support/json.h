// JSON as valid UTF-8 text, and where `--json FILE` writes it.
#pragma once

#include <optional>
#include <string>

#include "files/atomic_file.h"
#include "support/console.h"

namespace edgewise::tools {

// Replaces bytes that are not UTF-8, as in file names, by U+FFFD, where plain dump() throws. `indent` as in
// dump().
template <typename Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

class JsonOutput {
 public:
  // "-" is standard output; nothing is written if `path` is empty. Opens the file now, so that hours of work
  // do not end in "cannot be written". Throws as AtomicFile does.
  explicit JsonOutput(const std::string& path) : on_stdout_(path == "-") {
    if (!path.empty() && !on_stdout_) file_.emplace(path);
  }

  bool on_stdout() const { return on_stdout_; }  // where nothing else may then be printed
  bool wanted() const { return on_stdout_ || file_; }
  // Once, at the end: the file is complete, or not there.
  void write(const std::string& text) {
    if (on_stdout_) print(text);
    if (!file_) return;
    file_->stream() << text;
    file_->commit();
  }

 private:
  bool on_stdout_;
  std::optional<AtomicFile> file_;
};

}  // namespace edgewise::tools
