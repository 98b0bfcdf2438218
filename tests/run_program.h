// Runs a program of ours, in a shell to catch all that it says, or to be interrupted.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

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

// Runs a program that is to write into `folder`, which is empty, presses Ctrl-C once it has begun, and
// expects it to end as interrupted and to leave the folder empty.
inline void expect_nothing_after_ctrl_c(std::string program, std::vector<std::string> arguments,
                                        const TempDir& folder) {
  std::vector<char*> words{program.data()};
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    if (freopen("/dev/null", "w", stdout) != nullptr) execv(program.c_str(), words.data());
    _exit(99);
  }
  // The temporary file shows that the work has begun.
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (folder.count() == 0 && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(folder.count(), 1u);
  kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace edgewise::testing
