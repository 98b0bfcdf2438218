// The cores that a process may use, names of machines, values of options, external text on the terminal and
// in JSON, and uncaught exceptions. invalid_inputs.h tests signals, streams and limits.
#include <gtest/gtest.h>
#include <sched.h>

#include <filesystem>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>

#include "run_program.h"
#include "support/console.h"
#include "support/cores.h"
#include "support/json.h"
#include "support/machine.h"
#include "support/options.h"
#include "support/process.h"

namespace edgewise::tools {
namespace {

// ---- Cores: affinity masks and CPU quotas

using testing::Outcome;

class Cgroups : public ::testing::Test {
 protected:
  double quota(std::string_view membership) const {
    return cpu_quota(folder_.write("membership", membership), folder_.path());
  }
  void write(const std::string& group, const std::string& name, const std::string& content) const {
    std::filesystem::create_directories(folder_.path() / group);
    folder_.write(group + "/" + name, content);
  }

  TempDir folder_;
};

TEST_F(Cgroups, HaveTheLeastQuotaOnTheirPath) {
  EXPECT_EQ(quota("0::/\n"), std::numeric_limits<double>::infinity());
  write("a/b", "cpu.max", "max 100000\n");
  EXPECT_EQ(quota("0::/a/b\n"), std::numeric_limits<double>::infinity());
  write("a", "cpu.max", "150000 100000\n");
  EXPECT_EQ(quota("0::/a/b\n"), 1.5);
  write("a/b", "cpu.max", "20000 10000\n");
  EXPECT_EQ(quota("0::/a/b\n"), 1.5);
  EXPECT_EQ(quota("0::/other\n"), std::numeric_limits<double>::infinity());
  // In a container, the root is its own group.
  write(".", "cpu.max", "50000 100000\n");
  EXPECT_EQ(quota("0::/../../other\n"), 0.5);
}

TEST_F(Cgroups, ThatCannotBeReadSetNoQuota) {
  EXPECT_EQ(cpu_quota(folder_.path() / "none", folder_.path()), std::numeric_limits<double>::infinity());
  write("a", "cpu.max", "nonsense\n");
  EXPECT_EQ(quota("4:cpu,cpuacct:/a\n0::/a\nno colon\n"), std::numeric_limits<double>::infinity());
}

// The first core that this process may use, as a list for taskset.
std::string a_core() {
  cpu_set_t mask;
  if (sched_getaffinity(0, sizeof mask, &mask) != 0) return "0";
  std::size_t core = 0;
  while (core < CPU_SETSIZE - 1 && !CPU_ISSET(core, &mask)) ++core;
  return std::to_string(core);
}

Outcome on_one_core(const std::string& arguments) {
  return testing::run_program("taskset", "-c " + a_core() + " '" EDGEWISE_PROGRAM "' " + arguments);
}

TEST(UsableCores, AreThoseOfTheAffinityMask) {
  const TempDir folder;
  const std::string picture = (folder.path() / "a.png").string();
  const Outcome drawn = on_one_core("render cube --size 32x32 --json -o " + picture);
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_EQ(nlohmann::json::parse(drawn.out).at("threads"), 1);

  const auto machine = nlohmann::json::parse(on_one_core("machine").out);
  EXPECT_EQ(machine.at("usable_cores"), 1);
  EXPECT_EQ(machine.at("cores"), machine_cores());
  const std::string name = on_one_core("machine --name").out;
  const std::string expected =
      machine_cores() == 1 ? "-1-core\n" : "-1-of-" + std::to_string(machine_cores()) + "-cores\n";
  EXPECT_TRUE(name.ends_with(expected)) << name;
  EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-\n"), std::string::npos) << name;
}

// ---- Names of machines

// Results of different machines must not share a folder.
TEST(CpuModel, DistinguishesCpusOfTheSameName) {
  TempDir folder;
  const auto model_of = [&](const std::string& name, const std::string& more) {
    const std::string path = (folder.path() / "cpuinfo").string();
    std::ofstream(path) << "processor\t: 0\n" + more + "model name\t: " + name + "\nstepping\t: 1\n";
    return cpu_model(path);
  };
  EXPECT_EQ(model_of("AMD EPYC", "cpu family\t: 25\nmodel\t\t: 17\n"), "AMD EPYC (family 25, model 17)");
  EXPECT_EQ(model_of("Intel(R) Xeon(R) Processor", "cpu family\t: 6\nmodel\t\t: 207\n"),
            "Intel Xeon (family 6, model 207)");
  EXPECT_EQ(model_of("", "CPU implementer\t: 0x41\nCPU part\t: 0xd0c\n"),
            "ARM (implementer 0x41, part 0xd0c)");
  EXPECT_EQ(cpu_model((folder.path() / "missing").string()), "unknown");
}

// ---- Values of options

TEST(OptionValues, OfAnotherFormOrOutOfRangeAreRefused) {
  for (const auto text :
       {"", "5", "-4x5", "16385x5", "4294967297x5", "99999999999999999999x5", "5x5x5", "5.5x5"})
    EXPECT_THROW(parse_size("", text), std::invalid_argument) << text;
  for (const auto text : {"", "0", "257", "1.5", "1e2", "nan", "99999999999999999999"})
    EXPECT_THROW(parse_number("", text, 1, 256), std::invalid_argument) << text;
  for (const auto text : {"18446744073709551616", "-1"})
    EXPECT_THROW(parse_number<std::uint64_t>("", text, 0, ~std::uint64_t{0}), std::invalid_argument) << text;
  for (const auto text : {"", "1,2", "1,2,3,4", "1,2,inf", "1,nan,3", "1,2,1e400"})
    EXPECT_THROW(parse_vector("", text), std::invalid_argument) << text;
  for (const auto text : {"", "20", "nans", "0s", "-1m", "1e9h"})
    EXPECT_THROW(parse_duration("", text), std::invalid_argument) << text;
  for (const auto& [text, seconds] : {std::pair{"90s", 90.0}, {"20m", 1200.0}, {"1.5h", 5400.0}})
    EXPECT_EQ(parse_duration("", text), seconds);
}

// ---- External text

TEST(Printable, ReplacesControlCharactersAndBytesThatAreNotUtf8) {
  for (const std::string text : {"", "plain ~", "\u00e9\u03c9\u4e2d\U0001F600", "\U0010FFFF"})
    EXPECT_EQ(printable(text), text);
  EXPECT_EQ(printable("a\x1b[31mb\n\r\t\x7f"), "a?[31mb????");
  EXPECT_EQ(printable("a\u009b31m", ' '), "a 31m");  // a control sequence in one character
  EXPECT_EQ(printable("a\u202eb\u2066"), "a?b?");    // writing direction
  EXPECT_EQ(printable("\xff\x80z"), "??z");
  EXPECT_EQ(printable("\xc0\xaf"), "??");              // overlong encoding of '/'
  EXPECT_EQ(printable("\xed\xa0\x80"), "???");         // a surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????");    // beyond Unicode
  EXPECT_EQ(printable("\xe4\xb8z\xe4\xb8"), "??z??");  // incomplete in the middle
}

TEST(Printable, CutsBetweenCharacters) {
  EXPECT_EQ(printable_within("\u00e9\u00e9\u00e9\u00e9", 4), "\u00e9\u00e9\u00e9\u00e9");
  EXPECT_EQ(printable_within("\u00e9\u00e9\u00e9\u00e9\u00e9", 4), "\u00e9\u00e9..");
  EXPECT_EQ(printable_within("abc", 1), ".");
}

TEST(JsonText, AcceptsAnyBytes) {
  const nlohmann::json json{{"name", "a\xff"}};
  EXPECT_EQ(nlohmann::json::parse(json_text(json)).at("name"), "a\xef\xbf\xbd");
}

// ---- Uncaught exceptions

template <typename Error>
void throw_on_a_thread(const Error& error) {
  prepare_process("edgewise");
  std::thread([&] { throw error; }).join();
}

// oneTBB throws like this if one of its threads cannot start another.
TEST(ProcessDeathTest, PrintsAnUncaughtExceptionInOneLine) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(throw_on_a_thread(std::runtime_error("pthread_create has failed: Resource unavailable")),
              ::testing::ExitedWithCode(2), "^edgewise: no more threads can be started; use fewer.*\n$");
  EXPECT_EXIT(throw_on_a_thread(std::bad_alloc()), ::testing::ExitedWithCode(2),
              "^edgewise: out of memory\n$");
}

}  // namespace
}  // namespace edgewise::tools
