#include "lab/needs/pipeline_needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <numeric>

#include "core/parallel.h"
#include "edgewise/contract.h"
#include "lab/visibility/depth_buffer.h"

namespace edgewise::lab {

namespace {

// Calls body(i, memory) for each i below `count`, with one memory per thread.
template <typename Memory, typename Body>
void for_each_task(std::vector<Memory>& memory, std::size_t count, Body&& body) {
  std::atomic<std::size_t> next = 0;
  const int threads = static_cast<int>(memory.size());
  parallel_for(threads, threads, [&](int thread) {
    for (std::size_t i; (i = next++) < count;) body(i, memory[static_cast<std::size_t>(thread)]);
  });
}

std::vector<std::uint32_t> as_list(std::uint32_t id) {
  return id == kNoTriangle ? std::vector<std::uint32_t>{} : std::vector{id};
}

// The visibilities of a pipeline: those without a depth buffer, then its depths up to ours.
constexpr std::size_t kChoices = kDepthBuffer + kOurDepth + 1;
constexpr std::size_t kTests = kSnappedArea + 1;
constexpr int kBandRows = 16;
using ByChoice = std::array<std::uint32_t, kChoices>;
using ByTest = std::array<ByChoice, kTests>;

constexpr auto kUnormMax = [] {
  std::array<std::int32_t, kOurDepth> max{};
  for (int bits = 1; bits <= kOurDepth; ++bits) max[static_cast<std::size_t>(bits) - 1] = (1 << bits) - 1;
  return max;
}();

}  // namespace

// Where a picture shows each triangle.
class PipelineNeeds::Places {
 public:
  explicit Places(std::vector<Run> runs) : runs_(std::move(runs)) { std::ranges::sort(runs_); }
  bool has(std::uint32_t triangle) const { return !of(triangle).empty(); }
  // The square of the distance to the nearest pixel of a triangle, or `enough` if it is no farther.
  std::int64_t distance_squared(std::uint32_t triangle, int x, int y, std::int64_t enough) const {
    std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
    for (const Run& run : of(triangle)) {
      const std::int64_t dx = std::max({run.x0 - x, x - (run.x1 - 1), 0}), dy = run.y - y;
      nearest = std::min(nearest, dx * dx + dy * dy);
      if (nearest <= enough) return enough;
    }
    return nearest;
  }

 private:
  std::span<const Run> of(std::uint32_t triangle) const {
    const auto found = std::ranges::equal_range(runs_, triangle, {}, &Run::triangle);
    return {found.begin(), found.end()};
  }
  std::vector<Run> runs_;
};

// Judges pipelines that differ in facing tests and visibility only by one list of fragments per pixel. One
// per thread.
class PipelineNeeds::Search {
 public:
  // What a triangle draws at a pixel.
  struct Fragment {
    std::uint32_t triangle, contract31;
    double depth01;
  };

  // Adds the wrong pixels of each pipeline to `wrong`. Where all have more than `limit`, any number above it.
  void count(const Frame& frame, const Pipeline& pipeline, std::uint32_t limit, ByTest& wrong) {
    frame.frame.assemble(pipeline, memory_);
    prepare();
    const std::vector<std::uint32_t> right = frame.right_picture();
    for (std::size_t band = 0; band < in_band_.size(); ++band) {
      tests_.clear();
      for (std::size_t test = 0; test < kTests; ++test)
        if (std::ranges::min(wrong[test]) <= limit) tests_.push_back(test);
      if (tests_.empty()) return;
      const int y0 = static_cast<int>(band) * kBandRows;
      draw(in_band_[band], y0, std::min(kBandRows, memory_.scene.height - y0));
      const std::size_t first = static_cast<std::size_t>(y0) * static_cast<std::size_t>(memory_.scene.width);
      for (std::size_t pixel = 0; pixel + 1 < begin_.size(); ++pixel)
        compare(std::span(fragments_).subspan(begin_[pixel], begin_[pixel + 1] - begin_[pixel]),
                right[first + pixel], wrong);
      flush(wrong);
    }
  }

