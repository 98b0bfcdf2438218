#include "bench/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>

#include "bench/workloads/laboratory.h"
#include "support/console.h"
#include "support/options.h"

namespace edgewise::bench {

namespace {

constexpr int kThreads[] = {1, 2};  // of all rows but a scene's frames, which may have more
// The backends whose whole frames are repeated as often as cells are, if they are short.
constexpr std::string_view kCompared[] = {"scanline", "tiled"};
constexpr double kShortFrame_s = 0.05;

using WorkloadPtr = std::shared_ptr<Workload>;

SceneRequest request(const SuiteOptions& options) {
  return {.width = options.width, .height = options.height, .scale = options.scale};
}

// `count` triangles of `area_px` at random positions and depths.
tools::Source random_source(const SuiteOptions& options, std::size_t count, double area_px) {
  return {"random", random_stream({.width = options.width, .height = options.height}, count, area_px, 0.0, 1),
          true};
}

// Whether the suite times coverage methods on this scene.
bool is_timed(const lab::LabScene& scene) {
  constexpr std::string_view kTimed[] = {"mesh_on_grid", "mesh", "torus-knot"};
  return scene.family == lab::Family::coverage && std::ranges::find(kTimed, scene.name) != std::end(kTimed);
}

constexpr std::string_view kQuickScenes[] = {"cubes", "torus-knot", "large", "grid4"};

// Of the scenes of a quick run.
bool in_quick_run(const Row& row) {
  if (is_choice(row)) return true;
  if (is_cell(row)) return row.execution.threads == tools::default_threads();
  const bool plain = row.name.find(':') == row.name.rfind(':');  // threads:N alone
  return plain && row.timed != Timed::raster;
}

// Large triangles lose much of their area at the image's borders, so the count is corrected by the coverage
// of a first attempt.
tools::Source area_source(const SuiteOptions& options, double area_px) {
  constexpr double kTargetArea_px = 4e6;
  const auto at_least_a_few = [](double count) {
    return static_cast<std::size_t>(std::max(4.0, std::round(count)));
  };
  const std::size_t count = at_least_a_few(kTargetArea_px / area_px);
  if (area_px < 1e3) return random_source(options, count, area_px);
  Workload attempt(options.width, options.height, Cull::none,
                   [&] { return random_source(options, count, area_px); });
  attempt.prepare(false);
  const double covered_px = std::max(1.0, static_cast<double>(attempt.covered_px()));
  return random_source(options, at_least_a_few(static_cast<double>(count) * kTargetArea_px / covered_px),
                       area_px);
}

class Suite {
 public:
  explicit Suite(const SuiteOptions& options) : options_(options) {}

  void add_scene(const WorkloadPtr& workload, const std::string& name) {
    for (const int threads : options_.threads)
      add_row(workload, Timed::frontend, fmt::format("frontend/{}/threads:{}", name, threads), threads);
    for (const auto& backend : backends())
      for (const int threads : options_.threads) {
        add(workload, Timed::raster, backend, name, threads);
        add_frame(workload, backend, name, threads);
      }
    for (const SimdTarget target : supported_targets())
      if (target != SimdTarget::scalar && target != resolve(SimdTarget::best))
        for (const int threads : kThreads)
          add(workload, Timed::frame, find_backend("tiled"),
              fmt::format("{}/target:{}", name, name_of(target)), threads, target);
    if (!options_.peers) return;
    for (const auto& peer : lab::benchmark_peers()) {
      for (int threads = 1; threads <= peer.most_threads; ++threads) add_peer(workload, peer, name, threads);
      if (!peer.own_clock) continue;
      add_peer(workload, peer, name + "/clock:device", 1);
      rows_.back().device_clock = true;
    }
  }

  // Frames that differ in one factor at a time, on all threads. Those with vectors also on one.
  void add_cells(const WorkloadPtr& workload, const std::string& scene) {
    const std::set<int> thread_counts{1, tools::default_threads()};
    for (const Cell& cell : cells())
      for (const int threads : thread_counts) {
        if (threads < tools::default_threads() && cell.target == SimdTarget::scalar) continue;
        add(workload, Timed::frame, *cell.backend, scene, threads, cell.target);
        rows_.back().name = fmt::format("cell/{}/{}/threads:{}", scene, cell.factors, threads);
        rows_.back().many_rounds_up_to_s = kTooSlowToRepeat_s;
      }
  }

