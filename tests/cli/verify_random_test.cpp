// `edgewise verify --random`: cases depend only on seed and number, shards add up, and deliberately wrong
// backends are found.
#include "cli/verify/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "edgewise/contract.h"
#include "edgewise/tri_file.h"
#include "lab/cases/backend_comparison.h"
#include "lab/cases/hard_triangles.h"
#include "lab/cases/random_cases.h"
#include "message_of.h"
#include "run_program.h"
#include "support.h"
#include "temp_dir.h"
#include "wrong_backend.h"

namespace edgewise::randomized {
namespace {

using testing::run_program;

Report run(const Plan& plan) {
  Report report;
  run(plan, report);
  return report;
}

// FNV-1a hash of a case and of its triangles, which are the front end's if it is a scene.
std::uint64_t fingerprint(const Case& c) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  const auto add = [&](const auto& value) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
    for (std::size_t i = 0; i < sizeof value; ++i) hash = (hash ^ bytes[i]) * 0x100000001B3u;
  };
  add(c.number), add(c.width), add(c.height), add(c.background), add(c.threads), add(c.draws_seed);
  for (const ScreenTriangle& t : c.drawable ? testing::run(*c.drawable, c.frontend).triangles : c.triangles)
    add(t);
  return hash;
}

TEST(RandomCases, DependOnSeedAndNumberAlone) {
  std::set<std::uint64_t> seen;
  std::uint64_t all = 0;
  for (std::uint64_t number = 0; number < 300; ++number) {
    const auto here = fingerprint(make_case(1, number));
    EXPECT_EQ(here, fingerprint(make_case(1, number)));
    EXPECT_TRUE(seen.insert(here).second) << number;
    EXPECT_TRUE(seen.insert(fingerprint(make_case(2, number))).second) << number;
    all = all * 31 + here;
  }
  EXPECT_EQ(all, 14202305222529980539u)
      << "not the same on every machine and with every compiler, or changed";
}

TEST(RandomCases, HaveAnyNumberOfSubpixelBits) {
  std::map<int, int> cases;
  for (std::uint64_t number = 0; number < 2400; ++number) {
    const int bits = random_subpixel_bits(1, number);
    ++cases[bits];
    const Case c = make_case(1, number, bits);
    EXPECT_EQ(c.frontend.subpixel_bits, bits);
    for (const ScreenTriangle& t : c.triangles)
      for (int i = 0; i < 3; ++i)
        ASSERT_EQ((t.x_q15[i] | t.y_q15[i]) % (1 << (contract::kFineBits - bits)), 0);
  }
  EXPECT_EQ(cases.size(), 12u);
  EXPECT_GT(cases[8], 1200);
  for (const auto& [bits, count] : cases) EXPECT_GT(count, 50) << bits;
}

void expect_in_contract(const ScreenTriangle& t) {
  for (int i = 0; i < 3; ++i) {
    ASSERT_LE(std::abs(t.x_q15[i]), contract::kGuard_q15);
    ASSERT_LE(std::abs(t.y_q15[i]), contract::kGuard_q15);
    ASSERT_GE(t.z[i], contract::kDepthHead);
    ASSERT_LE(t.z[i], contract::kDepthHead + contract::kDepthRange);
  }
}

TEST(RandomCases, KeepTheGuardBandAtEverySize) {
  for (const std::string_view family : lab::triangle_families())
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      const int width = seed % 2 == 0 ? contract::kMaxImageSide : 1 + static_cast<int>(seed);
      for (const ScreenTriangle& t : lab::adversarial(family, 300, width, contract::kMaxImageSide, seed))
        expect_in_contract(t);
    }
}