 private:
  void prepare() {
    const VisibilityScene& scene = memory_.scene;
    mean_.clear(), farthest_.clear();
    in_band_.assign(static_cast<std::size_t>((scene.height + kBandRows - 1) / kBandRows), {});
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
      const double(&z)[3] = scene.triangles[i].view_z;
      mean_.push_back((z[0] + z[1] + z[2]) / 3), farthest_.push_back(std::max({z[0], z[1], z[2]}));
      const contract::PixelBox box =
          contract::pixel_box(scene.triangles[i].screen, scene.width, scene.height);
      for (int band = box.y0 / kBandRows; band * kBandRows < box.y1; ++band)
        in_band_[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(i));
    }
  }

  // Lists the fragments of each pixel of these rows, in submission order.
  void draw(const std::vector<std::uint32_t>& triangles, int y0, int rows) {
    const VisibilityScene& scene = memory_.scene;
    begin_.assign(static_cast<std::size_t>(rows * scene.width) + 1, 0);
    drawn_.clear();
    for (const std::uint32_t i : triangles) {
      const VisibilityTriangle& t = scene.triangles[i];
      if (contract::signed_area(t.screen) == 0) continue;
      const contract::DepthPlane ours = contract::make_depth(contract::orient(t.screen));
      GradientPlane<double> plane(t.screen, depth01(t.view_z[0], scene), depth01(t.view_z[1], scene),
                                  depth01(t.view_z[2], scene));
      const auto add = [&](int y, int begin, int end) {
        plane.row(begin, y);
        for (int x = begin; x < end; ++x) {
          const auto pixel = static_cast<std::size_t>((y - y0) * scene.width + x);
          ++begin_[pixel + 1];
          drawn_.push_back({pixel, {i, ours.at(x, y), plane.at(x)}});
        }
      };
      for_each_span(t.screen, scene.width, y0 + rows, add, y0);
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    fragments_.resize(drawn_.size());
    next_ = begin_;
    for (const auto& [pixel, fragment] : drawn_) fragments_[next_[pixel]++] = fragment;
  }

  void compare(std::span<const Fragment> all, std::uint32_t right, ByTest& wrong) {
    std::array<std::uint64_t, kTests> kept{};  // the fragments that a test keeps, by bits
    std::array<ByChoice, kTests> memory;
    std::array<const ByChoice*, kTests> shown{};
    for (const std::size_t test : tests_) {
      std::size_t count = 0, last = 0;
      for (std::size_t i = 0; i < all.size(); ++i) {
        const std::uint32_t keeps = memory_.kept_by[all[i].triangle] >> test & 1u;
        kept[test] = kept[test] << 1 | keeps;
        count += keeps, last = keeps != 0 ? i : last;
      }
      if (count == 0) {
        always_wrong_[test] += right != kNoTriangle ? 1u : 0u;
        continue;
      }
      if (count == 1 && all[last].contract31 < contract::kDepthClear) {
        compare_one(all[last], test, right);
        continue;
      }
      for (const std::size_t other : tests_)  // tests that keep the same fragments show the same
        if (other < test && all.size() <= 64 && kept[other] == kept[test]) shown[test] = shown[other];
      if (shown[test] == nullptr) show(all, test, memory[test]), shown[test] = &memory[test];
      for (std::size_t i = 0; i < kChoices; ++i) wrong[test][i] += (*shown[test])[i] != right ? 1u : 0u;
    }
  }

  // The only fragment is shown, but by depth buffers of so few bits that its depth is that of the background.
  void compare_one(const Fragment& f, std::size_t test, std::uint32_t right) {
    std::size_t lost = 0;
    while (lost < kUnormMax.size() && f.depth01 * kUnormMax[lost] + 0.5 >= kUnormMax[lost]) ++lost;
    const std::uint32_t id = memory_.scene.triangles[f.triangle].screen.payload;
    if (id == right)
      ++wrong_if_lost_[test][lost];
    else if (right == kNoTriangle)
      ++wrong_if_shown_[test][lost];
    else
      ++always_wrong_[test];
  }

  // Adds what compare() counted apart.
  void flush(ByTest& wrong) {
    for (std::size_t test = 0; test < kTests; ++test)
      for (std::size_t i = 0; i < kChoices; ++i) {
        wrong[test][i] += always_wrong_[test];
        for (std::size_t lost = 0; lost <= kUnormMax.size(); ++lost) {
          const bool is_lost = i >= kDepthBuffer && i - kDepthBuffer < lost && i + 1 < kChoices;
          wrong[test][i] += (is_lost ? wrong_if_lost_ : wrong_if_shown_)[test][lost];
        }
      }
    always_wrong_ = {}, wrong_if_lost_ = {}, wrong_if_shown_ = {};
  }

  // The id that each visibility shows of the fragments that a test keeps.
  void show(std::span<const Fragment> all, std::size_t test, ByChoice& shown) const {
    shown.fill(kNoTriangle);
    std::uint32_t* const by_bits = shown.data() + kDepthBuffer;
    std::array<std::int32_t, kOurDepth> depth = kUnormMax;
    std::uint32_t ours = contract::kDepthClear;
    double mean = std::numeric_limits<double>::infinity(), farthest = mean;
    for (const Fragment& f : all) {
      if ((memory_.kept_by[f.triangle] >> test & 1) == 0) continue;
      const std::uint32_t id = memory_.scene.triangles[f.triangle].screen.payload;
      shown[0] = id;
      // Painters draw the farthest first, and of equally far ones the earlier.
      if (mean_[f.triangle] <= mean) mean = mean_[f.triangle], shown[1] = id;
      if (farthest_[f.triangle] <= farthest) farthest = farthest_[f.triangle], shown[2] = id;
      for (std::size_t i = 0; i < kUnormMax.size(); ++i) {  // as UnormPlane
        const double max = kUnormMax[i], scaled = std::clamp(f.depth01 * max + 0.5, 0.0, max);
        const auto value = static_cast<std::int32_t>(scaled);
        by_bits[i] = value < depth[i] ? id : by_bits[i];
        depth[i] = std::min(depth[i], value);
      }
      if (f.contract31 < ours) ours = f.contract31, by_bits[kOurDepth] = id;
    }
  }

  PipelineMemory memory_;
  std::vector<double> mean_, farthest_;              // the painters' keys, by triangle
  std::vector<std::vector<std::uint32_t>> in_band_;  // the triangles that reach each band of rows
  // By test, and by the number of depth buffers with too few bits to show a pixel's only fragment.
  using ByLost = std::array<std::array<std::uint32_t, kUnormMax.size() + 1>, kTests>;
  ByLost wrong_if_lost_{}, wrong_if_shown_{};
  std::array<std::uint32_t, kTests> always_wrong_{};
  std::vector<std::size_t> tests_;                       // those that are not yet decided
  std::vector<std::pair<std::size_t, Fragment>> drawn_;  // pixel, fragment
  std::vector<std::uint32_t> begin_, next_;              // by pixel: its first fragment
  std::vector<Fragment> fragments_;
};

std::vector<std::uint32_t> PipelineNeeds::Frame::right_picture() const {
  std::vector<std::uint32_t> picture;
  for (const Run& run : right)
    picture.insert(picture.end(), static_cast<std::size_t>(run.x1 - run.x0), run.triangle);
  return picture;
}

Pipeline PipelineNeeds::Frame::without_idle_planes(Pipeline pipeline) const {
  for (std::size_t i = 0; i < kViewPlanes; ++i)
    if ((pipeline[i] == kNothing ? reach[i].beyond : reach[i].crossing) == 0) pipeline[i] = kClip;
  return pipeline;
}

void PipelineNeeds::start(const StudiedFrame& frame) {
  if (std::holds_alternative<Scene>(frame.drawable)) {
    stages_ = {kNearPlane, kFarPlane, kGuardBand};
    if (frame.options.cull == Cull::back) stages_.push_back(kFacing);
  }
  stages_.insert(stages_.end(), {kSubpixel, kVisibility, kDepth});
  for (const Stage stage : stages_) {
    curves_[stage] = {stage, {}};
    for (std::string& name : levels_of(stage)) curves_[stage].levels.push_back({std::move(name)});
  }
}

// The level of a frame.
Level PipelineNeeds::judge(const Frame& frame, std::span<const std::uint32_t> right, const Places& places,
                           const Pipeline& pipeline, PipelineMemory& memory) const {
  frame.frame.draw(pipeline, memory);
  const std::vector<std::uint32_t> drawn = memory.picture();
  const Size size = frame.frame.size();
  Level found;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn[i] == right[i]) continue;
    const int x = static_cast<int>(i) % size.width, y = static_cast<int>(i) / size.width;
    if (++found.wrong_px == 1)
      found.witness = Witness{frame.index, x, y, as_list(right[i]), as_list(drawn[i])};
    if (places.has(drawn[i]))
      found.farthest_squared_px = places.distance_squared(drawn[i], x, y, found.farthest_squared_px);
    else
      ++found.hidden_px;
  }
  return found;
}

