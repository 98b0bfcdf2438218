#include "cli/verify/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "cli/verify/verify.h"
#include "core/random.h"
#include "edgewise/contract.h"
#include "edgewise/draw.h"
#include "edgewise/tri_file.h"
#include "files/atomic_file.h"
#include "frontend/mesh_clusters.h"
#include "lab/cases/backend_comparison.h"
#include "lab/cases/random_cases.h"
#include "lab/cases/to_stream.h"
#include "lab/truth/oracle.h"
#include "support/console.h"
#include "support/process.h"

namespace edgewise::randomized {

namespace {

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

enum class Output { frame, frame_in_parts, whole_frame, frontend_list };

// One thing that is compared: a frame drawn from screen triangles, at once or in parts, or by
// draw(drawable, …), which includes the front end, or the front end's list.
struct Probe {
  Output output;
  std::size_t backend = 0;  // index
  lab::DrawOptions how;
  lab::GuardedFrame::Layout layout = {};
  bool by_oracle = false;
  // Of a frame in parts: the corner of its four parts, px, and how many triangles each part's first draw has.
  int corner_x = 0, corner_y = 0;
  std::size_t in_first_draw = 0;
};

// Draws four parts of a frame, each in two draws. The picture is that of one draw.
void draw_in_parts(Backend& backend, std::span<const ScreenTriangle> triangles, FrameView frame,
                   std::uint32_t background, const Probe& probe) {
  const std::size_t cut = std::min(probe.in_first_draw, triangles.size());
  const int x = probe.corner_x, y = probe.corner_y;
  for (const PixelRect& part :
       {PixelRect{.width = x, .height = y}, {.x = x, .height = y}, {.y = y, .width = x}, {.x = x, .y = y}}) {
    const Execution& execution = probe.how.execution;
    backend.draw(triangles.first(cut), frame, {.background = background, .scissor = part}, execution);
    backend.draw(triangles.subspan(cut), frame, {.clear = false, .scissor = part}, execution);
  }
}

// The triangles after writing and reading them as a stream, which may round depths to floats.
std::vector<ScreenTriangle> replayed(const Case& c) {
  Frontend frontend;
  const FrontendOptions options{.width = c.width,
                                .height = c.height,
                                .cull = Cull::none,
                                .shade = false,
                                .subpixel_bits = kMaxSubpixelBits};
  const auto again = frontend.run(lab::to_stream(c.triangles, c.width, c.height), options);
  return {again.begin(), again.end()};
}

// Reuses its buffers between cases.
class Checker {
 public:
  Checker(const Plan& plan, Report& report) : plan_(plan), report_(report) {}

  void check(const Case& c) {
    explained_.clear();
    const std::span<const ScreenTriangle> triangles = triangles_of(c);
    if (c.drawable) check_frontend(c);
    if (oracle_can_follow(c, triangles.size())) {
      ++report_.oracle_frames;
      check_frame(c, {Output::frame, 0, {kReferenceExecution}, lab::GuardedFrame::aligned(c.width), true},
                  triangles, oracle_frame(c, triangles));
    }
    const Framebuffer expected = reference_frame(c, triangles);
    constexpr std::array kTiles{16, 32, 64};
    Random random(c.draws_seed);
    // For streams only, draw(drawable, …) takes another path than Backend::draw(). Scenes repeat the front
    // end.
    const bool is_stream = c.drawable && std::holds_alternative<TriangleStream>(*c.drawable);
    for (std::size_t b = 0; b < plan_.backends.size(); ++b)
      for (const SimdTarget target : supported_targets())
        for (const int threads : {1, c.threads}) {
          Probe probe{Output::frame, b, {{threads, kTiles[random.below(kTiles.size())], target}}};
          if (random.below(2) == 0)
            probe.how.tiles = lab::kTileOptions[random.below(lab::kTileOptions.size())];
          probe.layout = random_layout(random, c.width);
          probe.corner_x = static_cast<int>(random.below(static_cast<std::uint64_t>(c.width) + 1));
          probe.corner_y = static_cast<int>(random.below(static_cast<std::uint64_t>(c.height) + 1));
          probe.in_first_draw = random.below(triangles.size() + 1);
          if (random.below(8) == 0) probe.output = Output::frame_in_parts;
          if (c.drawable && random.below(is_stream ? 2 : 16) == 0) probe.output = Output::whole_frame;
          check_frame(c, probe, triangles, expected);
        }
  }