TEST(RandomCases, KeepTheContractAndIncludeEachFamily) {
  std::map<std::string, std::uint64_t> cases, drawn;
  std::uint64_t scenes = 0, with = 0, drawn_with = 0;  // matrices
  std::set<int> threads;
  bool wide = false, single = false, several_chunks = false;
  for (std::uint64_t number = 0; number < 1500; ++number) {
    const Case c = make_case(3, number);
    ++cases[c.family];
    threads.insert(c.threads);
    wide |= std::max(c.width, c.height) > 1024;
    single |= c.width == 1 || c.height == 1;
    several_chunks |= c.triangles.size() > 2 * 2048;
    ASSERT_EQ(c.triangles.empty(), c.drawable.has_value());
    for (const ScreenTriangle& t : c.triangles) {
      expect_in_contract(t);
      drawn[c.family] += lab::covered_pixels(std::span(&t, 1), c.width, c.height) != 0 ? 1u : 0u;
    }
    if (c.drawable) drawn[c.family] += Frontend().run(*c.drawable, c.frontend).size();
    const auto* scene = c.drawable ? std::get_if<Scene>(&*c.drawable) : nullptr;
    scenes += scene != nullptr;
    const auto other = with_matrices(c);
    if (!other) continue;
    ++with;
    ASSERT_TRUE(scene != nullptr && !scene->matrices);
    const CameraMatrices m = std::get<Scene>(*other->drawable).matrices.value();
    EXPECT_EQ(m.projection, std::get<Scene>(*with_matrices(c)->drawable).matrices->projection);
    drawn_with += Frontend().run(*other->drawable, other->frontend).size();
  }
  EXPECT_GT(with, scenes / 4);
  EXPECT_GT(drawn_with, 10 * with);
  EXPECT_EQ(cases.size(), lab::triangle_families().size() + scene_families().size());
  for (const auto& [family, count] : cases) {
    EXPECT_GT(count, 40u) << family;
    EXPECT_GT(drawn[family], count) << family;
  }
  EXPECT_GE(threads.size(), 4u);
  EXPECT_TRUE(wide);
  EXPECT_TRUE(single);
  EXPECT_TRUE(several_chunks);
}

Plan plan_of(std::uint64_t seed, std::uint64_t cases) {
  Plan plan;
  plan.backends.assign(backends().begin(), backends().end());
  plan.seed = seed;
  plan.cases = cases;
  return plan;
}

template <typename Wrong>
Plan plan_with(std::uint64_t seed, std::uint64_t cases) {
  Plan plan = plan_of(seed, cases);
  plan.backends = {backends()[0], testing::wrong_backend<Wrong>()};
  return plan;
}

TEST(VerifyRandom, FindsNoDifferenceAndShardsAddUp) {
  const Report whole = run(plan_of(5, 60));
  EXPECT_EQ(whole.differences, 0u) << whole.findings.at(0);
  EXPECT_EQ(whole.cases, 60u);
  EXPECT_GT(whole.oracle_frames, 0u);
  EXPECT_GT(whole.frontend_lists, 0u);
  EXPECT_GE(whole.frames, 60 * backends().size() * supported_targets().size() * 2);
  Report parts[3];
  for (std::uint64_t index = 0; index < 3; ++index) {
    Plan plan = plan_of(5, 20);
    plan.shard = {index, 3};
    parts[index] = run(plan);
  }
  for (const auto count : {&Report::frames, &Report::triangles, &Report::pixels, &Report::oracle_frames,
                           &Report::frontend_lists})
    EXPECT_EQ(parts[0].*count + parts[1].*count + parts[2].*count, whole.*count);
}

TEST(VerifyRandom, StopsOnRequestAndAtTheTimeLimit) {
  Plan plan = plan_of(1, 1'000'000);
  plan.seconds = 0.05;
  const Report late = run(plan);
  EXPECT_LT(late.cases, 1'000'000u);
  EXPECT_GE(late.seconds, 0.05);
  int asked = 0;
  plan = plan_of(1, 1'000'000);
  plan.stop = [&] { return ++asked > 10; };
  EXPECT_EQ(run(plan).cases, 10u);
}

// Wrong only at pixel (0, 0), only on several threads, and only if a triangle covers it.
using WrongInTheCorner = testing::Spoiled<[](FrameView frame, std::uint32_t, const Execution& execution) {
  if (execution.threads != 1 && frame.depth[0] != contract::kDepthClear) frame.depth[0] ^= 1;
}>;

