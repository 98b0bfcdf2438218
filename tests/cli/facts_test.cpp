// Facts (errors, needs, pixels that are not portable) are the same on any number of threads, and are those of
// results/facts/. tests/process/emulated_cpu_test.cpp shows it for other SIMD targets.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/accuracy/accuracy.h"
#include "run_program.h"
#include "temp_dir.h"

namespace edgewise::tools {
namespace {

using nlohmann::json;

// The program's output, the same on 1 and 3 threads.
std::string facts(const std::string& arguments) {
  const auto one = testing::run_program(EDGEWISE_PROGRAM, arguments + " --threads 1");
  const auto three = testing::run_program(EDGEWISE_PROGRAM, arguments + " --threads 3");
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(one.out, three.out) << arguments;
  return one.out;
}

json committed(const std::string& name) {
  const std::string path = EDGEWISE_SOURCE_DIR "/results/facts/" + name + ".json";
  const std::string text = file_content(path);
  EXPECT_FALSE(text.empty()) << path << " is missing";
  return json::parse(text);
}

// The first entry of `list` whose values under the keys are those of `like`.
json entry(const json& list, const json& like, std::initializer_list<const char*> keys) {
  for (const json& one : list)
    if (std::ranges::all_of(keys, [&](const char* key) { return one.at(key) == like.at(key); })) return one;
  ADD_FAILURE() << "results/facts/ lacks " << like.dump().substr(0, 200);
  return {};
}

// scripts/publish leaves out what no report reads. All that it keeps must be there, in its place.
void expect_kept(const json& made, const json& published) {
  const json all = made.flatten(), kept = published.flatten();
  for (const auto& [place, value] : kept.items())
    ASSERT_EQ(all.value(place, json()).dump(), value.dump()) << place;
}

TEST(Facts, OfSmallScenesAreThoseOfTheResults) {
  std::string arguments = "accuracy --json -";
  for (const lab::LabScene& scene : lab::lab_scenes(false))
    if (scene.smallest) arguments += " " + scene.name;
  const json all = json::parse(facts(arguments)), expected = committed("accuracy");
  expect_kept(all.at("methods"), expected.at("methods"));
  for (const auto& [key, value] : all.items()) EXPECT_TRUE(expected.contains(key)) << key;
  for (const json& scene : all.at("scenes"))
    expect_kept(scene, entry(expected.at("scenes"), scene, {"family", "name"}));
}

TEST(Facts, OfSweepsAreThoseOfTheResults) {
  const json expected = committed("stability");
  for (const json& sweep : json::parse(facts("stability legs cycle vertex_w --json -")).at("sweeps"))
    EXPECT_EQ(sweep.dump(), entry(expected.at("sweeps"), sweep, {"name"}).dump());
}

TEST(Facts, OfNeedsAndPortablePixelsAreThoseOfTheResults) {
  const json needs = json::parse(facts("needs cubes --frames 12 --size 640x360 --tolerance 230 --json")),
             portable = json::parse(facts("portable cube --json"));
  expect_kept(needs, entry(committed("needs"), needs, {"scene", "width", "frames"}));
  EXPECT_EQ(portable.dump(),
            entry(committed("portable"), portable, {"scene", "width", "subpixel_bits"}).dump());
}

}  // namespace
}  // namespace edgewise::tools
