// The cores that a process may use: affinity masks and CPU quotas.
#include "support/cores.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "run_program.h"

namespace edgewise::tools {
namespace {

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

TEST_F(Cgroups, OfVersion2HaveTheLeastQuotaOnTheirPath) {
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

TEST_F(Cgroups, OfVersion1HaveTheirQuotaInTheControllersFolder) {
  constexpr const char* kMembership = "5:memory:/a\n4:cpu,cpuacct:/a/b\n3:cpuset:/c\n0::/d\n";
  for (const std::string mount : {"cpu", "cpu,cpuacct"}) {
    write(mount + "/a/b", "cpu.cfs_period_us", "100000\n");
    write(mount + "/a/b", "cpu.cfs_quota_us", "-1\n");
    EXPECT_EQ(quota(kMembership), std::numeric_limits<double>::infinity()) << mount;
    write(mount + "/a/b", "cpu.cfs_quota_us", "300000\n");
    EXPECT_EQ(quota(kMembership), 3.0) << mount;
    std::filesystem::remove_all(folder_.path() / mount);
  }
  // Other controllers' groups have no quota.
  write("cpuset/c", "cpu.max", "100000 100000\n");
  write("memory/a", "cpu.cfs_quota_us", "100000\n");
  EXPECT_EQ(quota(kMembership), std::numeric_limits<double>::infinity());
}

TEST_F(Cgroups, ThatCannotBeReadSetNoQuota) {
  EXPECT_EQ(cpu_quota(folder_.path() / "none", folder_.path()), std::numeric_limits<double>::infinity());
  write("a", "cpu.max", "nonsense\n");
  EXPECT_EQ(quota("0::/a\nno colon\n"), std::numeric_limits<double>::infinity());
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
}

TEST(UsableCores, AreSomeOfTheMachines) {
  EXPECT_GE(usable_cores(), 1);
  EXPECT_LE(usable_cores(), machine_cores());
}

}  // namespace
}  // namespace edgewise::tools