using WritesBehindTheLastRow = testing::Spoiled<[](FrameView frame, auto...) {
  if (frame.width < frame.stride) frame.depth[frame.height * frame.stride - 1] = 0;
}>;

// Wrong in every frame, and used as the reference: only the oracle can find it.
using WrongReference =
    testing::DrawnBy<[](Backend& right, auto triangles, const FramePart& part, const Execution& execution) {
      std::vector<ScreenTriangle> moved(triangles.begin(), triangles.end());
      for (ScreenTriangle& t : moved)
        for (std::int32_t& x : t.x_q15) x = std::max(x - 128, -contract::kGuard_q15);
      right.draw(moved, part.frame, testing::pass_of(part), execution);
    }>;

using Throws = testing::DrawnBy<[](const auto&...) { throw std::length_error("too much"); }>;

// Wrong only if it draws over what the frame holds: it clears.
using AlwaysClears =
    testing::DrawnBy<[](Backend& right, auto triangles, const FramePart& part, const Execution& execution) {
      RenderPass pass = testing::pass_of(part);
      pass.clear = true;
      right.draw(triangles, part.frame, pass, execution);
    }>;

// The .tri file that a finding names; empty if it names none.
std::string file_of(const std::string& finding) {
  std::smatch found;
  return std::regex_search(finding, found, std::regex("triangles show it with --subpixel-bits \\d+: (.*)\n"))
             ? found[1].str()
             : "";
}

TEST(RandomFindings, NameThePixelAndTheFewestTriangles) {
  const TempDir folder;
  Plan plan = plan_with<WrongInTheCorner>(8, 40);
  plan.failure_folder = folder.path() / "failures";
  std::vector<std::string> shown;
  plan.on_finding = [&](const std::string& finding) { shown.push_back(finding); };
  const Report report = run(plan);
  ASSERT_FALSE(report.findings.empty());
  EXPECT_EQ(shown, report.findings);
  EXPECT_LE(report.findings.size(), kMostFindings);
  EXPECT_GE(report.differences, report.findings.size());
  const std::regex pattern(
      "case (\\d+) \\(\\S+, \\d+ bits\\): wrong \\([2-8] threads, \\S+, tile \\d+.*\\) differs from scanline "
      "in 1 of "
      "\\d+x\\d+ "
      "pixels, the first at x 0, y 0: depth 0x(\\w{8}), payload 0x(\\w{8}) instead of 0x(\\w{8}), 0x\\3\n"
      "  1 of its triangles show it with --subpixel-bits 15: .*\n"
      "  reproduce: edgewise verify --random --seed 8 --case \\1\n");
  for (const std::string& finding : report.findings) {
    if (finding.find(", in parts)") != std::string::npos) continue;  // several wrong draws
    std::smatch found;
    ASSERT_TRUE(std::regex_match(finding, found, pattern)) << finding;
    EXPECT_EQ(std::stoul(found[2], nullptr, 16) ^ std::stoul(found[4], nullptr, 16), 1u);
    EXPECT_EQ(read_tri(file_of(finding)).size(), 1u);
    // The program lacks the wrong backend, so the file and the command must run and find nothing.
    EXPECT_EQ(run_program(EDGEWISE_PROGRAM, "verify '" + file_of(finding) + "'").status, 0);
    EXPECT_EQ(run_program(EDGEWISE_PROGRAM, "verify --random --seed 8 --case " + found[1].str()).status, 0);
  }
}

