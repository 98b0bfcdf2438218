// Turns Ctrl-C into a stop request, for long work that must save its results first.
#pragma once

namespace edgewise::tools {

// During its lifetime the first SIGINT, SIGTERM or SIGHUP only sets signal(). The same signal again has its
// previous effect (in both programs: removes unfinished files and exits). Ignored signals (nohup) stay
// ignored. Only one object may exist at a time.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  int signal() const;  // the last signal received; 0: none
};

}  // namespace edgewise::tools
