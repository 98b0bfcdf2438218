// `edgewise soak`: compares all backends on random pictures, on one machine or on shards of many.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/soak/campaign.h"
#include "cli/soak/report.h"
#include "core/atomic_file.h"
#include "core/input_file.h"
#include "support/console.h"
#include "support/json_text.h"
#include "support/options.h"
#include "support/output_path.h"
#include "support/progress.h"
#include "support/source.h"
#include "support/stop_request.h"

namespace edgewise::tools {

namespace {

constexpr std::uint64_t kMostCases = std::uint64_t{1} << 39;
constexpr std::uint64_t kDefaultSeed = 1;

struct SoakOptions {
  std::optional<std::uint64_t> seed, cases, only_case;
  std::optional<soak::Shard> shard;
  std::optional<double> seconds;
  int jobs = default_threads();
  std::string json, resume, out = "edgewise-soak-failures";
  std::vector<std::string> merge;
};

soak::Shard parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  const std::string_view all = text;
  if (slash != std::string::npos) {
    const std::uint64_t of = parse_count("--shard", all.substr(slash + 1), 1, soak::kMostShards);
    return {parse_count("--shard", all.substr(0, slash), 0, of - 1), of, 0};
  }
  throw std::invalid_argument(fmt::format("--shard: '{}' is not I/N, with I from 0 to N - 1", text));
}

void write(const std::string& path, const soak::Record& record) {
  AtomicFile file(path);
  file.stream() << json_text(soak::to_json(record), 2) << '\n';
  file.commit();
}

soak::Record first_record(const SoakOptions& o) {
  std::vector<std::string> names;
  for (const BackendInfo& backend : backends()) names.emplace_back(backend.name);
  soak::Shard shard = o.shard.value_or(soak::Shard{});
  if (o.only_case) shard = {*o.only_case, *o.only_case + 1, 0};
  const std::uint64_t seed = o.seed.value_or(kDefaultSeed);
  // --resume accepts a missing file, so that a job that a scheduler restarts can always use the same command.
  std::error_code unknown;  // read_record reports other errors
  const bool exists =
      std::filesystem::status(o.resume, unknown).type() != std::filesystem::file_type::not_found;
  if (o.resume.empty() || !exists) return soak::new_record(seed, shard, names);
  const soak::Record before = soak::read_record(o.resume);
  if (!o.shard && before.shards.size() == 1) shard = before.shards.front();
  shard.cases = 0;
  try {
    return soak::continued(before, soak::new_record(o.seed.value_or(before.seed), shard, names));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{} cannot be continued: {}", o.resume, error.what()));
  }
}

int finish(const SoakOptions& o, const std::string& path, const soak::Record& record, int signal) {
  if (!path.empty()) write(path, record);
  print(o.json == "-" ? json_text(soak::to_json(record), 2) + '\n' : soak::report(record));
  if (record.tally.differences() != 0) return kDiffers;
  return signal == 0 ? kDone : 128 + signal;
}

int merge_command(const SoakOptions& o) {
  std::optional<soak::Record> all;
  for (const std::string& path : o.merge) {
    const soak::Record record = soak::read_record(input_path(path));
    if (!all) {
      all = record;
      continue;
    }
    try {
      soak::merge(*all, record);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(
          fmt::format("{} cannot be merged with the files before it: {}", path, error.what()));
    }
  }
  return finish(o, o.json == "-" ? "" : o.json, *all, 0);
}

// Shows the progress and saves the record every 30 s.
class ProgressSaver {
 public:
  ProgressSaver(const SoakOptions& o, std::string path, const soak::Record& first)
      : options_(o),
        path_(std::move(path)),
        cases_before_(first.tally.cases),
        seconds_before_(first.seconds) {
    if (!path_.empty()) write(path_, first);  // reports an unwritable file before hours of work
  }
  ~ProgressSaver() { progress_.erase(); }

  void operator()(const soak::Record& record) {
    constexpr auto kBetweenSaves = std::chrono::seconds(30);
    if (!path_.empty() && Clock::now() - saved_ >= kBetweenSaves) {
      write(path_, record);
      saved_ = Clock::now();
    }
    const double by_time = options_.seconds ? (record.seconds - seconds_before_) / *options_.seconds : 0.0;
    const double by_cases = options_.cases ? static_cast<double>(record.tally.cases - cases_before_) /
                                                 static_cast<double>(*options_.cases)
                                           : 0.0;
    const double fraction = std::max(by_time, by_cases);
    progress_.show(fraction, left_.label(fraction, fmt::format("{} frames, {} differ", record.tally.frames,
                                                               record.tally.differences())));
  }