  // What exactness costs in the backend `tiled`: its engine with other arithmetic in the edge functions, on
  // streams of few and of many triangles, with and without overdraw. The first row is the backend without
  // coverage masks, which only the exact arithmetic allows.
  void add_engine_runs(const WorkloadPtr& workload, const std::string& scene) {
    constexpr std::string_view kScenes[] = {"large", "medium", "small", "grid64"};
    if (std::ranges::find(kScenes, scene) == std::end(kScenes)) return;
    using lab::EngineArithmetic;
    constexpr std::pair<std::string_view, EngineArithmetic> kArithmetics[] = {
        {"exact", EngineArithmetic::exact},
        {"int64", EngineArithmetic::int64},
        {"double", EngineArithmetic::float64},
        {"float", EngineArithmetic::float32},
        {"float_rebased", EngineArithmetic::float32_rebased},
        {"int32", EngineArithmetic::int32}};
    for (const auto& [name, arithmetic] : kArithmetics) {
      add(workload, Timed::raster, find_backend("tiled"), fmt::format("{}/engine:{}", scene, name), 1);
      rows_.back().arithmetic = arithmetic;
    }
  }

  void add_area_sweep() {
    for (const double area_px : {1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6}) {
      const auto workload =
          make_workload([options = options_, area_px] { return area_source(options, area_px); });
      for (const auto& backend : backends())
        for (const int threads : kThreads)
          add(workload, Timed::raster, backend, fmt::format("area:{:.0f}", area_px), threads);
    }
  }

  void add(std::vector<Row> rows) { std::ranges::move(rows, std::back_inserter(rows_)); }

  // Of our methods and of peers.
  void add_choices(const lab::ChoiceScene& scene) {
    const std::size_t first = rows_.size();
    add(choice_rows(scene));
    const auto workload =
        std::make_shared<Workload>(scene.size.width, scene.size.height, Cull::back, [scene] {
          Drawable drawable = scene.make(0);
          const bool stream = std::holds_alternative<TriangleStream>(drawable);
          return tools::Source{std::string(scene.name), std::move(drawable), stream};
        });
    for (const auto& peer : lab::benchmark_peers()) {
      if (!options_.peers || peer.own_clock) continue;  // a GPU
      add_row(workload, Timed::frame, choice_name(scene, peer.name), 1).peer = &peer;
    }
    for (std::size_t i = first; i < rows_.size(); ++i) rows_[i].many_rounds_up_to_s = kTooSlowToRepeat_s;
  }

  WorkloadPtr make_workload(std::function<tools::Source()> load) const {
    return std::make_shared<Workload>(options_.width, options_.height, Cull::back, std::move(load));
  }

  std::vector<Row> take() {
    for (const Row& row : rows_)
      if (row.workload) row.workload->set_subpixel_bits(options_.subpixel_bits);
    return std::move(rows_);
  }

 private:
  void add(const WorkloadPtr& workload, Timed timed, const BackendInfo& backend, const std::string& what,
           int threads, SimdTarget target = SimdTarget::best) {
    const char* with = timed == Timed::frame ? "+frontend" : "";
    Row& row = add_row(workload, timed, fmt::format("{}{}/{}/threads:{}", backend.name, with, what, threads),
                       threads);
    row.backend = &backend;
    row.execution.target = backend.name == "naive" ? SimdTarget::scalar : target;  // all of it
  }

  // As a user would draw it.
  void add_frame(const WorkloadPtr& workload, const BackendInfo& backend, const std::string& what,
                 int threads) {
    add(workload, Timed::frame, backend, what, threads);
    if (std::ranges::find(kCompared, backend.name) != std::end(kCompared))
      rows_.back().many_rounds_up_to_s = kShortFrame_s;
  }

