// Both programs under what a shell and a system can do to them: closed or full streams, signals, limits. What
// is left behind is whole or absent.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "image/image.h"
#include "run_program.h"
#include "temp_dir.h"

namespace edgewise {
namespace {

using testing::Outcome;
using testing::run_program;

const std::string kShortBench = "--scene cube --size 32x32 --quick --benchmark_min_time=0.001 ";

class Process : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  nlohmann::json json(const std::string& name) const {
    return nlohmann::json::parse(file_content(path(name)), nullptr, false);
  }
  TempDir folder_;
};

TEST_F(Process, ClosedStdoutDoesNotRunIntoTheOutputFile) {
  const Outcome verify =
      run_program(EDGEWISE_PROGRAM, "verify cube --size 65x33 --json " + path("v.json") + " >&-");
  EXPECT_EQ(verify.status, 2);
  EXPECT_EQ(verify.err, "edgewise: cannot write to standard output\n");
  EXPECT_EQ(json("v.json").value("ok", false), true);

  const Outcome bench =
      run_program(EDGEWISE_BENCH, kShortBench + "--benchmark_out=" + path("b.json") + " >&-");
  EXPECT_EQ(bench.status, 2);
  EXPECT_NE(bench.err.find("edgewise_bench: cannot write to standard output\n"), std::string::npos);
  EXPECT_TRUE(json("b.json").contains("benchmarks"));
}

TEST_F(Process, AllStreamsClosed) {
  EXPECT_EQ(run_program(EDGEWISE_PROGRAM,
                        "render cube --size 33x21 -o " + path("a.ppm") + " --depth /none/a 0<&- >&- 2>&-")
                .status,
            2);
  EXPECT_EQ(folder_.count(), 0u);
  EXPECT_EQ(
      run_program(EDGEWISE_PROGRAM, "render cube --size 33x21 -o " + path("a.ppm") + " 0<&- >&- 2>&-").status,
      2);
  EXPECT_EQ(read_image(path("a.ppm")).width, 33);
  EXPECT_EQ(
      run_program(EDGEWISE_PROGRAM, "render cube --size 33x21 -o " + path("b.ppm") + " 0<&- 2>&-").status, 0);
}

TEST_F(Process, BenchSaysWhenStdoutIsFull) {
  for (const std::string& arguments :
       {kShortBench, std::string("--help"), std::string("--benchmark_list_tests")}) {
    const Outcome outcome = run_program(EDGEWISE_BENCH, arguments + " >/dev/full");
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_NE(outcome.err.find("edgewise_bench: cannot write to standard output\n"), std::string::npos)
        << arguments;
  }
}

TEST_F(Process, BenchRefusesOneNameTwice) {
  const Outcome outcome =
      run_program(EDGEWISE_BENCH, kShortBench + "--scene cube --benchmark_out=" + path("a"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, "edgewise_bench: --scene cube and --scene cube would both be named 'cube'\n");
  EXPECT_EQ(folder_.count(), 0u);
}

TEST_F(Process, BenchFinishesItsFileWhenNobodyReadsItsTable) {
  const std::string bench = EDGEWISE_BENCH;
  run_program("/bin/sh", "-c '(\"" + bench + "\" " + kShortBench + "--benchmark_out=\"" + path("b.json") +
                             "\"; echo $? >\"" + path("status") + "\") | true'");
  EXPECT_EQ(file_content(path("status")), "2\n");
  EXPECT_TRUE(json("b.json").contains("benchmarks"));
  EXPECT_EQ(folder_.count(), 2u);
}

TEST_F(Process, AFileBeyondTheLimitIsReportedAndNotLeft) {
  const std::string program = EDGEWISE_PROGRAM;
  const Outcome outcome =
      run_program("/bin/sh", "-c 'ulimit -f 64; \"" + program + "\" render cube --size 640x480 -o \"" +
                                 path("a.ppm") + "\"'");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, "edgewise: " + path("a.ppm") + ": cannot be written: File too large\n");
  EXPECT_EQ(folder_.count(), 0u);
}

struct Ending {
  const char* program;
  int signal_number;
};

class Stopped : public ::testing::TestWithParam<Ending> {};

TEST_P(Stopped, LeavesNothingAndTellsTheSignal) {
  const TempDir folder;
  const std::string out = (folder.path() / "out.json").string();
  const std::string option = "--benchmark_out=" + out;
  const bool bench = std::string(GetParam().program) == EDGEWISE_BENCH;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const int null = open("/dev/null", O_WRONLY);
    dup2(null, STDOUT_FILENO);
    dup2(null, STDERR_FILENO);
    for (const int n : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) signal(n, SIG_DFL);
    if (bench)
      execl(EDGEWISE_BENCH, "edgewise_bench", option.c_str(), nullptr);
    else
      execl(EDGEWISE_PROGRAM, "edgewise", "verify", "--full", "--json", out.c_str(), nullptr);
    _exit(99);
  }
  // The temporary file shows that the work has begun.
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (folder.count() == 0 && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(folder.count(), 1u);
  kill(child, GetParam().signal_number);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + GetParam().signal_number);
  EXPECT_EQ(folder.count(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Programs, Stopped,
                         ::testing::Values(Ending{EDGEWISE_PROGRAM, SIGINT},
                                           Ending{EDGEWISE_PROGRAM, SIGQUIT}, Ending{EDGEWISE_BENCH, SIGINT},
                                           Ending{EDGEWISE_BENCH, SIGQUIT}),
                         [](const auto& p) {
                           const bool bench = std::string(p.param.program) == EDGEWISE_BENCH;
                           return std::string(bench ? "Bench" : "Edgewise") +
                                  sigabbrev_np(p.param.signal_number);
                         });

}  // namespace
}  // namespace edgewise
