#include "lab/needs/pipeline_needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>

#include "core/parallel.h"
#include "edgewise/contract.h"
#include "lab/visibility/depth_buffer.h"

namespace edgewise::lab {

// What a triangle draws at a pixel.
struct Fragment {
  std::uint32_t triangle, contract31;
  double depth01;
};

// Rows of a picture: the fragments of each pixel, in submission order.
struct Band {
  std::vector<std::uint32_t> begin;  // by pixel, and the end
  std::vector<Fragment> fragments;
};

namespace {

constexpr int kBandRows = 4;
constexpr int kOurDepthBits = 31;
constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

// Calls body(i, memory) for each i below `count`, with one memory per thread, in ascending order per thread.
template <typename Memory, typename Body>
void for_each_task(std::vector<Memory>& memory, std::size_t count, Body&& body) {
  std::atomic<std::size_t> next = 0;
  const int threads = static_cast<int>(memory.size());
  parallel_for(threads, threads, [&](int thread) {
    for (std::size_t i; (i = next++) < count;) body(i, memory[static_cast<std::size_t>(thread)]);
  });
}

using Drawn = std::vector<std::pair<std::size_t, Fragment>>;  // pixel, fragment

// Of the rows y0 … y1 - 1, which these triangles reach. `drawn` is memory for it.
Band band_of(const VisibilityScene& scene, const std::vector<std::uint32_t>& triangles, int y0, int y1,
             Drawn& drawn) {
  Band band;
  band.begin.resize(static_cast<std::size_t>((y1 - y0) * scene.width) + 1);
  drawn.clear();
  for (const std::uint32_t i : triangles) {
    const VisibilityTriangle& t = scene.triangles[i];
    if (contract::signed_area(t.screen) == 0) continue;
    const contract::DepthPlane ours = contract::make_depth(contract::orient(t.screen));
    ScreenTriangle moved = t.screen;  // so that no other rows are visited
    for (std::int32_t& y : moved.y_q15) y -= y0 * contract::kPixel_q15;
    GradientPlane<double> plane(moved, depth01(t.view_z[0], scene), depth01(t.view_z[1], scene),
                                depth01(t.view_z[2], scene));
    for_each_span(moved, scene.width, y1 - y0, [&](int y, int begin, int end) {
      plane.row(begin, y);
      for (int x = begin; x < end; ++x) {
        const auto pixel = static_cast<std::size_t>(y * scene.width + x);
        ++band.begin[pixel + 1];
        drawn.push_back({pixel, {i, ours.at(x, y0 + y), plane.at(x)}});
      }
    });
  }
  std::partial_sum(band.begin.begin(), band.begin.end(), band.begin.begin());
  band.fragments.resize(drawn.size());
  std::vector<std::uint32_t> next = band.begin;
  for (const auto& [pixel, fragment] : drawn) band.fragments[next[pixel]++] = fragment;
  return band;
}

using Fragments = std::span<const Fragment>;

// The first one of the least value, which must be below `clear`.
template <typename Value>
std::uint32_t nearest(Fragments fragments, std::uint32_t clear, Value&& value_of) {
  std::uint32_t visible = kNoTriangle;
  for (const Fragment& fragment : fragments)
    if (const std::uint32_t value = value_of(fragment); value < clear)
      clear = value, visible = fragment.triangle;
  return visible;
}

// The last one that a painter draws: of the least key, and of several the last one.
std::uint32_t last_painted(Fragments fragments, const std::vector<double>& keys) {
  std::uint32_t visible = fragments.front().triangle;
  for (const Fragment& fragment : fragments)
    if (keys[fragment.triangle] <= keys[visible]) visible = fragment.triangle;
  return visible;
}

}  // namespace

// Counts the wrong pixels of pipelines. Keeps the fragments of its last assembly, and begins where it found
// errors before.
class PipelineNeeds::Judge {
 public:
  // All wrong pixels of the picture; or, if there are more than `limit`, any number above it.
  std::uint64_t wrong_px(const Frame& frame, const Pipeline& pipeline, std::uint64_t limit) {
    assemble(frame, pipeline);
    first_ = kNone, wrong_ = 0, limit_ = limit;
    const std::size_t start = std::min(hard_band_, bands_.size() - 1);
    std::uint64_t most = 0;
    for (std::size_t i = 0; i < bands_.size() && wrong_ <= limit; ++i) {
      const std::size_t band = (start + i) % bands_.size();
      const std::uint64_t before = wrong_;
      compare(band, pipeline);
      if (wrong_ - before > most) most = wrong_ - before, hard_band_ = band;
    }
    return wrong_;
  }

