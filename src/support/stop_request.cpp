#include "support/stop_request.h"

#include <signal.h>

#include <array>
#include <atomic>
#include <cstddef>

namespace edgewise::tools {

namespace {

constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
std::array<struct sigaction, kSignals.size()> before;
std::atomic<int> requested = 0;
static_assert(std::atomic<int>::is_always_lock_free);

void restore(std::size_t i) {
  if (before[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &before[i], nullptr);
}

extern "C" void request_stop(int signal) {
  requested = signal;
  for (std::size_t i = 0; i < kSignals.size(); ++i)
    if (kSignals[i] == signal) restore(i);
}

}  // namespace

StopRequest::StopRequest() {
  requested = 0;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before[i]);
    if (before[i].sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = request_stop;
    action.sa_flags = SA_RESTART;
    sigaction(kSignals[i], &action, nullptr);
  }
}

StopRequest::~StopRequest() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) restore(i);
}

int StopRequest::signal() const {
  return requested;
}

}  // namespace edgewise::tools