void PipelineNeeds::add(const StudiedFrame& studied, const CoverageScene& scene,
                        const std::array<Reach, kViewPlanes>& reach, int threads) {
  if (frames_.empty()) start(studied);
  Frame& frame =
      frames_.emplace_back(Frame{studied.index, reach, PipelineFrame(studied.drawable, studied.options), {}});
  const std::vector<std::uint32_t> right = right_picture(scene, threads);
  const std::size_t width = static_cast<std::size_t>(studied.options.width);
  for (std::size_t i = 0; i < right.size(); ++i) {
    const int x = static_cast<int>(i % width), y = static_cast<int>(i / width);
    if (x == 0 || right[i] != right[i - 1]) frame.right.push_back({right[i], y, x, x});
    ++frame.right.back().x1;
  }

  std::map<Pipeline, std::vector<Level*>> by_pipeline;
  for (const Stage stage : stages_)
    for (int i = 0; Level & level : curves_[stage].levels) {
      Pipeline pipeline = exact_pipeline();
      pipeline[stage] = i++;
      by_pipeline[frame.without_idle_planes(pipeline)].push_back(&level);
    }
  const std::vector<std::pair<Pipeline, std::vector<Level*>>> trials(by_pipeline.begin(), by_pipeline.end());
  const Places places(frame.right);
  std::vector<PipelineMemory> memory(static_cast<std::size_t>(threads));
  for_each_task(memory, trials.size(), [&](std::size_t i, PipelineMemory& own) {
    const Level found = judge(frame, right, places, trials[i].first, own);
    for (Level* const level : trials[i].second) {
      level->wrong_px += found.wrong_px, level->hidden_px += found.hidden_px;
      level->worst_px = std::max(level->worst_px, found.wrong_px);
      level->farthest_squared_px = std::max(level->farthest_squared_px, found.farthest_squared_px);
      if (found.wrong_px > tolerance_px_ && level->enough()) level->witness = found.witness;
    }
  });
}

