#include "cli/verify/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

#include "edgewise/draw.h"
#include "edgewise/tri_file.h"
#include "files/atomic_file.h"
#include "files/pictures.h"
#include "lab/cases/to_stream.h"
#include "lab/truth/oracle.h"

namespace edgewise::tools {

namespace {

// Odd and prime sides: no tile, vector or cell size divides them.
constexpr Size kQuickSize{509, 283}, kFullSize{1920, 1080}, kOracleSize{61, 37};
constexpr double kQuickScale = 0.02, kQuickMeshScale = 0.1;
constexpr double kEnoughTriangles = 400;
constexpr double kOracleBudget =
    7.5e6;  // pixels times triangles for each culling mode, a quarter of a second

const TriangleStream* stream_of(const Shot& shot) {
  return std::get_if<TriangleStream>(&shot.source.drawable);
}

Shot load(const VerifyPlan& plan, const std::string& name, std::optional<Size> size,
          std::optional<double> scale) {
  SceneOptions options;
  options.size = size;
  options.scale = scale;
  options.fit = plan.fit;
  options.subpixel_bits = plan.subpixel_bits;
  return load_shot(name, options, 0.0);
}

// A built-in stream of about `wanted` triangles or a bit more, at most its full number.
Shot load_thinned(const VerifyPlan& plan, const std::string& name, Size size, double scale, double wanted) {
  Shot shot = load(plan, name, size, scale);
  const auto count = static_cast<double>(stream_of(shot)->triangles.size());
  if (count >= wanted) return shot;
  return load(plan, name, size, std::min(1.0, scale * wanted / count));
}

bool is_affordable(const TriangleStream& stream) {
  return static_cast<double>(stream.size()) * stream.width * stream.height <= kOracleBudget;
}

// Every n-th triangle of a file's stream, scaled to a smaller image.
TriangleStream shrunk(const TriangleStream& stream, Size size, std::size_t most) {
  const std::size_t step = (stream.size() + most - 1) / most;
  const glm::vec3 factor(static_cast<float>(size.width) / static_cast<float>(stream.width),
                         static_cast<float>(size.height) / static_cast<float>(stream.height), 1.0f);
  TriangleStream small{size.width, size.height, {}};
  const auto append = [&](const auto& list, auto& to) {
    for (std::size_t i = 0; i < list.size(); i += step)
      for (auto& vertex : to.emplace_back(list[i]).vertex) vertex *= factor;
  };
  append(stream.triangles, small.triangles), append(stream.exact, small.exact);
  return small;
}

// The image size at which a scene's triangles fit the oracle's budget. A smaller image also has fewer
// triangles.
Size affordable_size(const Shot& shot) {
  Frontend frontend;
  FrontendOptions options = shot.frontend;
  options.cull = Cull::none;
  for (;;) {
    const auto triangles = static_cast<double>(frontend.run(shot.source.drawable, options).size());
    const double cost = triangles * options.width * options.height;
    if (cost <= kOracleBudget || options.width * options.height == 1) return {options.width, options.height};
    const double factor = std::min(0.9, std::sqrt(kOracleBudget / cost));
    const auto smaller = [&](int side) { return std::max(1, static_cast<int>(side * factor) - 1) | 1; };
    options.width = std::min(options.width, smaller(options.width));
    options.height = std::min(options.height, smaller(options.height));
  }
}

// Whether the scene is watertight over the whole image, so that each pixel is covered exactly once.
bool covers_each_pixel_once(const Source& source) {
  return source.built_in != nullptr && source.stream && source.name.starts_with("grid");
}

// The scene at the plan's size, scaled down, so that many configurations can be compared in little time.
Shot shot_for_comparison(const VerifyPlan& plan, const std::string& name) {
  const SceneInfo* const built_in = is_file_path(name) ? nullptr : &find_scene(name);
  const Size size = plan.size.value_or(plan.full ? kFullSize : kQuickSize);
  const bool scaled = built_in != nullptr && built_in->scalable && !plan.full;
  if (scaled && !built_in->stream) return load(plan, name, size, kQuickMeshScale);
  if (scaled && !name.starts_with("grid"))  // a grid's triangle count depends on the image size
    return load_thinned(plan, name, size, kQuickScale, kEnoughTriangles);
  const bool own_size = !plan.size && is_stream_file(name);
  return load(plan, name, own_size ? std::nullopt : std::optional(size), std::nullopt);
}

// The scene scaled down for the oracle: pixels times triangles stay within its budget.
Shot shot_for_oracle(const VerifyPlan& plan, const std::string& name) {
  constexpr double kScale = 1e-3;
  const SceneInfo* const built_in = is_file_path(name) ? nullptr : &find_scene(name);
  const bool built_in_stream = built_in != nullptr && built_in->stream;
  const bool scaled_mesh = built_in != nullptr && built_in->scalable && !built_in->stream;
  Shot shot = built_in_stream
                  ? load_thinned(plan, name, kOracleSize, kScale, kEnoughTriangles)
                  : load(plan, name, kOracleSize, scaled_mesh ? std::optional(kScale) : std::nullopt);
  if (const TriangleStream* stream = stream_of(shot); stream != nullptr && !built_in_stream) {
    if (is_affordable(*stream)) {  // keep a counterexample unchanged
      shot.frontend.width = stream->width;
      shot.frontend.height = stream->height;
    } else {
      shot.source.drawable = shrunk(*stream, kOracleSize, static_cast<std::size_t>(kEnoughTriangles));
    }
  }
  const Size size = affordable_size(shot);
  shot.frontend.width = size.width;
  shot.frontend.height = size.height;
  return shot;
}

// About the width of a screen: enlarged pixels are visible and the picture fits.
int enlargement(int width, int height) {
  constexpr int kLargestSide_px = 2048, kLargestFactor = 8;
  return std::clamp(kLargestSide_px / std::max(width, height), 1, kLargestFactor);
}

// Writes FOLDER/SCENE-CULL-BACKEND-vs-JUDGE: expected, found and difference (enlarged) as .png, and the
// triangles as .tri. Lists the files, or the reason why one was not written, in the mismatch. Does nothing if
// the folder name is empty.
void write_failure(const std::filesystem::path& folder, const std::string& scene, Mismatch& mismatch,
                   std::span<const ScreenTriangle> triangles, const Framebuffer& expected,
                   const Framebuffer& found) try {
  const FrontendOptions& frontend = mismatch.frontend;
  if (folder.empty()) return;
  std::filesystem::create_directories(folder);
  const auto path_for = [&](const char* suffix) {
    return folder / fmt::format("{}-{}-{}-vs-{}{}", scene, name_of(frontend.cull), mismatch.backend,
                                mismatch.judge, suffix);
  };
  const auto write = [&](const char* suffix, const Image& image) {
    write_image(path_for(suffix), image);
    mismatch.files.push_back(path_for(suffix).string());
  };
  write("-expected.png", picture_of(expected, frontend.payload));
  write("-found.png", picture_of(found, frontend.payload));
  write("-difference.png", enlarge(picture_of_difference(expected, found, frontend.payload),
                                   enlargement(frontend.width, frontend.height)));
  AtomicFile file(path_for(".tri"));
  write_tri(file.stream(), lab::to_stream(triangles, frontend.width, frontend.height));
  file.commit();
  mismatch.files.push_back(path_for(".tri").string());
} catch (const std::exception& error) {
  // Report the mismatch even if its pictures cannot be written.
  mismatch.file_error = error.what();
}

// What a frame is compared with: the triangles, and the frame they must become.
struct Judgement {
  std::string_view judge;
  const Shot& shot;
  std::span<const ScreenTriangle> triangles;
  const Framebuffer& expected;
};

// Small tiles, several threads and the widest vectors: the most boundaries between tiles, threads and lanes.
constexpr Execution kSmallestTiles{3, 16, SimdTarget::best};
constexpr Execution kReferenceExecution{1, 64, SimdTarget::scalar};

// Other tile sizes run on the best target, other targets with the usual tile, and other options of tiles on
// one thread count: the full product would mostly repeat itself, since only tiled backends use tile size
// and target. Whole frames run on every target, since draw(drawable, …) takes another path for streams.
std::vector<Configuration> configurations(const VerifyPlan& plan) {
  std::vector<Configuration> all;
  for (const SimdTarget target : supported_targets())
    all.push_back({{{plan.threads.back(), 64, target}}, true});
  for (const int threads : plan.threads) {
    for (const SimdTarget target : supported_targets()) all.push_back({{{threads, 64, target}}});
    for (const int tile : {16, 32}) all.push_back({{{threads, tile, resolve(SimdTarget::best)}}});
  }
  for (const TileOptions& tiles : lab::kTileOptions)
    all.push_back({{{plan.threads.front(), 64, resolve(SimdTarget::best)}, tiles}});
  return all;
}

template <typename Frame>
PixelValue value_at(const Frame& frame, std::string_view drawn_by, int x, int y) {
  return {std::string(drawn_by), frame.depth_row(y)[x], frame.payload_row(y)[x]};
}

class SceneCheck {
 public:
  SceneCheck(const VerifyPlan& plan, const std::string& name, const std::function<void(double)>& progress)
      : plan_(plan), name_(name), progress_(progress), configurations_(configurations(plan)) {
    for (const BackendInfo& info : plan.backends) backends_.push_back(info.make());
    // Per culling mode: all configurations with colours, and two per backend with ids.
    steps_ = cull_modes().size() * plan.backends.size() * (configurations_.size() + 2);
  }

