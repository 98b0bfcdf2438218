// What both programs need of the system before they do anything.
#pragma once

#include <exception>
#include <string>

namespace edgewise::app {

// To be called first in main(), with the program's name for messages.
//
// Closed standard streams are occupied, so that no file of ours gets their number and is written into by what
// is meant for the terminal; writing to them fails. Writes into a closed pipe or beyond the largest file
// allowed fail too, instead of ending the program. SIGINT, SIGTERM, SIGHUP and SIGQUIT remove unfinished
// files and the progress bar, and exit with 128 + the signal, unless they were ignored (nohup). What nobody
// can catch, since it is thrown on a thread of oneTBB's that cannot start another one, is said in one line
// like other failures, and exits with 2.
void prepare_process(const char* program);

// What to tell the user of an exception.
std::string reason_of(const std::exception& error);

// Has those signals call something first that puts right what the program has done to its surroundings; null:
// nothing more. It must be async-signal-safe.
void call_before_stopping(void (*action)());

}  // namespace edgewise::app
