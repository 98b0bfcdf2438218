// The command `edgewise stability`: list, tables and JSON.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "cli/stability/report.h"
#include "lab/sweeps/sweeps.h"
#include "run_program.h"
#include "temp_dir.h"

namespace edgewise::tools {
namespace {

using testing::Outcome;

Outcome stability(const std::string& arguments) {
  return testing::run_program(EDGEWISE_PROGRAM, "stability " + arguments);
}

TEST(StabilityCommand, ListsAllSweeps) {
  const Outcome outcome = stability("--list");
  EXPECT_EQ(outcome.status, 0);
  for (const lab::Sweep& sweep : lab::sweeps())
    EXPECT_NE(outcome.out.find(std::string(sweep.name) + ' '), std::string::npos) << sweep.name;
}

TEST(StabilityCommand, TableAndJsonHaveTheSameResults) {
  const TempDir folder;
  const std::string path = (folder.path() / "stability.json").string();
  const Outcome table = stability("cycle legs_on_our_grid --quick --json '" + path + "'");
  ASSERT_EQ(table.status, 0) << table.err;
  EXPECT_EQ(table.err, "") << "no progress bar where there is no terminal";
  EXPECT_LT(table.out.find("cycle (visibility)"), table.out.find("legs_on_our_grid (coverage)"));
  EXPECT_TRUE(std::regex_search(table.out, std::regex("\nfixed_8_int32 +182 "))) << table.out;
  // 3 / 39,442: the fewest edge crossings at a value.
  EXPECT_TRUE(std::regex_search(table.out, std::regex("\nfixed_8 +never +< 76\n"))) << table.out;

  const auto json = nlohmann::json::parse(file_content(path));
  ASSERT_EQ(json.at("sweeps").size(), 2u);
  EXPECT_EQ(json["sweeps"][1], sweep_json(run_sweep(lab::find_sweep("legs_on_our_grid"), lab::kQuick, 1)));
  EXPECT_EQ(nlohmann::json::parse(stability("cycle legs_on_our_grid --quick --json -").out).at("sweeps"),
            json["sweeps"]);
}

}  // namespace
}  // namespace edgewise::tools