 private:
  // Those of the case, or those that the front end makes on its path for single triangles.
  std::span<const ScreenTriangle> triangles_of(const Case& c) {
    if (!c.drawable) return c.triangles;
    FrontendOptions options = c.frontend;
    options.keep_unsnapped = true;  // uses that path, which keeps triangles without area
    const auto plain = plain_.run(*c.drawable, options, {.target = SimdTarget::scalar});
    expected_list_.assign(plain.begin(), plain.end());
    std::erase_if(expected_list_, [](const ScreenTriangle& t) { return contract::signed_area(t) == 0; });
    return expected_list_;
  }

  void check_frontend(const Case& c) {
    Case in_clusters;
    const bool is_scene = std::holds_alternative<Scene>(*c.drawable);
    if (is_scene) {
      in_clusters = c;
      make_clusters(*in_clusters.drawable);
    }
    // Of a scene, one of the two runs on each target uses clusters. Which one depends on the case.
    const bool clusters_on_one_thread = Random(c.draws_seed).below(2) == 0;
    for (const SimdTarget target : supported_targets())
      for (const int threads : {1, c.threads}) {
        const bool clusters = is_scene && (threads == 1) == clusters_on_one_thread;
        const Probe probe{Output::frontend_list, 0, {{threads, 64, target}}};
        ++report_.frontend_lists;
        if (const auto found = list_difference(clusters ? in_clusters : c, probe); !found.empty())
          count(c, probe, expected_list_, found);
      }
  }

  void check_frame(const Case& c, const Probe& probe, std::span<const ScreenTriangle> triangles,
                   const Framebuffer& expected) {
    ++report_.frames;
    report_.triangles += triangles.size();
    report_.pixels += static_cast<std::uint64_t>(c.width) * static_cast<std::uint64_t>(c.height);
    if (const auto found = frame_difference(c, probe, triangles, expected); !found.empty())
      count(c, probe, triangles, found);
  }

  // What differs from expected_list_, in words; empty if nothing does.
  std::string list_difference(const Case& c, const Probe& probe) {
    const auto found = plan_.frontend(candidate_, *c.drawable, c.frontend, probe.how.execution);
    const auto at = std::mismatch(
        expected_list_.begin(), expected_list_.end(), found.begin(), found.end(),
        [](const ScreenTriangle& a, const ScreenTriangle& b) { return std::memcmp(&a, &b, sizeof a) == 0; });
    if (at.first == expected_list_.end() && at.second == found.end()) return {};
    return fmt::format("{} triangles instead of {}, the first difference at index {}", found.size(),
                       expected_list_.size(), at.first - expected_list_.begin());
  }

  std::string frame_difference(const Case& c, const Probe& probe, std::span<const ScreenTriangle> triangles,
                               const Framebuffer& expected) {
    lab::GuardedFrame frame(c.width, c.height, probe.layout);
    Backend& backend = backends_.get(plan_.backends[probe.backend], probe.how.tiles);
    const Execution& execution = probe.how.execution;
    if (probe.output == Output::whole_frame)
      draw(*c.drawable, candidate_, c.frontend, backend, frame.view(), {c.background}, execution);
    else if (probe.output == Output::frame_in_parts)
      draw_in_parts(backend, triangles, frame.view(), c.background, probe);
    else
      backend.draw(triangles, frame.view(), {c.background}, execution);
    const lab::FrameDifference found = lab::compare(expected, frame);
    if (!found.any()) return {};
    const int x = found.first_x, y = found.first_y;
    std::string text = fmt::format("{} of {}x{} pixels", found.pixels, c.width, c.height);
    if (found.pixels != 0)
      text += fmt::format(
          ", the first at x {}, y {}: depth {:#010x}, payload {:#010x} instead of {:#010x}, {:#010x}", x, y,
          frame.depth_row(y)[x], frame.payload_row(y)[x], expected.depth_row(y)[x],
          expected.payload_row(y)[x]);
    if (found.outside != 0) text += fmt::format("; {} words written beside the image", found.outside);
    return text;
  }

  Framebuffer reference_frame(const Case& c, std::span<const ScreenTriangle> triangles) {
    Framebuffer frame(c.width, c.height);
    lab::poison(frame);
    backends_.get(plan_.backends[0], {}).draw(triangles, frame.view(), {c.background}, kReferenceExecution);
    return frame;
  }

