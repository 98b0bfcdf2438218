// The benchmark draws every row once and compares it bit for bit, then times all rows in interleaved
// repetitions, so that a burst of other load on the machine does not hit one row alone.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <span>

#include "bench/program/flags.h"
#include "bench/program/reporter.h"
#include "bench/workloads/stage.h"
#include "core/parallel.h"
#include "files/atomic_file.h"
#include "support/console.h"
#include "support/json.h"
#include "support/machine.h"
#include "support/options.h"
#include "support/output_path.h"
#include "support/process.h"
#include "support/progress.h"

namespace edgewise::bench {

constexpr const char* kProgram = "edgewise_bench";

namespace {

// The least duration of a repetition. Noise comes in bursts, so many short repetitions measure better than a
// few long ones.
constexpr double kRepetition_s = 0.012;

// The rounds that time a row. Stopping as soon as a pair is settled would find differences that do not exist.
constexpr int kRounds = 9, kManyRounds = 36;

// Passes Google Benchmark our defaults first, so that the user's flags override them.
void initialize_benchmark(const Flags& flags) {
  // Static, since Google Benchmark keeps a pointer to the program's name.
  static std::vector<std::string> words{"edgewise_bench", "--benchmark_enable_random_interleaving=true",
                                        "--benchmark_counters_tabular=true"};
  words.insert(words.end(), flags.benchmark.begin(), flags.benchmark.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  int argc = static_cast<int>(argv.size());
  benchmark::Initialize(&argc, argv.data());
  if (argc > 1) throw std::invalid_argument(tools::unknown_option(argv[1], flags.known, kProgram));
}

class SilentReporter final : public benchmark::BenchmarkReporter {
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>&) override {}
};

// The rows that match --benchmark_filter, in the suite's order. Google Benchmark applies the filter to empty
// benchmarks of the same names. None if it reported that no row matches; an empty list after
// --benchmark_list_tests.
std::optional<std::vector<Row>> select(std::vector<Row> suite) {
  std::vector<char> selected(suite.size(), 0);
  for (std::size_t i = 0; i < suite.size(); ++i)
    benchmark::RegisterBenchmark(suite[i].name.c_str(), [&selected, i](benchmark::State& state) {
      selected[i] = 1;
      state.SkipWithError("only selected");
    });
  SilentReporter silent;
  if (benchmark::RunSpecifiedBenchmarks(&silent) == 0) return std::nullopt;
  benchmark::ClearRegisteredBenchmarks();
  std::vector<Row> rows;
  for (std::size_t i = 0; i < suite.size(); ++i)
    if (selected[i]) rows.push_back(std::move(suite[i]));
  return rows;
}

// A peer that was built cannot start on a machine without its driver.
void leave_out_missing_peers(std::vector<Row>& rows, bool need_peers) {
  const bool some = std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.peer != nullptr; });
  if (!some && !need_peers) return;
  const lab::StartedPeers started = lab::start_peers(lab::benchmark_peers());
  if (need_peers) started.require_one();
  for (const auto& [peer, version] : started.peers)
    benchmark::AddCustomContext(std::string(peer->name), version);
  for (const std::string& reason : started.left_out) std::cerr << "Left out: " << reason << '\n';
  for (Row& row : rows)
    for (const auto& [peer, version] : started.peers)
      if (row.peer != nullptr && row.peer->name == peer->name) row.peer_version = version;
  std::erase_if(rows, [](const Row& row) { return row.peer != nullptr && row.peer_version.empty(); });
}

// Goes workload by workload, so that only one reference picture is in memory at a time.
void compare_all(std::vector<Row>& rows, Stage& stage) {
  tools::Progress progress;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    progress.show(static_cast<double>(i) / static_cast<double>(rows.size()), "comparing " + rows[i].name);
    const auto& workload = rows[i].workload;
    const auto needs_scene = [&](const Row& row) {
      return row.workload == workload && row.timed != Timed::raster;
    };
    if (workload) workload->prepare(std::ranges::any_of(rows, needs_scene));
    stage.compare(rows[i]);
    if (workload && (i + 1 == rows.size() || rows[i + 1].workload != workload)) workload->drop_reference();
  }
}

