// Process setup of both programs: standard streams, signals, uncaught exceptions.
#pragma once

#include <exception>
#include <string>

namespace edgewise::tools {

// Must be called first in main(), with the program's name for messages.
//
// - Opens closed standard streams on /dev/null, read-only, so that no output file gets their descriptor and
//   receives terminal output. Writing to these streams fails.
// - Writing to a closed pipe or beyond the file size limit fails instead of ending the program.
// - SIGINT, SIGTERM, SIGHUP and SIGQUIT remove the progress bar, and exit with 128 + the signal, unless they
//   were ignored at the start (nohup).
// - An uncaught exception, such as one on a oneTBB thread that cannot start another thread, prints one line
//   and exits with 2.
void prepare_process(const char* program);

// The message for the user about an exception.
std::string reason_of(const std::exception& error);

// Sets a function that these signals and uncaught exceptions call first, for example to restore the terminal;
// null: none. It must be async-signal-safe.
void call_before_stopping(void (*action)());

// Turns Ctrl-C into a stop request, for long work that must save its results first.
// During its lifetime the first SIGINT, SIGTERM or SIGHUP only sets signal(). The same signal again has its
// previous effect (in both programs: exits). Ignored signals (nohup) stay ignored. Only one object may exist
// at a time.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  int signal() const;  // the last signal received; 0: none
};

}  // namespace edgewise::tools