  // The worst frame's wrong pixels; or, if there are more than `limit`, any number above it.
  std::uint64_t worst_px(std::span<const Frame> frames, const Pipeline& pipeline, std::uint64_t limit) {
    if (order_.size() != frames.size()) {
      order_.resize(frames.size());
      std::iota(order_.begin(), order_.end(), 0u);
    }
    std::uint64_t worst = 0;
    for (auto frame = order_.begin(); frame != order_.end() && worst <= limit; ++frame) {
      worst = std::max(worst, wrong_px(frames[*frame], pipeline, limit));
      // The next pipeline is likely to be wrong there, too.
      if (worst > limit) std::rotate(order_.begin(), frame, frame + 1);
    }
    return worst;
  }

  // The same as wrong_px(), by the picture that the frame itself draws.
  std::uint64_t wrong_px_of_draw(const Frame& frame, const Pipeline& pipeline) {
    first_ = kNone, wrong_ = 0, limit_ = kNoLimit;
    right_ = frame.right_picture(), frame_ = nullptr;
    const auto drawn = picture(frame, pipeline);
    for (std::size_t pixel = 0; pixel < drawn.size(); ++pixel) add(pixel, drawn[pixel]);
    return wrong_;
  }
  std::vector<std::uint32_t> picture(const Frame& frame, const Pipeline& pipeline) {
    frame.frame.draw(pipeline, memory_);
    frame_ = nullptr;
    return memory_.picture();
  }

