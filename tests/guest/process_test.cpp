// The process belongs to the program that calls the library: a draw leaves it as it was, forked children draw
// right, and threads may draw while it ends.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <clocale>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <locale>
#include <string>
#include <thread>
#include <vector>

#include "edgewise/barycentrics.h"
#include "edgewise/builtin.h"
#include "edgewise/draw.h"
#include "edgewise/edgewise.h"
#include "edgewise/hash.h"
#include "float_modes.h"

namespace edgewise {
namespace {

constexpr int kWidth = 320, kHeight = 240;

const Drawable& triangles() {
  static const auto& made = *new Drawable(find_scene("medium").make({kWidth, kHeight, 0.0f, 0.2}));
  return made;
}

class Guest {
 public:
  std::uint64_t draw(int threads) {
    const FrontendOptions options{
        .width = kWidth, .height = kHeight, .cull = Cull::none, .payload = Payload::id};
    const Execution execution{.threads = threads};
    edgewise::draw(drawable_, frontend_, options, *backend_, frame_.view(), {}, execution);
    std::vector<float> uv(2 * kWidth * kHeight);
    barycentrics(frame_, drawable_, options, {uv.data(), 2 * kWidth}, execution);
    return hash_of(frame_);
  }

 private:
  Drawable drawable_ = triangles();
  Frontend frontend_;
  std::unique_ptr<Backend> backend_ = find_backend("tiled").make();
  Framebuffer frame_ = Framebuffer(kWidth, kHeight);
};

// A line for each thing that a program may have set.
std::vector<std::string> state_of_the_process() {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& name, auto... values) {
    lines.push_back(name);
    ((lines.back() += ' ', lines.back() += std::to_string(values)), ...);
  };
  using tbb::global_control;
  for (const auto limit : {global_control::max_allowed_parallelism, global_control::thread_stack_size})
    add("oneTBB's limit", global_control::active_value(limit));
  sigset_t blocked;
  pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
  for (int signal = 1; signal <= 64; ++signal) {
    struct sigaction action {};  // stays empty for those that the C library keeps
    sigaction(signal, nullptr, &action);
    add("signal", signal, reinterpret_cast<std::uintptr_t>(action.sa_handler), action.sa_flags,
        sigismember(&blocked, signal));
  }
  lines.push_back(std::string("locale ") + std::setlocale(LC_ALL, nullptr) + " " + std::locale().name());
  for (const unsigned part : testing::float_state()) add("floats", part);
  const mode_t mask = umask(0);
  umask(mask);
  add("umask", mask);
  lines.push_back("folder " + std::filesystem::current_path().string());
  for (char** variable = environ; *variable != nullptr; ++variable) lines.emplace_back(*variable);
  for (int resource = 0; resource < 16; ++resource) {
    rlimit limit{};
    getrlimit(static_cast<__rlimit_resource>(resource), &limit);
    add("limit", resource, limit.rlim_cur, limit.rlim_max);
  }
  for (int descriptor = 0; descriptor < 256; ++descriptor)
    if (fcntl(descriptor, F_GETFD) != -1) add("descriptor", descriptor);
  return lines;
}

TEST(Process, IsAsItWasAfterDraws) {
  const auto before = state_of_the_process();
  Guest guest;
  for (const int threads : {1, 2, 3, 64}) {
    guest.draw(threads);
    EXPECT_EQ(state_of_the_process(), before) << threads << " threads";
  }
}

// Forks, calls f() in the child, and returns the child's status; that of SIGALRM if f() hangs.
template <typename F>
int status_of_child(F&& f) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(30);
    std::exit(f() ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return status;
}

TEST(ProcessFork, AChildDrawsWhileAThreadOfItsParentDraws) {
  Guest idle;
  const std::uint64_t expected = idle.draw(2);
  std::atomic<bool> done{false};
  std::thread other([&] {
    Guest busy;
    while (!done) busy.draw(2);
  });
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(status_of_child([&] { return Guest().draw(2) == expected; }), 0) << "objects of its own";
    EXPECT_EQ(status_of_child([&] { return idle.draw(3) == expected; }), 0) << "its parent's, idle ones";
    EXPECT_EQ(status_of_child([&] { return status_of_child([&] { return idle.draw(2) == expected; }) == 0; }),
              0);
  }
  done = true;
  other.join();
}

TEST(ProcessExit, ThreadsAndExitHandlersMayDrawMeanwhile) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  for (int i = 0; i < 5; ++i)
    EXPECT_EXIT(
        {
          std::atexit([] {
            Guest().draw(5);
            if (edgewise_new_renderer("one more", nullptr) == EDGEWISE_OK)
              std::abort();  // the thread's error text
          });
          edgewise_new_renderer("a name that is longer than a short string", nullptr);
          for (int threads = 2; threads < 5; ++threads)
            std::thread([=] {
              for (Guest guest;;) guest.draw(threads);
            }).detach();
          Guest().draw(5);
          std::this_thread::sleep_for(std::chrono::milliseconds(i));
          std::exit(7);
        },
        ::testing::ExitedWithCode(7), "^$");
}

}  // namespace
}  // namespace edgewise
