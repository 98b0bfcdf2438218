#include "cli/soak/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "core/random.h"
#include "edgewise/contract.h"
#include "frontend/mesh_clusters.h"
#include "lab/oracle.h"

namespace edgewise::soak {

namespace {

constexpr const char* kOracle = "oracle";
constexpr const char* kOneByOne = "one triangle at a time";
constexpr Execution kReferenceExecution{1, 64, SimdTarget::scalar};

// Pixels times triangles that take the oracle about 5 ms and 100 ms.
constexpr double kOracleBudget = 1.5e5, kLargeOracleBudget = 3e6;

bool oracle_can_follow(const Case& c, std::size_t triangles) {
  const double cost = static_cast<double>(triangles) * c.width * c.height;
  return cost <= (c.large_oracle_budget ? kLargeOracleBudget : kOracleBudget);
}

// Odd strides and offsets prevent aligned stores; a Framebuffer's layout allows them.
lab::GuardedFrame::Layout random_layout(Random& random, int width) {
  if (random.below(2) == 0) return lab::GuardedFrame::aligned(width);
  const int padding = static_cast<int>(random.below(40));
  return {padding, static_cast<int>(random.below(16))};
}

bool same(std::span<const ScreenTriangle> a, std::span<const ScreenTriangle> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

}  // namespace

const char* input_of(const Draw& draw) {
  return draw.whole_frame ? "scene or stream" : "screen triangles";
}

Checker::Checker(const Judged& judged) : judged_(judged) {
  for (const BackendInfo& info : judged.backends) backends_.push_back(info.make());
}

Verdict Checker::check(const Case& c) {
  Verdict verdict;
  verdict.tally.cases = 1;
  const std::span<const ScreenTriangle> triangles = c.drawable ? check_frontend(c, verdict) : c.triangles;

  if (oracle_can_follow(c, triangles.size())) {
    Framebuffer exact(c.width, c.height);
    lab::draw_oracle(triangles, exact, c.background);
    ++verdict.tally.oracle_frames;
    check_frame(c, kOracle, exact, {0, {kReferenceExecution}, lab::GuardedFrame::aligned(c.width)}, triangles,
                verdict);
  }

  const Framebuffer expected = reference_frame(c, triangles);
  const std::string reference(judged_.backends[0].name);
  constexpr std::array kTiles{16, 32, 64};
  Random random(c.draws_seed);
  // For streams only, draw(drawable, …) takes another path than Backend::draw(). Scenes repeat the front end.
  const bool is_stream = c.drawable && std::holds_alternative<TriangleStream>(*c.drawable);
  for (std::size_t b = 0; b < backends_.size(); ++b)
    for (const SimdTarget target : supported_targets())
      for (const int threads : {1, c.threads}) {
        Draw draw{b, {{threads, kTiles[random.below(kTiles.size())], target}}, {}};
        if (random.below(2) == 0) draw.how.ablation = kAblations[random.below(kAblations.size())];
        draw.layout = random_layout(random, c.width);
        draw.whole_frame = c.drawable && random.below(is_stream ? 2 : 16) == 0;
        check_frame(c, reference, expected, draw, triangles, verdict);
      }
  return verdict;
}

std::span<const ScreenTriangle> Checker::check_frontend(const Case& c, Verdict& verdict) {
  FrontendOptions options = c.frontend;
  options.target = SimdTarget::scalar;
  options.keep_unsnapped = true;  // uses the path for single triangles, which keeps those without area
  const auto plain = plain_.run(*c.drawable, options);
  expected_list_.assign(plain.begin(), plain.end());
  std::erase_if(expected_list_, [](const ScreenTriangle& t) { return contract::signed_area(t) == 0; });

  const bool is_scene = std::holds_alternative<Scene>(*c.drawable);
  Drawable in_clusters;
  if (is_scene) {
    in_clusters = *c.drawable;
    make_clusters(in_clusters);
  }
  // Of a scene, one of the two runs on each target uses clusters. Which one depends on the case.
  const bool clusters_on_one_thread = Random(c.draws_seed).below(2) == 0;
  options.keep_unsnapped = false;
  for (const SimdTarget target : supported_targets())
    for (const int threads : {1, c.threads}) {
      options.target = target;
      options.threads = threads;
      const bool clusters = is_scene && (threads == 1) == clusters_on_one_thread;
      const Drawable& drawable = clusters ? in_clusters : *c.drawable;
      const bool differs = !same(expected_list_, judged_.frontend(candidate_, drawable, options));
      ++verdict.tally.frontend_lists;
      if (differs) ++verdict.tally.frontend_lists_differ;
      verdict.tally.count("frontend_simd_target", std::string(name_of(target)), differs);
      verdict.tally.count("frontend_threads", std::to_string(threads), differs);
      if (differs && verdict.findings.empty())
        verdict.findings.push_back({kOneByOne, true, {0, {{threads, 64, target}}, {}}, {}, {}});
    }
  return expected_list_;
}

void Checker::check_frame(const Case& c, const std::string& judge, const Framebuffer& expected,
                          const Draw& draw, std::span<const ScreenTriangle> triangles, Verdict& verdict) {
  const lab::FrameDifference found = compare(c, expected, draw, triangles);
  Tally& tally = verdict.tally;
  ++tally.frames;
  tally.triangles += triangles.size();
  tally.pixels += static_cast<std::uint64_t>(c.width) * static_cast<std::uint64_t>(c.height);
  if (found.any()) ++tally.frames_differ;

  const Execution& e = draw.how.execution;
  const std::string_view name = judged_.backends[draw.backend].name;
  const std::string left_out = describe(draw.how.ablation);
  tally.count("family", std::string(c.family), found.any());
  tally.count("judge", judge, found.any());
  tally.count("backend_simd_target", fmt::format("{}, {}", name, name_of(e.target)), found.any());
  tally.count("backend_threads", fmt::format("{}, {}", name, e.threads), found.any());
  tally.count("backend_tile_size", fmt::format("{}, {}", name, e.tile_size), found.any());
  tally.count("backend_input", fmt::format("{}, {}", name, input_of(draw)), found.any());
  tally.count("backend_ablation", fmt::format("{}, {}", name, left_out.empty() ? "all" : left_out),
              found.any());

  const bool known = std::any_of(verdict.findings.begin(), verdict.findings.end(), [&](const Finding& f) {
    return !f.of_frontend && f.judge == judge && f.draw.backend == draw.backend;
  });
  if (found.any() && !known)
    verdict.findings.push_back({judge, false, draw, found, {triangles.begin(), triangles.end()}});
}

Framebuffer Checker::reference_frame(const Case& c, std::span<const ScreenTriangle> triangles) {
  Framebuffer frame(c.width, c.height);
  lab::poison(frame);
  backends_[0]->draw(triangles, frame.view(), c.background, kReferenceExecution);
  return frame;
}

lab::FrameDifference Checker::compare(const Case& c, const Framebuffer& expected, const Draw& draw,
                                      std::span<const ScreenTriangle> triangles) {
  lab::GuardedFrame frame(c.width, c.height, draw.layout);
  Backend& backend = *backends_[draw.backend];
  if (draw.whole_frame) {
    FrontendOptions options = c.frontend;
    options.threads = draw.how.execution.threads;
    options.target = draw.how.execution.target;
    edgewise::draw(*c.drawable, candidate_, options, backend, frame.view(), c.background, draw.how);
  } else {
    edgewise::draw(backend, triangles, frame.view(), c.background, draw.how);
  }
  return lab::compare(expected, frame);
}

bool Checker::differs(const Finding& finding, const Case& c, std::span<const ScreenTriangle> triangles) {
  Framebuffer expected = reference_frame(c, triangles);
  if (finding.judge == kOracle) lab::draw_oracle(triangles, expected, c.background);
  const int attempts = finding.draw.how.execution.threads == 1 ? 1 : 5;
  for (int i = 0; i < attempts; ++i)
    if (compare(c, expected, finding.draw, triangles).any()) return true;
  return false;
}

bool Checker::differs(const Finding& finding, const Case& c, const TriangleStream& stream) {
  Case other = c;
  other.drawable = stream;
  Verdict verdict;
  const auto triangles = check_frontend(other, verdict);
  return finding.of_frontend ? verdict.tally.frontend_lists_differ != 0 : differs(finding, other, triangles);
}

}  // namespace edgewise::soak