  static Framebuffer oracle_frame(const Case& c, std::span<const ScreenTriangle> triangles) {
    Framebuffer frame(c.width, c.height);
    lab::draw_oracle(triangles, frame, c.background);
    return frame;
  }

  // Whether the case shows a difference again. Several threads get several attempts, since a race may not
  // show in the first.
  bool differs(const Case& c, const Probe& probe) {
    const auto triangles = triangles_of(c);
    if (probe.output == Output::frontend_list) return !list_difference(c, probe).empty();
    const Framebuffer expected = probe.by_oracle ? oracle_frame(c, triangles) : reference_frame(c, triangles);
    for (int attempts = probe.how.execution.threads == 1 ? 1 : 5; attempts > 0; --attempts)
      if (!frame_difference(c, probe, triangles, expected).empty()) return true;
    return false;
  }

  // Explains the first difference of each backend and judge in a case.
  void count(const Case& c, const Probe& probe, std::span<const ScreenTriangle> triangles,
             const std::string& difference) {
    ++report_.differences;
    const bool frontend = probe.output == Output::frontend_list;
    const std::string_view name = frontend ? "front end" : plan_.backends[probe.backend].name;
    const std::string_view judge = frontend          ? "its path for single triangles"
                                   : probe.by_oracle ? "oracle"
                                                     : plan_.backends[0].name;
    std::string versus = fmt::format("{}-vs-{}", name, judge);
    std::replace(versus.begin(), versus.end(), ' ', '-');
    if (report_.findings.size() >= kMostFindings ||
        std::find(explained_.begin(), explained_.end(), versus) != explained_.end())
      return;
    explained_.push_back(versus);
    const std::string_view drawn = probe.output == Output::whole_frame      ? ", whole frame"
                                   : probe.output == Output::frame_in_parts ? ", in parts"
                                                                            : "";
    std::string text =
        fmt::format("case {} ({}, {} bits): {} ({}{}) differs from {} in {}\n", c.number, c.family,
                    c.frontend.subpixel_bits, name, tools::describe(probe.how), drawn, judge, difference);
    if (!plan_.failure_folder.empty()) {
      const std::string file = fmt::format("seed-{}-case-{}-{}.tri", plan_.seed, c.number, versus);
      Report not_counted;  // another checker, because this one's buffers are in use
      text += Checker(plan_, not_counted).evidence(c, probe, triangles, plan_.failure_folder / file);
    }
    text += fmt::format("  reproduce: edgewise verify --random --seed {} --case {}\n", plan_.seed, c.number);
    plan_.on_finding(text);
    report_.findings.push_back(std::move(text));
  }

  // Writes a .tri file with as few triangles as still show the difference. There is none if a scene shows it
  // only together with the front end.
  std::string evidence(const Case& c, Probe probe, std::span<const ScreenTriangle> triangles,
                       const std::filesystem::path& path) try {
    const auto with_list = [&](std::vector<ScreenTriangle> list) {
      Case other = c;
      other.drawable.reset();
      other.triangles = std::move(list);
      return other;
    };
    const std::vector<ScreenTriangle> all(triangles.begin(), triangles.end());
    if (probe.output == Output::whole_frame || probe.output == Output::frame_in_parts) {
      // Blames the front end or the parts only if the same triangles, drawn at once from memory, show no
      // difference.
      Probe at_once = probe;
      at_once.output = Output::frame;
      if (differs(with_list(all), at_once)) probe = at_once;
    }
    TriangleStream stream;
    int bits = kMaxSubpixelBits;  // of snapped positions
    if (probe.output == Output::frame || probe.output == Output::frame_in_parts) {
      const auto fails = [&](const auto& list) { return differs(with_list(list), probe); };
      const auto again = replayed(with_list(all));
      stream = lab::to_stream(reduced(fails(again) ? again : all, fails), c.width, c.height);
    } else {
      const auto* whole = std::get_if<TriangleStream>(&*c.drawable);
      if (whole == nullptr) return {};
      stream = *whole;
      bits = c.frontend.subpixel_bits;
      const auto reduce = [&](auto TriangleStream::*list) {
        stream.*list = reduced(stream.*list, [&](const auto& fewer) {
          Case other = c;
          TriangleStream with_fewer = stream;
          with_fewer.*list = fewer;
          other.drawable = std::move(with_fewer);
          return differs(other, probe);
        });
      };
      reduce(&TriangleStream::triangles), reduce(&TriangleStream::exact);
    }
    std::filesystem::create_directories(path.parent_path());
    AtomicFile file(path);
    write_tri(file.stream(), stream);
    file.commit();
    return fmt::format("  {} of its triangles show it with --subpixel-bits {}: {}\n", stream.size(), bits,
                       tools::printable(path.string()));
  } catch (const std::exception& error) {
    // Report the difference even if its file cannot be written.
    return fmt::format("  no file: {}\n", tools::printable(tools::reason_of(error)));
  }

