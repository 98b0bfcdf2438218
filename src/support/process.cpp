#include "support/process.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <new>
#include <string_view>
#include <system_error>

#include "support/console.h"
#include "support/progress.h"

namespace edgewise::tools {

namespace {

std::atomic<void (*)()> before_stopping{nullptr};
static_assert(decltype(before_stopping)::is_always_lock_free);

extern "C" void stop(int signal) {
  if (void (*const action)() = before_stopping) action();
  erase_progress_on_signal();
  _exit(128 + signal);
}

const char* program_name = "";

[[noreturn]] void give_up() {
  // If several threads fail at once, only the first one prints and ends the process.
  static std::atomic_flag begun;
  while (begun.test_and_set()) pause();
  if (void (*const action)() = before_stopping) action();
  erase_progress_on_signal();
  try {
    if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::exception& error) {
    print_error(reason_of(error), program_name);
  } catch (...) {
  }
  _exit(2);
}

// open() returns the lowest free descriptor, which is that of the closed stream.
void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF && open("/dev/null", O_RDONLY) != stream) _exit(2);
}

}  // namespace

void call_before_stopping(void (*action)()) {
  before_stopping = action;
}

std::string reason_of(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return "out of memory";
  const std::string_view what = error.what();
  const auto* const system = dynamic_cast<const std::system_error*>(&error);  // thrown by std::thread
  const bool again = system != nullptr && system->code() == std::errc::resource_unavailable_try_again;
  if (again || what.starts_with("pthread_create"))
    return "no more threads can be started; use fewer, or raise the limits on memory or processes";
  return std::string(what);
}

void prepare_process(const char* program) {
  program_name = program;
  std::set_terminate(give_up);
  occupy_closed_streams();
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
    if (std::signal(signal, stop) == SIG_IGN) std::signal(signal, SIG_IGN);
}

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
