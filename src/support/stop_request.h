// Ctrl-C as a request: for long work that has something to save first.
#pragma once

namespace edgewise::app {

// While it lives, the first SIGINT, SIGTERM or SIGHUP only asks; a second one of the kind does what it did
// before (in our programs: removes unfinished files and exits). Ignored signals (nohup) stay ignored. One
// object at a time.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  int signal() const;  // the one that asked; 0 if none did
};

}  // namespace edgewise::app