  SceneVerdict run() {
    check_against_reference();
    check_against_oracle();
    return std::move(verdict_);
  }

 private:
  void check_against_reference() {
    Shot shot = shot_for_comparison(plan_, name_);
    const int width = shot.frontend.width, height = shot.frontend.height;
    verdict_.scene = shot.source.name;
    verdict_.width = width;
    verdict_.height = height;
    Framebuffer expected(width, height);
    candidate_.emplace(width, height, lab::GuardedFrame::aligned(width));

    for (const Cull cull : cull_modes()) {
      shot.frontend.cull = cull;
      for (const Payload payload : {Payload::colour, Payload::id}) {
        shot.frontend.payload = payload;
        const auto triangles = frontend_.run(shot.source.drawable, shot.frontend);
        verdict_.triangles = frontend_.stats().triangles;
        lab::poison(expected);
        backends_.front()->draw(triangles, expected.view(), {background_of(payload)}, kReferenceExecution);
        compare_all({plan_.backends.front().name, shot, triangles, expected});
        if (cull == Cull::none && payload == Payload::id && covers_each_pixel_once(shot.source))
          check_hits(triangles, width, height);
      }
    }
  }

  void compare_all(const Judgement& judgement) {
    const Configuration small_tiles[] = {{{kSmallestTiles}}, {{kSmallestTiles}, true}};
    const std::span<const Configuration> all = judgement.shot.frontend.payload == Payload::colour
                                                   ? std::span<const Configuration>(configurations_)
                                                   : small_tiles;
    for (std::size_t b = 0; b < backends_.size(); ++b)
      for (const Configuration& configuration : all) {
        verdict_.differing_pixels += compare(judgement, b, configuration);
        ++verdict_.configurations;
        progress_(static_cast<double>(++steps_done_) / static_cast<double>(steps_));
      }
  }