  void add_peer(const WorkloadPtr& workload, const lab::PeerInfo& peer, const std::string& scene,
                int threads) {
    add_row(workload, Timed::frame, fmt::format("{}+frontend/{}/threads:{}", peer.name, scene, threads),
            threads)
        .peer = &peer;
  }

  Row& add_row(const WorkloadPtr& workload, Timed timed, std::string name, int threads) {
    Row& row = rows_.emplace_back();
    row.name = std::move(name);
    row.workload = workload;
    row.timed = timed;
    row.execution.threads = threads;
    return row;
  }

  const SuiteOptions& options_;
  std::vector<Row> rows_;
};

}  // namespace

std::set<int> default_thread_counts() {
  std::set<int> counts{1, 2, tools::default_threads()};
  for (int threads = 4; threads < tools::default_threads(); threads *= 2) counts.insert(threads);
  return counts;
}

std::string name_in_rows(const std::string& name_or_path) {
  std::string name = tools::printable(tools::source_name(name_or_path));
  std::replace(name.begin(), name.end(), ':', '_');
  return name;
}

std::vector<Cell> cells() {
  std::vector<Cell> all;
  for (const std::string traversal : {"bands", "tiles"})
    for (const std::string fill : {"spans", "edges"})
      for (const std::string with : {"", "hiz", "hiz+masks"})
        for (const SimdTarget target : {SimdTarget::scalar, SimdTarget::best})
          if (with.empty() || (traversal == "tiles" && target == SimdTarget::best))  // both need vectors
            all.push_back({&find_backend(traversal + "+" + fill + (with.empty() ? "" : "+" + with)), target,
                           fmt::format("traversal:{}/fill:{}/simd:{}{}", traversal, fill,
                                       name_of(resolve(target)), with.empty() ? "" : "/with:" + with)});
  return all;
}

std::vector<Row> make_suite(const SuiteOptions& options) {
  Suite suite(options);
  std::map<std::string, std::string> taken;  // name in rows, source
  const auto add_named = [&](const std::string& scene) {
    // Load now, so that an invalid file fails before anything is timed.
    const tools::Source source = tools::load_source(scene, request(options), options.fit);
    const std::string name = name_in_rows(scene);
    if (const auto [other, is_new] = taken.emplace(name, scene); !is_new)
      throw std::invalid_argument(
          fmt::format("--scene {} and --scene {} would both be named '{}'", other->second, scene, name));
    const auto* stream = std::get_if<TriangleStream>(&source.drawable);
    const bool own_size = stream && !options.size_asked;
    const lab::Size size{own_size ? stream->width : options.width,
                         own_size ? stream->height : options.height};
    const auto workload =
        std::make_shared<Workload>(size.width, size.height, Cull::back, [source] { return source; });
    suite.add_scene(workload, name);
    suite.add_cells(workload, name);
    if (options.methods)
      suite.add(method_rows(lab::own_coverage_scene(name, [source, size] {
        return lab::SizedDrawable{source.drawable, size};
      })));
  };
  for (const auto& scene : options.scenes) add_named(scene);
  if (!options.scenes.empty()) return suite.take();

  for (const auto& scene : builtin_scenes()) {
    const std::string name(scene.name);
    if (options.quick && std::ranges::find(kQuickScenes, name) == std::end(kQuickScenes)) continue;
    taken.emplace(name, name);
    const auto workload = suite.make_workload(
        [name, wanted = request(options)] { return tools::load_source(name, wanted, false); });
    suite.add_scene(workload, name);
    suite.add_cells(workload, name);
    suite.add_engine_runs(workload, name);
  }
  for (const auto& scene : options.more_scenes) add_named(scene);
  suite.add_area_sweep();
  for (const lab::LabScene& scene : lab::lab_scenes(options.quick))
    if (is_timed(scene)) suite.add(method_rows(scene));
  for (const lab::ChoiceScene& scene : lab::choice_scenes(options.quick)) suite.add_choices(scene);
  if (!options.needs.empty()) suite.add(pipeline_rows(options.needs));
  std::vector<Row> rows = suite.take();
  if (options.quick) std::erase_if(rows, [](const Row& row) { return !in_quick_run(row); });
  return rows;
}

}  // namespace edgewise::bench