std::vector<Curve> PipelineNeeds::curves(const Ranges& ranges) const {
  std::vector<Curve> found;
  for (const Stage stage : stages_) {
    Curve& curve = found.emplace_back(curves_[stage]);
    if (stage >= kViewPlanes) continue;
    const auto plane = static_cast<ViewPlane>(stage);
    const Reach& reach = ranges.reach(plane);
    if (reach.beyond == 0)
      curve.proof = ranges.describe(plane);
    else if (reach.crossing == 0)
      curve.proof = fmt::format(
          "of the {} triangles that reach beyond it, each lies outside one side of the view", reach.beyond);
  }
  return found;
}

Pipeline PipelineNeeds::strongest(const Ranges& ranges) const {
  Pipeline pipeline = exact_pipeline();
  for (std::size_t i = 0; stages_.front() == kNearPlane && i < kViewPlanes; ++i) {
    const Reach& reach = ranges.reach(static_cast<ViewPlane>(i));
    pipeline[i] = reach.beyond == 0 ? kNothing : reach.crossing == 0 ? kDrop : kClip;
  }
  return pipeline;
}

Minima PipelineNeeds::minima(const Ranges& ranges, int threads,
                             const std::function<void(double)>& done) const {
  const Pipeline most = strongest(ranges);
  const auto has = [&](Stage stage) { return std::ranges::find(stages_, stage) != stages_.end(); };
  const std::size_t first_test = has(kFacing) ? kNoTest : kSnappedArea;
  // The pipelines by what comes before facing tests and visibility.
  std::vector<Pipeline> starts{{}};
  for (const Stage stage : {kNearPlane, kFarPlane, kGuardBand, kSubpixel}) {
    std::vector<Pipeline> more;
    for (Pipeline pipeline : starts)
      for (int level = has(stage) ? 0 : most[stage]; level <= most[stage]; ++level)
        pipeline[stage] = level, more.push_back(pipeline);
    starts = std::move(more);
  }

  // No pipeline with more wrong pixels than the exact one is the closest.
  const auto limit =
      static_cast<std::uint32_t>(std::max(tolerance_px_, curves_[kSubpixel].levels.back().worst_px));
  using Worst = std::array<std::array<std::atomic<std::uint32_t>, kChoices>, kTests>;  // of all frames so far
  std::vector<Worst> worst(starts.size());
  std::vector<std::pair<const Frame*, std::vector<std::size_t>>> tasks;  // these starts draw the same
  for (const Frame& frame : frames_) {
    std::map<Pipeline, std::vector<std::size_t>> same;
    for (std::size_t i = 0; i < starts.size(); ++i) same[frame.without_idle_planes(starts[i])].push_back(i);
    for (auto& [start, all] : same) tasks.emplace_back(&frame, std::move(all));
  }
  std::vector<Search> searches(static_cast<std::size_t>(threads));
  for_each_task(searches, tasks.size(), [&](std::size_t task, Search& search) {
    const auto& [frame, same] = tasks[task];
    ByTest wrong;  // of a pipeline that is no longer judged, more than the limit
    for (std::size_t test = 0; test < kTests; ++test)
      for (std::size_t i = 0; i < kChoices; ++i)
        wrong[test][i] =
            test >= first_test && std::ranges::any_of(
                                      same, [&](std::size_t start) { return worst[start][test][i] <= limit; })
                ? 0
                : limit + 1;
    search.count(*frame, frame->without_idle_planes(starts[same.front()]), limit, wrong);
    for (const std::size_t start : same)
      for (std::size_t test = first_test; test < kTests; ++test)
        for (std::size_t i = 0; i < kChoices; ++i) {
          std::uint32_t before = worst[start][test][i];
          while (before < wrong[test][i] &&
                 !worst[start][test][i].compare_exchange_weak(before, wrong[test][i]))
            ;
        }
    if (&search == &searches.front()) done(static_cast<double>(task) / static_cast<double>(tasks.size()));
  });

  Minima result;
  std::vector<Pipeline> right;
  Pipeline closest{};
  result.closest_px = limit + std::uint64_t{1};
  for (std::size_t start = 0; start < starts.size(); ++start)
    for (std::size_t test = first_test; test < kTests; ++test)
      for (std::size_t i = 0; i < kChoices; ++i) {
        Pipeline pipeline = starts[start];
        pipeline[kFacing] = static_cast<int>(test);
        pipeline[kVisibility] = static_cast<int>(std::min<std::size_t>(i, kDepthBuffer));
        pipeline[kDepth] = static_cast<int>(i) - pipeline[kVisibility];
        const std::uint32_t px = worst[start][test][i];
        ++result.judged;
        if (px <= tolerance_px_) right.push_back(pipeline);
        if (px < result.closest_px) closest = pipeline, result.closest_px = px;
      }
  const auto named = [&](const Pipeline& pipeline) {
    Levels levels;
    for (const Stage stage : stages_)
      if (stage != kDepth || pipeline[kVisibility] == kDepthBuffer)
        levels[name_of(stage)] = curves_[stage].levels[static_cast<std::size_t>(pipeline[stage])].name;
    return levels;
  };
  std::ranges::sort(right);
  for (const Pipeline& pipeline : right)
    if (std::ranges::none_of(right, [&](const Pipeline& other) { return is_weaker(other, pipeline); }))
      result.right.push_back(named(pipeline));
  if (right.empty()) result.closest = named(closest);
  return result;
}

}  // namespace edgewise::lab
