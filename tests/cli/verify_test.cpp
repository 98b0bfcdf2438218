// Tests `edgewise verify` with deliberately wrong backends: it must find their errors and pass correct
// backends.
#include "cli/verify/verify.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "edgewise/image.h"
#include "edgewise/tri_file.h"
#include "temp_dir.h"
#include "wrong_backend.h"

namespace edgewise::tools {
namespace {

constexpr int kWrongX = 7, kWrongY = 5;

// Flips one depth bit at one pixel.
using OneBitOff =
    testing::Spoiled<[](FrameView frame, auto...) { frame.depth[kWrongY * frame.stride + kWrongX] ^= 1; }>;

// Leaves the frame unchanged if there are no triangles.
using ForgetsBackground =
    testing::DrawnBy<[](Backend& right, auto triangles, const FramePart& part, const Execution& execution) {
      if (!triangles.empty()) right.draw(triangles, part.frame, testing::pass_of(part), execution);
    }>;

// Wrong only with three threads and id payloads.
using WrongOnThreads =
    testing::Spoiled<[](FrameView frame, std::uint32_t background, const Execution& execution) {
      if (execution.threads == 3 && background == 0xFFFFFFFFu) frame.payload[0] += 1;
    }>;

// Skips the last pixel of each row, which leaves gaps in a grid.
using LeavesGaps = testing::Spoiled<[](FrameView frame, std::uint32_t background, auto) {
  for (int y = 0; y < frame.height; ++y) {
    frame.depth[y * frame.stride + frame.width - 1] = 0x7FFFFFFF;
    frame.payload[y * frame.stride + frame.width - 1] = background;
  }
}>;

// Draws the picture correctly, but overwrites the first word behind a row.
using WritesBesideTheImage = testing::Spoiled<[](FrameView frame, std::uint32_t background, auto) {
  frame.payload[kWrongY * frame.stride + frame.width] = background;
}>;

VerifyPlan small_plan(std::vector<std::string> scenes, const BackendInfo& second) {
  VerifyPlan plan;
  plan.scenes = std::move(scenes);
  plan.backends = {backends()[0], second};
  plan.threads = {1, 3};
  plan.size = Size{67, 41};
  return plan;
}

TEST(Verify, FindsOneBitAndShowsIt) {
  const TempDir folder;
  VerifyPlan plan = small_plan({"cube"}, testing::wrong_backend<OneBitOff>());
  plan.failure_folder = folder.path() / "failures";
  const VerifyReport report = verify(plan, {});
  EXPECT_FALSE(report.ok());
  const SceneVerdict& verdict = report.scenes.at(0);
  EXPECT_EQ(verdict.differing_pixels, verdict.configurations / 2);  // one per frame of the wrong backend
  EXPECT_EQ(verdict.oracle_differences, verdict.oracle_configurations / 2);

  ASSERT_EQ(verdict.mismatches.size(), 2u);  // against the reference, and against the oracle
  const Mismatch& mismatch = verdict.mismatches[0];
  EXPECT_EQ(mismatch.backend, "wrong");
  EXPECT_EQ(mismatch.judge, backends()[0].name);
  EXPECT_EQ(mismatch.found.pixels, 1u);
  ASSERT_EQ(mismatch.values.size(), 2 + plan.backends.size());
  EXPECT_EQ(mismatch.values[1].depth, mismatch.values[0].depth ^ 1);
  EXPECT_EQ(verdict.mismatches[1].judge, "oracle");

  ASSERT_EQ(mismatch.files.size(), 4u) << mismatch.file_error;
  EXPECT_EQ(read_image(mismatch.files[0]).width, 67);
  const Image difference = read_image(mismatch.files[2]);
  const int factor = difference.width / 67;
  const auto wrong = static_cast<std::size_t>((kWrongY * difference.width + kWrongX) * factor);
  EXPECT_NE(difference.pixels.at(wrong), difference.pixels.at(wrong + static_cast<std::size_t>(factor)));
  EXPECT_EQ(read_tri(mismatch.files[3]).width, 67);

  const std::string text = explain(verdict);
  EXPECT_NE(text.find("x 7, y 5"), std::string::npos) << text;
  EXPECT_FALSE(report_json(report, plan).at("ok"));
}

TEST(Verify, FindsAMissingBackgroundAndAnErrorInASingleConfiguration) {
  EXPECT_FALSE(verify(small_plan({"cube"}, testing::wrong_backend<ForgetsBackground>()), {}).ok());
  const VerifyReport report = verify(small_plan({"cube"}, testing::wrong_backend<WrongOnThreads>()), {});
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.scenes[0].mismatches[0].drawn.how.execution.threads, 3);
  EXPECT_EQ(report.scenes[0].mismatches[0].frontend.payload, Payload::id);
}

TEST(Verify, FindsAnErrorInWholeFramesAlone) {
  const VerifyReport report =
      verify(small_plan({"large"}, testing::wrong_backend<testing::IgnoresSources>()), {});
  const SceneVerdict& verdict = report.scenes.at(0);
  EXPECT_GT(verdict.differing_pixels, 0u);
  ASSERT_EQ(verdict.mismatches.size(), 1u);
  EXPECT_TRUE(verdict.mismatches[0].drawn.whole_frame);
  EXPECT_NE(explain(verdict).find(", whole frame) differs from"), std::string::npos) << explain(verdict);
}

TEST(Verify, FindsWritesOutsideTheImage) {
  const VerifyReport report =
      verify(small_plan({"cube"}, testing::wrong_backend<WritesBesideTheImage>()), {});
  ASSERT_FALSE(report.ok());
  const SceneVerdict& verdict = report.scenes[0];
  EXPECT_EQ(verdict.differing_pixels, 0u);
  EXPECT_EQ(verdict.written_outside, verdict.configurations / 2 + verdict.oracle_configurations / 2);
  EXPECT_EQ(verdict.mismatches.at(0).found.outside, 1u);
  const std::string text = explain(verdict);
  EXPECT_NE(text.find("words written beside the image: 1"), std::string::npos) << text;
}

TEST(Verify, FindsGapsInAGrid) {
  const VerifyReport report = verify(small_plan({"grid4"}, testing::wrong_backend<LeavesGaps>()), {});
  const auto& hits = report.scenes.at(0).hits;
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].not_once, 0u);
  EXPECT_EQ(hits[1].not_once, 41u);
}

TEST(Verify, KeepsFindingsIfPicturesCannotBeWritten) {
  VerifyPlan plan = small_plan({"cube"}, testing::wrong_backend<OneBitOff>());
  plan.failure_folder = "/dev/null/failures";
  const VerifyReport report = verify(plan, {});
  ASSERT_FALSE(report.ok());
  EXPECT_NE(report.scenes[0].mismatches.at(0).file_error, "");
}

TEST(Verify, ComparesSmallStreamsWithTheOracleAtFullSize) {
  const TempDir folder;
  for (const std::size_t count : {1u, 2'000u}) {
    const TriangleStream stream{
        90, 70, {count, StreamTriangle{{{0, 0, 0}, {80.5f, 3.25f, 0}, {4.75f, 60.5f, 0}}, 1}}};
    const auto path = folder.path() / "stream.tri";
    {
      std::ofstream out(path, std::ios::binary);
      write_tri(out, stream);
    }
    const SceneVerdict verdict = verify(small_plan({path.string()}, backends()[1]), {}).scenes.at(0);
    EXPECT_EQ(verdict.oracle_width == 90 && verdict.oracle_height == 70, count == 1) << count;
    EXPECT_TRUE(verdict.ok());
  }
}

}  // namespace
}  // namespace edgewise::tools