  // The first wrong pixel of the last frame, all of which was compared.
  Witness witness(const Frame& frame) const {
    const auto ids = [](std::uint32_t id) {
      return id == kNoTriangle ? std::vector<std::uint32_t>{} : std::vector{id};
    };
    const int pixel = static_cast<int>(first_), width = frame.frame.size().width;
    return {frame.index, pixel % width, pixel / width, ids(right_[first_]), ids(shown_)};
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  void assemble(const Frame& frame, Pipeline pipeline) {
    pipeline[kVisibility] = pipeline[kDepth] = 0;
    if (frame_ == &frame && assembled_ == pipeline) return;
    if (frame_ != &frame) right_ = frame.right_picture();
    frame_ = &frame, assembled_ = pipeline;
    frame.frame.assemble(pipeline, memory_);
    const std::vector<VisibilityTriangle>& triangles = memory_.scene.triangles;
    mean_.resize(triangles.size()), farthest_.resize(triangles.size());
    bands_.clear(), in_band_.clear();
    bands_.resize(static_cast<std::size_t>((memory_.scene.height + kBandRows - 1) / kBandRows));
    in_band_.resize(bands_.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const double(&z)[3] = triangles[i].view_z;
      mean_[i] = (z[0] + z[1] + z[2]) / 3, farthest_[i] = std::max({z[0], z[1], z[2]});
      const contract::PixelBox box =
          contract::pixel_box(triangles[i].screen, memory_.scene.width, memory_.scene.height);
      for (int band = box.y0 / kBandRows; band * kBandRows < box.y1; ++band)
        in_band_[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(i));
    }
  }

  const Band& fragments_of(std::size_t i) {
    const int y0 = static_cast<int>(i) * kBandRows;
    if (!bands_[i])
      bands_[i] =
          band_of(memory_.scene, in_band_[i], y0, std::min(y0 + kBandRows, memory_.scene.height), drawn_);
    return *bands_[i];
  }

  void compare(std::size_t band, const Pipeline& pipeline) {
    const int bits = pipeline[kDepth] + 1;
    if (pipeline[kVisibility] == 0) return compare(band, [](Fragments all) { return all.back().triangle; });
    if (pipeline[kVisibility] != kDepthBuffer)
      return compare(band, [&keys = pipeline[kVisibility] == 1 ? mean_ : farthest_](Fragments all) {
        return last_painted(all, keys);
      });
    if (bits == kOurDepthBits)
      return compare(band, [](Fragments all) {
        return nearest(all, contract::kDepthClear, [](const Fragment& f) { return f.contract31; });
      });
    const std::int32_t max = (1 << bits) - 1;
    compare(band, [max](Fragments all) {
      return nearest(all, static_cast<std::uint32_t>(max), [max](const Fragment& f) {  // as UnormPlane
        const double scaled = std::clamp(f.depth01 * max + 0.5, 0.0, static_cast<double>(max));
        return static_cast<std::uint32_t>(scaled);
      });
    });
  }

  template <typename Choose>
  void compare(std::size_t i, Choose&& choose) {
    const Band& band = fragments_of(i);
    const std::size_t first = i * kBandRows * static_cast<std::size_t>(memory_.scene.width);
    for (std::size_t pixel = 0; pixel + 1 < band.begin.size() && wrong_ <= limit_; ++pixel) {
      const Fragments all =
          std::span(band.fragments).subspan(band.begin[pixel], band.begin[pixel + 1] - band.begin[pixel]);
      const std::uint32_t triangle = all.empty() ? kNoTriangle : choose(all);
      add(first + pixel,
          triangle == kNoTriangle ? triangle : memory_.scene.triangles[triangle].screen.payload);
    }
  }

  void add(std::size_t pixel, std::uint32_t shown) {
    if (shown == right_[pixel]) return;
    ++wrong_;
    if (pixel < first_) first_ = pixel, shown_ = shown;
  }

  PipelineMemory memory_;
  const Frame* frame_ = nullptr;  // that of these:
  Pipeline assembled_{};
  std::vector<std::uint32_t> right_;
  std::vector<double> mean_, farthest_;              // the painters' keys, by triangle
  std::vector<std::vector<std::uint32_t>> in_band_;  // the triangles that reach each band
  std::vector<std::optional<Band>> bands_;           // those that were needed
  std::vector<std::pair<std::size_t, Fragment>> drawn_;
  std::uint64_t wrong_ = 0, limit_ = 0;
  std::size_t first_ = kNone;
  std::uint32_t shown_ = 0;  // at the first wrong pixel
  std::size_t hard_band_ = 0;
  std::vector<std::size_t> order_;  // of frames
};

std::vector<std::uint32_t> PipelineNeeds::Frame::right_picture() const {
  std::vector<std::uint32_t> picture;
  for (const auto& [id, end] : right) picture.resize(end, id);
  return picture;
}

void PipelineNeeds::start(const StudiedFrame& frame) {
  if (std::holds_alternative<Scene>(frame.drawable)) {
    stages_ = {kNearPlane, kFarPlane, kGuardBand};
    if (frame.options.cull == Cull::back) stages_.push_back(kFacing);
  }
  stages_.insert(stages_.end(), {kVisibility, kDepth, kSubpixel});
  for (const Stage stage : stages_) {
    curves_[stage] = {stage, {}};
    for (std::string& name : levels_of(stage)) curves_[stage].levels.push_back({std::move(name)});
  }
}

void PipelineNeeds::add_to(Level& level, std::uint64_t wrong_px, const Frame& frame, const Pipeline& pipeline,
                           Judge& judge) const {
  level.wrong_px += wrong_px;
  level.worst_px = std::max(level.worst_px, wrong_px);
  if (wrong_px <= tolerance_px_ || !level.enough()) return;
  level.witness = judge.witness(frame);
  if (!frame.keep_pictures) return;
  const auto [width, height] = frame.frame.size();
  level.picture =
      mark_visible_triangles(frame.right_picture(), judge.picture(frame, pipeline), {width, height});
}

void PipelineNeeds::add(const StudiedFrame& studied, const CoverageScene& scene,
                        const std::array<Reach, kViewPlanes>& reach, int threads) {
  if (frames_.empty()) start(studied);
  Frame& frame = frames_.emplace_back(
      Frame{studied.index, studied.keep_pictures, PipelineFrame(studied.drawable, studied.options), {}});
  const std::vector<std::uint32_t> right = right_picture(scene, threads);
  for (std::size_t i = 0; i < right.size(); ++i)
    if (i + 1 == right.size() || right[i] != right[i + 1]) frame.right.emplace_back(right[i], i + 1);

  std::map<Pipeline, std::vector<Level*>> by_pipeline;  // those that share an assembly stand together
  for (const Stage stage : stages_)
    for (int level = 0; Level & at : curves_[stage].levels) {
      Pipeline pipeline = exact_pipeline();
      // Of a plane that no triangle reaches, or that none crosses, weaker levels draw the same triangles.
      const bool same =
          stage < kViewPlanes && (level == kNothing ? reach[stage].beyond : reach[stage].crossing) == 0;
      if (!same) pipeline[stage] = level;
      by_pipeline[pipeline].push_back(&at), ++level;
    }
  const std::vector<std::pair<Pipeline, std::vector<Level*>>> trials(by_pipeline.begin(), by_pipeline.end());
  std::vector<Judge> judges(static_cast<std::size_t>(threads));
  for_each_task(judges, trials.size(), [&](std::size_t i, Judge& judge) {
    const auto& [pipeline, levels] = trials[i];
    const bool floats = pipeline[kDepth] > exact_pipeline()[kDepth];
    const std::uint64_t wrong_px =
        floats ? judge.wrong_px_of_draw(frame, pipeline) : judge.wrong_px(frame, pipeline, kNoLimit);
    for (Level* const level : levels) add_to(*level, wrong_px, frame, pipeline, judge);
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

// Judges pipelines, the weaker ones first, on several threads. What is found does not depend on their number.
class PipelineNeeds::Search {
 public:
  Search(const PipelineNeeds& needs, const Pipeline& strongest, int threads)
      : needs_(needs), judges_(static_cast<std::size_t>(threads)) {
    add_all(strongest, Pipeline{}, 0);
  }

  std::vector<Pipeline> minima(const std::function<void(std::size_t)>& judged) {
    std::vector<Pipeline> right;
    const auto has_weaker = [&](const Pipeline& pipeline) {
      return std::ranges::any_of(right, [&](const Pipeline& other) { return is_weaker(other, pipeline); });
    };
    for_each_pipeline([&](std::size_t i, Judge& judge) {
      {
        const std::scoped_lock lock(mutex_);
        if (++begun_ % 100 == 0) judged(begun_);
        if (has_weaker(all_[i])) return;
      }
      if (judge.worst_px(needs_.frames_, all_[i], needs_.tolerance_px_) > needs_.tolerance_px_) return;
      const std::scoped_lock lock(mutex_);
      right.push_back(all_[i]);
    });
    std::vector<Pipeline> least;
    std::ranges::copy_if(right, std::back_inserter(least), std::not_fn(has_weaker));
    std::ranges::sort(least);
    return least;
  }

  // The pipeline whose worst frame has the fewest wrong pixels, and their number; of several, the first one.
  std::pair<Pipeline, std::uint64_t> closest(std::uint64_t exact_px) {
    std::size_t best = all_.size() - 1;
    for_each_pipeline([&](std::size_t i, Judge& judge) {
      const auto limit = [&] { return exact_px - (i > best ? 1 : 0); };
      std::unique_lock lock(mutex_);
      const std::uint64_t before = limit();
      lock.unlock();
      const std::uint64_t worst = judge.worst_px(needs_.frames_, all_[i], before);
      lock.lock();
      if (worst <= limit()) best = i, exact_px = worst;
    });
    return {all_[best], exact_px};
  }

  std::size_t size() const { return all_.size(); }

 private:
  // Those that differ in visibility only share an assembly, so one thread judges them.
  template <typename Body>
  void for_each_pipeline(Body&& body) {
    constexpr std::size_t kTogether = kDepthBuffer + kOurDepthBits;
    for_each_task(judges_, all_.size() / kTogether, [&](std::size_t task, Judge& judge) {
      for (std::size_t i = 0; i < kTogether; ++i) body(task * kTogether + i, judge);
    });
  }

  // In lexicographic order, so that weaker ones come first.
  void add_all(const Pipeline& strongest, Pipeline pipeline, std::size_t stage) {
    if (stage == kStages) return all_.push_back(pipeline);
    const bool studied = std::ranges::find(needs_.stages_, Stage(stage)) != needs_.stages_.end();
    const bool has_depths = stage != kDepth || pipeline[kVisibility] == kDepthBuffer;
    for (pipeline[stage] = studied ? 0 : strongest[stage]; pipeline[stage] <= strongest[stage];
         ++pipeline[stage]) {
      add_all(strongest, pipeline, stage + 1);
      if (!has_depths) return;
    }
  }

  const PipelineNeeds& needs_;
  std::vector<Pipeline> all_;
  std::vector<Judge> judges_;
  std::mutex mutex_;
  std::size_t begun_ = 0;
};

Minima PipelineNeeds::minima(const Ranges& ranges, int threads,
                             const std::function<void(std::size_t)>& judged) const {
  Search search(*this, strongest(ranges), threads);
  const auto levels_of_pipeline = [&](const Pipeline& pipeline) {
    Levels levels;
    for (const Stage stage : stages_)
      if (stage != kDepth || pipeline[kVisibility] == kDepthBuffer)
        levels[name_of(stage)] = curves_[stage].levels[static_cast<std::size_t>(pipeline[stage])].name;
    return levels;
  };
  Minima result{{}, search.size()};
  for (const Pipeline& pipeline : search.minima(judged)) result.right.push_back(levels_of_pipeline(pipeline));
  if (!result.right.empty()) return result;
  const auto [closest, px] = search.closest(curves_[kSubpixel].levels.back().worst_px);
  result.closest = levels_of_pipeline(closest), result.closest_px = px;
  return result;
}

}  // namespace edgewise::lab