// If the draw takes seconds, the front end's milliseconds are lost in the noise.
void leave_out_slow_frames(std::vector<Row>& rows) {
  std::erase_if(rows, [&](const Row& row) {
    const bool slow = row.timed == Timed::frame && row.once_s > kTooSlowToDrawTwice_s;
    if (slow) std::cerr << "Left out as too slow: " << row.name << '\n';
    return slow;
  });
}

// Rows that are not repeated: wrong ones, and those that the comparison has already timed.
bool is_known(const Row& row) {
  return !row.error.empty() || (row.once_s > kTooSlowToRepeat_s && !is_cell(row));
}

int rounds_of(const Row& row, const Flags& flags) {
  if (is_known(row)) return 1;
  const bool many = !flags.suite.quick && row.once_s < row.many_rounds_up_to_s;
  return flags.repetitions.value_or(many ? kManyRounds : kRounds);
}

void time_row(benchmark::State& state, Row& row, Stage& stage) {
  if (!row.error.empty()) return state.SkipWithError(row.error.c_str());
  if (is_known(row)) {
    for (auto _ : state) state.SetIterationTime(row.once_s);
  } else {
    // The caches hold another row's data. A draw over kTooSlowToRepeat_s needs no warm-up.
    if (stage.renew_memory(row) || row.once_s < kTooSlowToRepeat_s) stage.work(row);
    for (auto _ : state) {
      const double frame_s = stage.timed_work_s(row);
      if (row.device_clock) state.SetIterationTime(frame_s);
    }
  }
  auto& counters = state.counters;
  if (row.peer != nullptr) state.SetLabel(row.peer_version);
  if (row.triangles) counters["triangles"] = static_cast<double>(*row.triangles);
  if (!row.workload) return;
  const Workload& workload = *row.workload;
  counters["width"] = workload.width();
  counters["height"] = workload.height();
  counters["triangles"] =
      static_cast<double>(row.timed == Timed::raster ? workload.triangles().size() : workload.submitted());
  if (row.wrong_px) counters["wrong_px"] = static_cast<double>(*row.wrong_px);
  if (row.timed == Timed::frontend) return;
  const auto covered_px = static_cast<double>(workload.covered_px());
  counters["covered_px"] = covered_px;
  counters["overdraw"] = covered_px / (static_cast<double>(workload.width()) * workload.height());
  if (row.peer != nullptr) counters["depth_ties"] = static_cast<double>(row.depth_ties);
}

void register_rows(std::vector<Row>& rows, Stage& stage, const Flags& flags, int round,
                   const std::function<void(const Row&)>& begin) {
  for (Row& row : rows) {
    const bool known = is_known(row);
    if (round >= rounds_of(row, flags)) continue;
    auto* registered =
        benchmark::RegisterBenchmark(row.name.c_str(), [&row, &stage, begin](benchmark::State& state) {
          begin(row);
          time_row(state, row, stage);
        });
    registered->Unit(benchmark::kMillisecond);
    if (known || row.device_clock)
      registered->UseManualTime();
    else
      registered->UseRealTime();
    if (flags.own_iterations || known)
      registered->Iterations(
          known ? 1 : static_cast<std::int64_t>(std::ceil(kRepetition_s / std::max(row.once_s, 1e-6))));
  }
}

// In each round rows are timed once, in random order: repetition i of one row and of another form a pair.
void time_all(std::vector<Row>& rows, Stage& stage, const Flags& flags, Reporter& reporter) {
  tools::Progress progress;
  int most_rounds = 1, made = 0, all = 0;
  for (const Row& row : rows) {
    most_rounds = std::max(most_rounds, rounds_of(row, flags));
    all += rounds_of(row, flags);
  }
  const auto begin = [&](const Row& row) {
    progress.show(std::min(1.0, static_cast<double>(made++) / all), "timing " + row.name);
  };
  for (int round = 0; round < most_rounds; ++round) {
    benchmark::ClearRegisteredBenchmarks();
    register_rows(rows, stage, flags, round, begin);
    benchmark::RunSpecifiedBenchmarks(&reporter, ".");
  }
}