  // Removes parts while fails(list) holds without them: first halves of the list, at last single elements.
  // Delta debugging (Zeller and Hildebrandt, "Simplifying and isolating failure-inducing input", 2002) that
  // tests complements only.
  template <typename T, typename Fails>
  std::vector<T> reduced(std::vector<T> list, const Fails& fails) {
    int attempts = 500;
    for (std::size_t part = (list.size() + 1) / 2; part > 0; part = part == 1 ? 0 : (part + 1) / 2)
      for (std::size_t begin = 0; begin < list.size() && list.size() > 1;) {
        if (attempts-- <= 0 || plan_.stop()) return list;
        const std::size_t end = std::min(begin + part, list.size());
        std::vector<T> rest(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(begin));
        rest.insert(rest.end(), list.begin() + static_cast<std::ptrdiff_t>(end), list.end());
        if (fails(rest))
          list = std::move(rest);
        else
          begin = end;
      }
    return list;
  }

  const Plan& plan_;
  Report& report_;
  lab::BackendCache backends_;
  Frontend plain_, candidate_;
  std::vector<ScreenTriangle> expected_list_;
  std::vector<std::string> explained_;
};

std::string with_commas(std::uint64_t n) {
  std::string text = std::to_string(n);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), 1, ',');
  return text;
}

}  // namespace

void run(const Plan& plan, Report& report) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  Plan until_deadline = plan;
  until_deadline.stop = [&] { return plan.stop() || seconds() >= plan.seconds; };
  Checker checker(until_deadline, report);
  while (report.cases < plan.cases && report.seconds < plan.seconds && !plan.stop()) {
    const std::uint64_t number = plan.shard.index + report.cases * plan.shard.of;
    Case c = make_case(plan.seed, number, random_subpixel_bits(plan.seed, number));
    try {
      checker.check(c);
      if (auto other = with_matrices(c)) {
        c = *std::move(other);
        checker.check(c);
      }
    } catch (const std::exception& error) {
      report.findings.push_back(
          fmt::format("seed {}, case {} ({}): {}", plan.seed, c.number, c.family, tools::reason_of(error)));
      throw std::runtime_error(report.findings.back());
    }
    ++report.cases;
    report.seconds = seconds();
    plan.on_progress(report);
  }
}

std::string summary(const Report& r, const Plan& plan) {
  return fmt::format(
      "Seed {}, shard {}/{}: {} cases in {:.0f} s. {} frames ({} triangles and {} pixels in all)\n"
      "compared with {}, {} with the oracle, and {} triangle lists of the front end: {}.\n",
      plan.seed, plan.shard.index, plan.shard.of, with_commas(r.cases), r.seconds, with_commas(r.frames),
      with_commas(r.triangles), with_commas(r.pixels), plan.backends.front().name,
      with_commas(r.oracle_frames), with_commas(r.frontend_lists),
      r.differences == 0 ? "no bit differs" : with_commas(r.differences) + " DIFFER");
}

nlohmann::json to_json(const Report& r, const Plan& plan, const nlohmann::json& machine) {
  nlohmann::json json{{"seed", plan.seed},
                      {"shard", fmt::format("{}/{}", plan.shard.index, plan.shard.of)},
                      {"commit", machine.at("commit")},
                      {"cpu_model", machine.at("cpu_model")},
                      {"simd_targets", machine.at("simd_targets")},
                      {"backends", nlohmann::json::array()},
                      {"seconds", r.seconds},
                      {"cases", r.cases},
                      {"frames", r.frames},
                      {"triangles", r.triangles},
                      {"pixels", r.pixels},
                      {"oracle_frames", r.oracle_frames},
                      {"frontend_lists", r.frontend_lists},
                      {"differences", r.differences},
                      {"findings", r.findings}};
  for (const BackendInfo& backend : plan.backends) json["backends"].push_back(backend.name);
  return json;
}

}  // namespace edgewise::randomized
