// What both programs need of the system before they do anything.
#pragma once

namespace edgewise::app {

// To be called first in main().
//
// Closed standard streams are occupied, so that no file of ours gets their number and is written into by what
// is meant for the terminal; writing to them fails. Writes into a closed pipe or beyond the largest file
// allowed fail too, instead of ending the program. SIGINT, SIGTERM, SIGHUP and SIGQUIT remove unfinished
// files and the progress bar, and exit with 128 + the signal, unless they were ignored (nohup).
void prepare_process();

// Has those signals call something first that puts right what the program has done to its surroundings; null:
// nothing more. It must be async-signal-safe.
void call_before_stopping(void (*action)());

}  // namespace edgewise::app