TEST(RandomFindings, AreNotReducedAfterARequestToStopOrTheTimeLimit) {
  const TempDir folder;
  Plan plan = plan_with<WrongInTheCorner>(8, 1);
  plan.failure_folder = folder.path();
  int asked = 0;
  const auto triangles_left = [&](std::uint64_t number) -> std::size_t {
    plan.shard = {number, number + 1};
    asked = 0;
    const Report report = run(plan);
    return report.findings.empty() ? 0 : read_tri(file_of(report.findings[0])).size();
  };
  plan.stop = [&] { return ++asked > 1; };  // once the case has begun
  std::uint64_t number = 0;
  while (triangles_left(number) < 2) ASSERT_LT(++number, 100u);
  plan.stop = [] { return false; };
  EXPECT_EQ(triangles_left(number), 1u);
  plan.seconds = 1e-9;
  EXPECT_GE(triangles_left(number), 2u);
}

// Runs the plan and requires that some finding contains the text.
std::string finding_with(const Plan& plan, const std::string& text) {
  const Report report = run(plan);
  const auto found = std::ranges::find_if(
      report.findings, [&](const std::string& finding) { return finding.find(text) != std::string::npos; });
  if (found != report.findings.end()) return *found;
  ADD_FAILURE() << report.differences << " differences, none with " << text;
  return {};
}

TEST(RandomFindings, IncludeEveryKindOfMistake) {
  Plan plan = plan_with<WritesBehindTheLastRow>(9, 6);
  plan.failure_folder = "/dev/null/failures";
  for (const char* text : {"in 0 of ", "; 1 words written beside the image", "  no file: "})
    finding_with(plan, text);
  plan = plan_of(10, 40);
  plan.backends = {testing::wrong_backend<WrongReference>()};
  finding_with(plan, "wrong (1 thread, scalar, tile 64) differs from oracle");
  finding_with(plan_with<testing::IgnoresSources>(14, 120), ", whole frame) differs from scanline");
  finding_with(plan_with<AlwaysClears>(15, 60), ", in parts) differs from scanline");
}

TEST(RandomFindings, IncludeAWrongFrontEnd) {
  const TempDir folder;
  for (const bool by_threads : {true, false}) {
    Plan plan = plan_of(by_threads ? 11 : 16, 60);
    plan.frontend = [=](Frontend& frontend, const Drawable& drawable, const FrontendOptions& options,
                        const Execution& execution) {
      const std::span<const ScreenTriangle> all = frontend.run(drawable, options, execution);
      const auto* scene = std::get_if<Scene>(&drawable);
      const bool wrong = by_threads ? execution.threads > 1 : scene != nullptr && scene->matrices.has_value();
      return wrong && !all.empty() ? all.first(all.size() - 1) : all;
    };
    plan.failure_folder = folder.path() / "failures";
    const std::string finding = finding_with(
        plan, by_threads ? "(stream, 11 bits): front end (" : " with matrices, 8 bits): front end (");
    EXPECT_EQ(by_threads ? read_tri(file_of(finding)).size() : 1, 1u) << finding;
  }
}

TEST(RandomFindings, AnExceptionNamesTheCase) {
  Report report;
  const std::string said = message_of([&] { run(plan_with<Throws>(12, 4), report); });
  EXPECT_EQ(report.findings, std::vector{said});
  EXPECT_GT(report.frames, 0u);
  EXPECT_TRUE(said.starts_with("seed 12, case 0 (")) << said;
  EXPECT_TRUE(said.ends_with("): too much")) << said;
}

TEST(VerifyRandomProgram, WritesALineOnStdoutAndAcceptsTheCasesOfTheMostShards) {
  const auto outcome = run_program(EDGEWISE_PROGRAM, "verify --random --seed 7 --case 123456 --json -");
  EXPECT_EQ(std::ranges::count(outcome.out, '\n'), 1) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json.at("cases"), 1);
  EXPECT_EQ(json.at("shard"), "123456/123457");
  const std::string last = std::to_string(kMostShards - 1) + '/' + std::to_string(kMostShards);
  for (const std::string& chosen : {"--for 0.1s --shard " + last, std::string("--case 18446744073709551614")})
    EXPECT_EQ(run_program(EDGEWISE_PROGRAM, "verify --random " + chosen).status, 0) << chosen;
}

}  // namespace

}  // namespace edgewise::randomized
