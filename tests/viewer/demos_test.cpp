// The tutorials' demos: each shows what its texts describe, and the same picture on every machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "run_program.h"
#include "temp_dir.h"
#include "viewer/demos.h"
#include "viewer/viewer_support.h"

namespace edgewise::viewer {
namespace {

Session shown(std::string_view name, Execution execution = {}) {
  Start start = start_of(find_demo(name));
  start.reproducible = true;
  start.execution = execution;
  return Session(std::move(start));
}

const Screen& press(Session& session, std::string_view keys) {
  return type(session, keys, kDemoSize);
}
// Takes the next steps and draws.
const Screen& step(Session& session, std::size_t steps = 1) {
  return press(session, std::string(steps, '5'));
}

TEST(Demos, AreWellFormed) {
  for (const Demo& demo : demos()) {
    EXPECT_EQ(&find_demo(demo.name), &demo);
    for (const Step& step : demo.steps) {
      EXPECT_TRUE(step.notice.ends_with('.') && step.notice.find(". ") == step.notice.npos)
          << "one sentence: " << step.notice;
      EXPECT_LE(step.notice.size(), 80 - std::string_view("1/7 ").size()) << step.notice;
      // No command that saves, quits, or depends on the size of the screen.
      for (const Stroke& stroke : parse_keys(step.keys))
        if (const Key* const key = std::get_if<Key>(&stroke)) {
          EXPECT_LT(command_of(*key).value(), Command::panel) << demo.name << ": " << step.keys;
        }
    }
  }
}

TEST(Demos, LookTheSameOnAllTargetsAndThreads) {
  for (const Demo& demo : demos()) {
    Session first = shown(demo.name, {.threads = 1, .target = SimdTarget::scalar});
    std::vector<Session> others;
    for (const SimdTarget target : supported_targets())
      others.push_back(shown(demo.name, {.threads = 3, .tile_size = 16, .target = target}));
    for (std::size_t i = 0; i < demo.steps.size(); ++i) {
      const Screen& expected = step(first);
      for (Session& other : others)
        EXPECT_EQ(step(other).picture.pixels, expected.picture.pixels) << demo.name << ", step " << i;
    }
  }
}

TEST(Demos, AStepShowsTheSameAfterOtherKeys) {
  Session straight = shown("p5js-clipping"), strayed = shown("p5js-clipping");
  step(straight, 2);
  step(strayed);
  press(strayed, "<float_lt>wwd1r<1>");
  EXPECT_EQ(step(strayed, 2).picture.pixels, step(straight).picture.pixels);
  EXPECT_EQ(strayed.state().step, 3u);
  const Image back = press(strayed, "8").picture;
  EXPECT_EQ(press(strayed, "85").picture.pixels, back.pixels);
  for (const auto& [keys, step] : {std::pair("8888", 1u), {"55555555555", 7u}}) {
    press(strayed, keys);
    EXPECT_EQ(strayed.state().step, step);
    EXPECT_EQ(strayed.state().message, "there is no further step");
  }
}

// What the steps' sentences say.
TEST(Pico8Culling, SwitchesFrontAndBackFacesSeparately) {
  Session demo = shown("pico8-culling");
  std::uint64_t drawn[5];
  for (std::uint64_t& n : drawn) {
    step(demo);
    n = demo.side(0).stats.emitted;
  }
  EXPECT_EQ(drawn[0], 12u);
  EXPECT_LE(drawn[1], 6u);
  EXPECT_NEAR(static_cast<double>(drawn[1] + drawn[2]), 12.0, 4.0);  // the object rotates
  EXPECT_TRUE(demo.side(0).choice.ours());
  EXPECT_TRUE(demo.side(0).cull_front && demo.side(1).cull_back);
  EXPECT_EQ(drawn[4] + demo.side(1).stats.emitted, 12u);
  EXPECT_FALSE(demo.side(1).choice.fills());
}

TEST(Pico8InsideTest, CountsGapsAndDoubleHitsAndCullsByWinding) {
  Session demo = shown("pico8-inside-test");
  for (const bool gaps : {false, true}) {
    step(demo);
    const Judgement& found = demo.side(0).judgement.value();
    EXPECT_GT((gaps ? found.gaps : found.double_hits).value(), 150u);
    EXPECT_EQ((gaps ? found.double_hits : found.gaps).value(), 0u);
  }
  for (const auto& [culls, right] : {std::pair(false, false), {true, true}, {false, true}, {false, false}}) {
    step(demo);
    EXPECT_EQ(demo.side(1).cull_back, culls);
    EXPECT_EQ(demo.side(1).judgement->wrong < 10000, right);
  }
  EXPECT_NE(demo.state().message.find("wrong pixel"), std::string::npos);
}

TEST(P5jsClipping, ClipsMovesRotatesAndReturnsToTheStart) {
  Session demo = shown("p5js-clipping");
  step(demo);
  EXPECT_GT(demo.side(0).stats.clipped_near, 0u);
  EXPECT_LT(demo.side(0).judgement->wrong, 100u);
  const auto outlines = [](const Screen& screen) {
    return std::ranges::count(screen.picture.pixels, kPiecesOutline);
  };
  const auto at_first = outlines(step(demo));
  EXPECT_GT(at_first, 1000);
  EXPECT_TRUE(press(demo, "").labels.empty());
  EXPECT_GE(step(demo).labels.size(), 16u);
  step(demo, 3);
  EXPECT_GT(std::abs(demo.state().angle), 0.5f);
  const auto at_last = outlines(step(demo));
  EXPECT_EQ(demo.state().angle, 0.0f);
  EXPECT_NEAR(static_cast<double>(at_last), static_cast<double>(at_first), 1000.0);
}

TEST(RealbasicBackface, CullsFacesAndWholeObjectsButNoTwoSidedFace) {
  Session demo = shown("realbasic-backface");
  // Unlit, so that a face has its colour.
  const auto sheets = [&] {
    step(demo);
    EXPECT_EQ(demo.side(0).judgement->wrong, 0u);
    const auto pixels = std::ranges::count(press(demo, "k").picture.pixels, rgb(230, 230, 230));
    press(demo, "k");
    return pixels;
  };
  const auto one = sheets();
  const FrontendStats stats = demo.side(0).stats;
  EXPECT_GE(stats.meshes_culled, 4u);
  EXPECT_GT(stats.culled, 10u);
  EXPECT_GT(stats.clipped_near, 0u);
  EXPECT_GT(one, 1000);
  EXPECT_GT(sheets(), one * 3 / 2);
  EXPECT_FALSE(step(demo).labels.empty());
  EXPECT_NE(summary_of(demo.side(0).faces).find("culled with their object"), std::string::npos);
}

TEST(OutlawTriad, CullsAboutHalfOfTheQuads) {
  Session demo = shown("outlaw-triad");
  for (const std::size_t steps : {3u, 1u}) {
    step(demo, steps);
    EXPECT_LE(demo.side(0).stats.emitted, demo.side(1).stats.emitted * 6 / 10);
    EXPECT_EQ(demo.side(1).stats.culled, 0u);
    EXPECT_EQ(demo.side(0).choice.fills(), steps == 3);
    EXPECT_TRUE(steps == 1 || demo.side(0).judgement->wrong == 0u);
  }
}

TEST(DemoCommand, ListsDemosAndTheirSteps) {
  const auto run = [](const std::string& words) {
    return testing::run_program(EDGEWISE_PROGRAM, "demo " + words).out;
  };
  const std::string list = run("");
  const auto json = nlohmann::json::parse(run("--json"));
  ASSERT_EQ(json.size(), demos().size());
  for (std::size_t i = 0; i < demos().size(); ++i) {
    const Demo& demo = demos()[i];
    const std::string name(demo.name);
    EXPECT_NE(list.find(name), std::string::npos);
    EXPECT_EQ(json[i].at("steps").back().at("notice"), demo.steps.back().notice);
    EXPECT_EQ(nlohmann::json::parse(run(name + " --json")), nlohmann::json::array({json[i]}));
    EXPECT_NE(run(name).find(demo.steps.front().notice), std::string::npos) << demo.name;
  }
}

TEST(DemoCommand, WritesAPictureOrAnAnimation) {
  const TempDir folder;
  const std::string there = folder.path().string();
  const auto write = [&](const std::string& words) {
    const auto outcome = testing::run_program(EDGEWISE_PROGRAM, "demo pico8-culling --size 320x180 " + words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_EQ(write("-o " + there + "/"), there + "/pico8-culling.png\n");
  write("-o " + there + "/again.png --threads 1 --target scalar");
  EXPECT_EQ(file_content(there + "/pico8-culling.png"), file_content(there + "/again.png"));
  EXPECT_EQ(read_image(there + "/again.png").width, 320);
  write("--frames 7 -o " + there + "/film/");
  std::set<std::string> different;
  for (const auto& file : std::filesystem::directory_iterator(there + "/film"))
    different.insert(file_content(file.path()));
  EXPECT_GE(different.size(), 5u);
  EXPECT_LE(different.size(), 7u);
}

}  // namespace
}  // namespace edgewise::viewer
