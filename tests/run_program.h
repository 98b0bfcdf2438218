// Runs one of the project's programs in a shell, and captures its output.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "temp_dir.h"

namespace edgewise::testing {

struct Outcome {
  int status;  // the exit status; -1 if a signal ended it
  std::string out, err;
};

// `arguments` are shell words; they may redirect stdout.
inline Outcome run_program(const std::string& program, const std::string& arguments) {
  const TempDir folder;
  const std::string out = (folder.path() / "out").string(), err = (folder.path() / "err").string();
  const std::string command = "'" + program + "' >'" + out + "' 2>'" + err + "' " + arguments;
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, file_content(out), file_content(err)};
}

}  // namespace edgewise::testing