 private:
  using Clock = std::chrono::steady_clock;
  const SoakOptions& options_;
  std::string path_;
  std::uint64_t cases_before_;
  double seconds_before_;
  Clock::time_point saved_ = Clock::now();
  Progress progress_;
  TimeLeft left_;
};

// Rejects a --json file that holds a record, unless it is the resumed one: repeating a command must not
// overwrite hours of work.
void check_overwrites_no_record(const SoakOptions& o) {
  std::error_code missing;
  if (!o.resume.empty() && std::filesystem::equivalent(o.resume, o.json, missing)) return;
  if (o.json != "-" && soak::is_record(o.json))
    throw file_error(o.json, "exists; use --resume to continue it");
}

void check(const SoakOptions& o) {
  const bool draws_many = o.shard || o.seconds || o.cases || !o.resume.empty();
  if (o.only_case && draws_many)
    throw std::invalid_argument("--case and --shard, --for, --cases or --resume exclude each other");
  if (!o.merge.empty() && (o.seed || o.only_case || draws_many))
    throw std::invalid_argument("--merge draws nothing: it can only be combined with --json");
}

int soak_command(const SoakOptions& o) {
  check(o);
  if (!o.merge.empty()) return merge_command(o);
  check_overwrites_no_record(o);
  check_json_file(o.json.empty() ? o.resume : o.json, o.out, {});
  soak::Record record = first_record(o);
  const std::string path = o.json.empty() ? o.resume : o.json == "-" ? "" : o.json;

  soak::Campaign campaign;
  campaign.judged.backends.assign(backends().begin(), backends().end());
  campaign.seconds = o.seconds;
  campaign.cases = o.only_case ? 1 : o.cases;
  campaign.jobs = o.only_case ? 1 : o.jobs;
  std::error_code unknown;  // then the default name stays
  const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (!unknown) campaign.program = self.string();
  campaign.failure_folder = o.out;
  const StopRequest request;
  campaign.stop = [&] { return request.signal() != 0; };
  {
    ProgressSaver saver(o, path, record);
    campaign.on_progress = [&](const soak::Record& now) { saver(now); };
    campaign.on_failure = [&](const soak::Record& done) {
      if (!path.empty()) write(path, done);
    };
    record = soak::run(campaign, std::move(record));
  }
  return finish(o, path, record, request.signal());
}

constexpr const char* kSoakFooter = R"(Examples:
  edgewise soak --for 20m --json soak.json
  edgewise soak --resume soak.json --for 2h               continue that record, or start it
  edgewise soak --seed 7 --shard 3/16 --for 1h --json shard-3.json
  edgewise soak --merge shard-*.json -o soak.json
  edgewise soak --seed 7 --case 123456                    reproduce one picture

A soak test draws random and adversarial pictures: triangle lists of many families, and scenes
around the camera that go through the front end. Every backend draws each picture on every SIMD
target of this machine, on one thread and on a random number of threads, with random tile sizes, row
strides and alignments, and with random optimizations switched off. Every frame is compared bit for
bit with the reference (the first backend of `edgewise list`, one thread, scalar): depth, payload,
and all memory around the picture. If a picture is small enough, an exact oracle checks the
reference. The front end is compared with its own code for single triangles.

Case k of shard I/N is number I + k N of the seed's sequence on every machine, so shards are
disjoint and independent. --merge adds up their results. It refuses results of different seeds,
programs (version and commit) or sequences, and cases that two files share.

Without --for or --cases the test runs until Ctrl-C. On Ctrl-C, SIGTERM or SIGHUP it finishes the
started cases and writes all results. The same signal again ends it at once. With --json (or
--resume) it also saves the file every 30 s. --resume creates a missing file, so a restarted job can
use the same command. --json alone refuses to overwrite a record. For each difference it writes a
.tri file with as few triangles as possible, and prints the commands that reproduce it.

Exit status: 1 if anything differs; otherwise 0, or 128 + N if stopped by signal N (130: Ctrl-C).)";

}  // namespace

void add_soak(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("soak", "Compare all backends on random pictures (soak test)");
  const auto o = std::make_shared<SoakOptions>();
  const auto add = [&](const char* name, const char* type, const char* help, auto parse) {
    command.add_option_function<std::string>(name, parse, help)->type_name(type);
  };
  add("--seed", "S", "Seed of the sequence of cases (1)",
      [o](const std::string& text) { o->seed = parse_count("--seed", text, 0, ~std::uint64_t{0}); });
  add("--shard", "I/N", "Draw every N-th case, starting at number I (0/1: all)",
      [o](const std::string& text) { o->shard = parse_shard(text); });
  add("--for", "DURATION", "Time limit: 90s, 20m or 2h (until Ctrl-C)",
      [o](const std::string& text) { o->seconds = parse_duration("--for", text); });
  add("--cases", "N", "Stop after N cases",
      [o](const std::string& text) { o->cases = parse_count("--cases", text, 1, kMostCases); });
  add("--case", "NUMBER", "Draw only this case",
      [o](const std::string& text) { o->only_case = parse_count("--case", text, 0, soak::kMostShards - 1); });
  add_integer(command, "--jobs", o->jobs, 1, kMaxThreads,
              "Cases drawn concurrently; results don't depend on it (usable cores)");
  command.add_option("-o,--json", o->json, "Write all results as JSON; - for stdout, instead of the tables")
      ->type_name("FILE");
  command
      .add_option("--resume", o->resume, "Continue these results if they exist; write there (or to --json)")
      ->type_name("FILE");
  command.add_option("--merge", o->merge, "Add up these results instead of drawing")->type_name("FILE");
  command.add_option("--out", o->out, "Folder for .tri files of differences (edgewise-soak-failures)")
      ->type_name("DIR");
  command.footer(kSoakFooter);
  command.callback([o, &action] { action = [o] { return soak_command(*o); }; });
}

}  // namespace edgewise::tools