void add_context(const Flags& flags, std::span<const Row> rows) {
  std::vector<std::string_view> names, peers;  // peers: with whole frames
  for (const BackendInfo& backend : backends()) names.push_back(backend.name);
  for (const Row& row : rows)
    if (row.peer != nullptr && row.workload &&
        std::find(peers.begin(), peers.end(), row.peer->name) == peers.end())
      peers.push_back(row.peer->name);
  const auto machine = tools::machine_description();
  benchmark::AddCustomContext("machine", tools::machine_name());
  for (const char* key : {"build_type", "commit"})
    if (machine.contains(key) && machine[key].is_string())
      benchmark::AddCustomContext(key, machine[key].get<std::string>());
  benchmark::AddCustomContext("simd_target", std::string(name_of(resolve(SimdTarget::best))));
  benchmark::AddCustomContext("suite", flags.suite.quick            ? "quick"
                                       : flags.suite.scenes.empty() ? "full"
                                                                    : "scenes");
  benchmark::AddCustomContext("backends", fmt::format("{}", fmt::join(names, " ")));
  benchmark::AddCustomContext("peers", fmt::format("{}", fmt::join(peers, " ")));
  benchmark::AddCustomContext("subpixel_bits", std::to_string(flags.suite.subpixel_bits));
  benchmark::AddCustomContext("rounds", std::to_string(flags.repetitions.value_or(kRounds)));
}

int run(int argc, char** argv) {
  const auto parsed = parse_flags(argc, argv);
  if (!parsed) return 0;
  const Flags& flags = *parsed;
  initialize_benchmark(flags);
  std::vector<tools::Output> files;
  if (!flags.out.empty()) files.push_back({"--benchmark_out", flags.out});
  std::vector<std::string> read = flags.suite.scenes;
  read.insert(read.end(), flags.suite.more_scenes.begin(), flags.suite.more_scenes.end());
  if (!flags.suite.needs.empty()) read.push_back(flags.suite.needs);
  tools::check_files(files, read);
  std::optional<AtomicFile> out;
  if (!flags.out.empty()) out.emplace(flags.out);
  auto selected = select(make_suite(flags.suite));
  if (!selected) return 2;
  if (selected->empty()) return 0;
  std::vector<Row>& rows = *selected;

  leave_out_missing_peers(rows, flags.need_peers);
  if (rows.empty()) return 2;
  Stage stage;
  compare_all(rows, stage);
  if (flags.suite.scenes.empty()) leave_out_slow_frames(rows);
  add_context(flags, rows);
  std::vector<std::string> names;
  for (const auto& row : rows) names.push_back(row.name);
  Reporter reporter(names);
  time_all(rows, stage, flags, reporter);
  reporter.finish();
  if (out) {
    out->stream() << reporter.json();
    out->commit();
  }
  return std::any_of(rows.begin(), rows.end(), [](const Row& row) { return !row.error.empty(); }) ? 1 : 0;
}

int failed(std::string_view why) {
  tools::print_error(why, kProgram);
  return 2;
}

int guarded(int argc, char** argv) try { return run(argc, argv); } catch (const std::exception& error) {
  return failed(tools::reason_of(error));
}

}  // namespace

}  // namespace edgewise::bench

int main(int argc, char** argv) {
  edgewise::allow_more_threads_than_cores();
  edgewise::tools::prepare_process(edgewise::bench::kProgram);
  const int status = edgewise::bench::guarded(argc, argv);
  if (edgewise::tools::stdout_is_whole() || status == 2) return status;
  return edgewise::bench::failed("cannot write to standard output");
}