  // Compares ids, because colours may be equal by chance.
  void check_against_oracle() {
    Shot shot = shot_for_oracle(plan_, name_);
    shot.frontend.payload = Payload::id;
    const int width = verdict_.oracle_width = shot.frontend.width;
    const int height = verdict_.oracle_height = shot.frontend.height;
    Framebuffer expected(width, height);
    candidate_.emplace(width, height, lab::GuardedFrame::aligned(width));
    for (const Cull cull : cull_modes()) {
      shot.frontend.cull = cull;
      const auto triangles = frontend_.run(shot.source.drawable, shot.frontend);
      lab::draw_oracle(triangles, expected, background_of(Payload::id));
      for (std::size_t b = 0; b < backends_.size(); ++b) {
        verdict_.oracle_differences += compare({"oracle", shot, triangles, expected}, b, {{kSmallestTiles}});
        ++verdict_.oracle_configurations;
      }
    }
  }

  void check_hits(std::span<const ScreenTriangle> triangles, int width, int height) {
    for (std::size_t b = 0; b < backends_.size(); ++b) {
      const auto hits = lab::count_hits(*backends_[b], triangles, width, height, kSmallestTiles);
      const auto wrong = std::count_if(hits.begin(), hits.end(), [](std::uint32_t n) { return n != 1; });
      verdict_.hits.push_back({std::string(plan_.backends[b].name), static_cast<std::uint64_t>(wrong)});
    }
  }

