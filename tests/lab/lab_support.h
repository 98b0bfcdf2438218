// Shared by the tests of the laboratory's families: lookup by name, and a check of the registry against the
// folder.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>

namespace edgewise::lab {

template <typename Methods>
const auto& method_named(const Methods& all, std::string_view name) {
  return *std::find_if(all.begin(), all.end(), [&](const auto& m) { return m.info.name == name; });
}

template <typename Cases>
auto make_case_named(const Cases& all, std::string_view name) {
  return std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; })->make();
}

template <typename Methods>
void expect_folder_registered(std::string_view folder, const Methods& all) {
  std::set<std::string> files, names;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(EDGEWISE_SOURCE_DIR "/src/lab/") +
                                                               std::string(folder)))
    if (entry.path().extension() == ".cpp") files.insert(entry.path().stem());
  for (const auto& m : all) names.emplace(m.info.name);
  EXPECT_EQ(files, names);
}

}  // namespace edgewise::lab
