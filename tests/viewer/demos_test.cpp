// The tutorials' demos: each shows what its texts describe, and the same picture on every machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "message_of.h"
#include "run_program.h"
#include "temp_dir.h"
#include "viewer/demos.h"
#include "viewer/viewer_support.h"

namespace edgewise::viewer {
namespace {

class Shown {
 public:
  explicit Shown(std::string_view name, Execution execution = {}) : demo_(find_demo(name)) {
    Start start = start_of(demo_);
    start.reproducible = true;
    start.execution = execution;
    session_.emplace(std::move(start));
  }
  // Takes the next steps and draws.
  const Screen& step(std::size_t steps = 1) {
    for (std::size_t i = 0; i < steps; ++i) type("5");
    return session_->draw(kDemoSize);
  }
  const Screen& type(std::string_view keys) { return viewer::type(*session_, keys, kDemoSize); }
  const Side& side(std::size_t i) const { return session_->side(i); }
  const State& state() const { return session_->state(); }

 private:
  const Demo& demo_;
  std::optional<Session> session_;
};

TEST(Demos, AreWellFormed) {
  std::set<std::string_view> names;
  for (const Demo& demo : demos()) {
    EXPECT_TRUE(names.insert(demo.name).second) << demo.name;
    EXPECT_EQ(&find_demo(demo.name), &demo);
    EXPECT_GE(demo.steps.size(), 3u) << demo.name;
    for (const Step& step : demo.steps) {
      EXPECT_TRUE(step.notice.ends_with('.') && step.notice.find(". ") == step.notice.npos)
          << "one sentence: " << step.notice;
      EXPECT_LE(step.notice.size(), 80 - std::string_view("1/7 ").size()) << step.notice;
      // No command that saves, quits, or depends on the size of the screen.
      for (const Stroke& stroke : parse_keys(step.keys))
        if (const Key* const key = std::get_if<Key>(&stroke)) {
          const auto command = command_of(*key);
          EXPECT_FALSE(command == Command::save || command == Command::quit || command == Command::help ||
                       command == Command::next_step)
              << demo.name << ": " << step.keys;
        }
    }
  }
  EXPECT_EQ(names.size(), 5u);
  EXPECT_NE(message_of([] { find_demo("outlaw"); }).find("did you mean 'outlaw-triad'"), std::string::npos);
}

TEST(Demos, LookTheSameOnAllTargetsAndThreads) {
  std::uint64_t compared = 0;
  for (const Demo& demo : demos()) {
    Shown first(demo.name, {.threads = 1, .target = SimdTarget::scalar});
    std::vector<Shown> others;
    for (const SimdTarget target : supported_targets())
      others.emplace_back(demo.name, Execution{.threads = 3, .tile_size = 16, .target = target});
    for (std::size_t i = 0; i < demo.steps.size(); ++i) {
      const Screen& expected = first.step();
      for (Shown& other : others) {
        EXPECT_EQ(other.step().picture.pixels, expected.picture.pixels) << demo.name << ", step " << i;
        ++compared;
      }
    }
  }
  RecordProperty("comparisons", std::to_string(compared));
}

TEST(Demos, AStepShowsTheSameAfterOtherKeys) {
  Shown straight("p5js-clipping"), strayed("p5js-clipping");
  straight.step(2);
  strayed.step();
  strayed.type("<float_lt>wwd1r<1>");
  EXPECT_EQ(strayed.step(2).picture.pixels, straight.step().picture.pixels);
  EXPECT_EQ(strayed.state().step, 3u);
  EXPECT_EQ(strayed.type("8").picture.pixels, strayed.type("85").picture.pixels);
}

TEST(Pico8Culling, SwitchesFrontAndBackFacesSeparately) {
  Shown demo("pico8-culling");
  const auto drawn = [&] { return demo.side(0).stats.emitted; };
  demo.step();
  EXPECT_FALSE(demo.side(0).cull_front || demo.side(0).cull_back);
  EXPECT_EQ(demo.side(0).choice.coverage->info.name, "wireframe");
  EXPECT_EQ(drawn(), 12u);
  demo.step();
  EXPECT_TRUE(!demo.side(0).cull_front && demo.side(0).cull_back);
  EXPECT_LE(drawn(), 6u);
  const std::uint64_t survive = drawn();
  demo.step();
  EXPECT_TRUE(demo.side(0).cull_front && !demo.side(0).cull_back);
  EXPECT_NEAR(static_cast<double>(drawn()), static_cast<double>(12 - survive), 4.0);  // the object rotates
  demo.step();
  EXPECT_TRUE(demo.side(0).choice.ours());
  demo.step();
  EXPECT_TRUE(demo.side(0).cull_front && demo.side(1).cull_back);
  EXPECT_EQ(demo.side(0).stats.emitted + demo.side(1).stats.emitted, 12u);
  EXPECT_EQ(demo.side(1).choice.coverage->info.name, "wireframe");
}

TEST(Pico8InsideTest, CountsGapsAndDoubleHitsAndCullsByWinding) {
  Shown demo("pico8-inside-test");
  demo.step();
  EXPECT_GT(demo.side(0).judgement->double_hits.value(), 150u);
  EXPECT_EQ(demo.side(0).judgement->gaps.value(), 0u);
  demo.step();
  EXPECT_GT(demo.side(0).judgement->gaps.value(), 150u);
  EXPECT_EQ(demo.side(0).judgement->double_hits.value(), 0u);
  const auto wrong_on_the_right = [&] {
    demo.step();
    return demo.side(1).judgement->wrong;
  };
  EXPECT_GT(wrong_on_the_right(), 10000u);
  EXPECT_FALSE(demo.side(1).cull_front || demo.side(1).cull_back);
  EXPECT_EQ(wrong_on_the_right(), 0u);
  EXPECT_TRUE(demo.side(1).cull_back);
  EXPECT_EQ(wrong_on_the_right(), 0u);
  EXPECT_FALSE(demo.side(1).cull_back);
  EXPECT_GT(wrong_on_the_right(), 10000u);
  EXPECT_TRUE(demo.state().magnifier);
  EXPECT_NE(demo.state().message.find("wrong pixel"), std::string::npos);
}

TEST(P5jsClipping, ClipsMovesRotatesAndReturnsToTheStart) {
  Shown demo("p5js-clipping");
  demo.step();
  const lab::StageMethods& choice = demo.side(0).choice;
  EXPECT_EQ(describe(choice), "screen_edges + painter_mean");
  EXPECT_GT(demo.side(0).stats.clipped_near, 0u);
  EXPECT_LT(demo.side(0).judgement->wrong, 100u);
  const auto count = [](const Screen& screen, std::uint32_t colour) {
    return std::count(screen.picture.pixels.begin(), screen.picture.pixels.end(), colour);
  };
  const auto outlines = count(demo.step(), kPiecesOutline);
  EXPECT_GT(outlines, 1000);
  EXPECT_TRUE(demo.type("").labels.empty());
  EXPECT_GE(demo.step().labels.size(), 16u);
  EXPECT_EQ(demo.state().axis, glm::vec3(1.0f));
  demo.step();
  EXPECT_TRUE(demo.state().along_view);
  demo.step();
  EXPECT_FALSE(demo.state().along_view);
  demo.step();
  EXPECT_GT(std::abs(demo.state().angle), 0.5f);
  const Screen& last = demo.step();
  EXPECT_EQ(demo.state().angle, 0.0f);
  EXPECT_EQ(count(last, kPiecesOutline) > 1000, true);
}

TEST(RealbasicBackface, CullsFacesAndWholeObjectsButNoTwoSidedFace) {
  constexpr std::uint32_t kSheet = rgb(230, 230, 230);
  Shown demo("realbasic-backface");
  // Unlit, so that a face has its colour.
  const auto sheets = [&](const Screen& screen) {
    return std::count(screen.picture.pixels.begin(), screen.picture.pixels.end(), kSheet);
  };
  demo.step();
  EXPECT_EQ(demo.side(0).choice.facing->info.name, "normal_dot_eye");
  const FrontendStats stats = demo.side(0).stats;
  EXPECT_GE(stats.meshes_culled, 4u);
  EXPECT_GT(stats.culled, 10u);
  EXPECT_GT(stats.clipped_near, 0u);
  const auto one = sheets(demo.type("k"));
  EXPECT_GT(one, 1000);
  EXPECT_EQ(demo.side(0).judgement->wrong, 0u);
  demo.step();
  EXPECT_GT(sheets(demo.type("k")), one * 3 / 2);
  EXPECT_EQ(demo.side(0).judgement->wrong, 0u);
  EXPECT_FALSE(demo.step().labels.empty());
  EXPECT_NE(letters_of(demo.side(0).faces).find("------"), std::string::npos) << "culled with their object";
  demo.step();
  EXPECT_EQ(demo.side(0).judgement->wrong, 0u);
}

TEST(OutlawTriad, CullsAboutHalfOfTheQuads) {
  const Scene scene = find_demo("outlaw-triad").scene();
  for (const Mesh& mesh : scene.meshes)
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      ASSERT_EQ(mesh.has_flag(i, kSameFace), i % 2 == 1);
  Shown demo("outlaw-triad");
  demo.step();
  EXPECT_EQ(demo.side(0).choice.facing->info.name, "normal_z");
  demo.step(2);
  EXPECT_EQ(demo.side(0).choice.facing->info.name, "normal_z");
  EXPECT_TRUE(demo.side(1).choice.ours());
  EXPECT_EQ(demo.side(1).stats.culled, 0u);
  EXPECT_LE(demo.side(0).stats.emitted, demo.side(1).stats.emitted * 6 / 10);
  EXPECT_EQ(demo.side(0).judgement->wrong, 0u);
  EXPECT_TRUE(demo.side(0).cull_back && !demo.side(1).cull_back);
  demo.step();
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(demo.side(i).choice.coverage->info.name, "wireframe");
  EXPECT_LE(demo.side(0).stats.emitted, demo.side(1).stats.emitted * 6 / 10);
}

TEST(DemoCommand, ListsDemosAndTheirSteps) {
  const std::string list = testing::run_program(EDGEWISE_PROGRAM, "demo").out;
  const auto json = nlohmann::json::parse(testing::run_program(EDGEWISE_PROGRAM, "demo --json").out);
  ASSERT_EQ(json.size(), demos().size());
  const auto one =
      nlohmann::json::parse(testing::run_program(EDGEWISE_PROGRAM, "demo outlaw-triad --json").out);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].at("name"), "outlaw-triad");
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), static_cast<std::ptrdiff_t>(demos().size()));
  for (std::size_t i = 0; i < demos().size(); ++i) {
    const Demo& demo = demos()[i];
    EXPECT_NE(list.find(demo.name), std::string::npos);
    EXPECT_EQ(json[i].at("name"), demo.name);
    EXPECT_EQ(json[i].at("steps").size(), demo.steps.size());
    EXPECT_EQ(json[i].at("steps").back().at("notice"), demo.steps.back().notice);
    const auto told = testing::run_program(EDGEWISE_PROGRAM, "demo " + std::string(demo.name));
    EXPECT_NE(told.out.find(demo.steps.front().notice), std::string::npos) << demo.name;
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
  const Image last = read_image(there + "/again.png");
  EXPECT_EQ(last.width, 320);
  const std::string files = write("--frames 7 -o " + there + "/film/");
  EXPECT_EQ(std::count(files.begin(), files.end(), '\n'), 7);
  std::set<std::string> different;
  for (int i = 1; i <= 7; ++i)
    different.insert(file_content(there + "/film/pico8-culling-000" + std::to_string(i) + ".png"));
  EXPECT_GE(different.size(), 5u);
  EXPECT_FALSE(std::filesystem::exists(there + "/film/pico8-culling-0008.png"));
}

}  // namespace
}  // namespace edgewise::viewer