  // Returns the number of pixels that differ. Keeps the first difference per backend and judge, with
  // evidence.
  std::uint64_t compare(const Judgement& j, std::size_t backend, const Configuration& configuration) {
    draw(j, backend, configuration);
    const lab::FrameDifference found = lab::compare(j.expected, *candidate_);
    const std::string_view name = plan_.backends[backend].name;
    const bool known =
        std::any_of(verdict_.mismatches.begin(), verdict_.mismatches.end(),
                    [&](const Mismatch& m) { return m.backend == name && m.judge == j.judge; });
    verdict_.written_outside += found.outside;
    if (found.any() && !known) keep(j, backend, configuration, found);
    return found.pixels;
  }

  void draw(const Judgement& j, std::size_t backend, const Configuration& configuration) {
    candidate_->poison();
    const lab::DrawOptions& how = configuration.how;
    std::unique_ptr<Backend> made;  // not kept, since its memory grows with the scene
    if (how.tiles != TileOptions{}) made = lab::make(plan_.backends[backend], how.tiles);
    Backend& drawer = made ? *made : *backends_[backend];
    const std::uint32_t background = background_of(j.shot.frontend.payload);
    if (configuration.whole_frame)
      edgewise::draw(j.shot.source.drawable, whole_frames_, j.shot.frontend, drawer, candidate_->view(),
                     {background}, how.execution);
    else
      drawer.draw(j.triangles, candidate_->view(), {background}, how.execution);
  }

  void keep(const Judgement& j, std::size_t backend, const Configuration& configuration,
            const lab::FrameDifference& found) {
    const int x = found.first_x, y = found.first_y;
    const std::string_view name = plan_.backends[backend].name;
    Mismatch mismatch{j.shot.frontend, std::string(j.judge), std::string(name), configuration, found};
    write_failure(plan_.failure_folder, verdict_.scene, mismatch, j.triangles, j.expected,
                  candidate_->copy());
    if (found.pixels != 0) {
      mismatch.values = {value_at(j.expected, j.judge, x, y),
                         value_at(*candidate_, std::string(name) + " (so configured)", x, y)};
      for (std::size_t b = 0; b < backends_.size(); ++b) {
        draw(j, b, {{{1, 64, resolve(SimdTarget::best)}}});
        mismatch.values.push_back(value_at(*candidate_, plan_.backends[b].name, x, y));
      }
    }
    verdict_.mismatches.push_back(std::move(mismatch));
  }

  const VerifyPlan& plan_;
  const std::string& name_;
  const std::function<void(double)>& progress_;
  const std::vector<Configuration> configurations_;
  std::vector<std::unique_ptr<Backend>> backends_;
  // frontend_ owns the triangles of a Judgement, so whole frames need a front end of their own.
  Frontend frontend_, whole_frames_;
  std::optional<lab::GuardedFrame> candidate_;
  SceneVerdict verdict_{};
  std::size_t steps_, steps_done_ = 0;
};

}  // namespace

bool SceneVerdict::ok() const {
  return differing_pixels == 0 && oracle_differences == 0 && written_outside == 0 &&
         std::all_of(hits.begin(), hits.end(), [](const HitCount& h) { return h.not_once == 0; });
}

bool VerifyReport::ok() const {
  return std::all_of(scenes.begin(), scenes.end(), [](const SceneVerdict& scene) { return scene.ok(); });
}

VerifyReport verify(const VerifyPlan& plan, const std::function<void(const SceneVerdict&)>& on_scene) {
  VerifyReport report;
  for (const std::string& name : plan.scenes) {
    const std::function<void(double)> progress = [&](double scene_fraction) {
      const auto done = static_cast<double>(report.scenes.size()) + scene_fraction;
      if (plan.on_progress)
        plan.on_progress(done / static_cast<double>(plan.scenes.size()), source_name(name));
    };
    report.scenes.push_back(SceneCheck(plan, name, progress).run());
    if (on_scene) on_scene(report.scenes.back());
  }
  return report;
}

}  // namespace edgewise::tools
