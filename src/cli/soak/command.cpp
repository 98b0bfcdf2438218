// `edgewise soak`: the judge on random pictures, for as long as one likes and on as many machines.
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
#include "support/progress.h"
#include "support/stop_request.h"

namespace edgewise::app {

namespace {

constexpr std::uint64_t kMostCases = std::uint64_t{1} << 39;
constexpr std::uint64_t kDefaultSeed = 1;

struct SoakOptions {
  std::optional<std::uint64_t> seed, cases, only_case;
  std::optional<soak::Shard> shard;
  std::optional<double> seconds;
  int jobs = all_cores();
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
  // A job that a scheduler starts again cannot know whether it got as far as a file.
  std::error_code unknown;  // left to read_record
  const bool begun =
      std::filesystem::status(o.resume, unknown).type() != std::filesystem::file_type::not_found;
  if (o.resume.empty() || !begun) return soak::new_record(seed, shard, names);
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
    const soak::Record record = soak::read_record(path);
    if (!all) {
      all = record;
      continue;
    }
    try {
      soak::merge(*all, record);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(
          fmt::format("{} cannot be added to those before it: {}", path, error.what()));
    }
  }
  return finish(o, o.json == "-" ? "" : o.json, *all, 0);
}

// Shows how far it is, and saves now and then what is done.
class Watch {
 public:
  Watch(const SoakOptions& o, std::string path, const soak::Record& first)
      : options_(o),
        path_(std::move(path)),
        cases_before_(first.tally.cases),
        seconds_before_(first.seconds) {
    if (!path_.empty()) write(path_, first);  // hours of work must not end in "cannot be written"
  }
  ~Watch() { progress_.erase(); }

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

// Hours of work must not be lost to a command that is given twice.
void check_nothing_is_lost(const SoakOptions& o) {
  std::error_code missing;
  if (!o.resume.empty() && std::filesystem::equivalent(o.resume, o.json, missing)) return;
  if (o.json != "-" && soak::is_record(o.json)) throw file_error(o.json, "exists; --resume goes on from it");
}

void check(const SoakOptions& o) {
  const bool draws_many = o.shard || o.seconds || o.cases || !o.resume.empty();
  if (o.only_case && draws_many)
    throw std::invalid_argument("--case and --shard, --for, --cases or --resume exclude each other");
  if (!o.merge.empty() && (o.seed || o.only_case || draws_many))
    throw std::invalid_argument("--merge draws nothing: it goes with --json alone");
}

int soak_command(const SoakOptions& o) {
  check(o);
  if (!o.merge.empty()) return merge_command(o);
  check_nothing_is_lost(o);
  soak::Record record = first_record(o);
  const std::string path = o.json.empty() ? o.resume : o.json == "-" ? "" : o.json;

  soak::Campaign campaign;
  campaign.judged.backends.assign(backends().begin(), backends().end());
  campaign.seconds = o.seconds;
  campaign.cases = o.only_case ? 1 : o.cases;
  campaign.jobs = o.only_case ? 1 : o.jobs;
  std::error_code unknown;  // the name alone must do then
  const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (!unknown) campaign.program = self.string();
  campaign.failure_folder = o.out;
  const StopRequest request;
  campaign.stop = [&] { return request.signal() != 0; };
  {
    Watch watch(o, path, record);
    campaign.on_progress = [&](const soak::Record& now) { watch(now); };
    campaign.on_failure = [&](const soak::Record& done) {
      if (!path.empty()) write(path, done);
    };
    record = soak::run(campaign, std::move(record));
  }
  return finish(o, path, record, request.signal());
}

constexpr const char* kSoakFooter = R"(Examples:
  edgewise soak --for 20m --json soak.json
  edgewise soak --resume soak.json --for 2h               goes on where that ended, or begins
  edgewise soak --seed 7 --shard 3/16 --for 1h --json shard-3.json
  edgewise soak --merge shard-*.json -o soak.json
  edgewise soak --seed 7 --case 123456                    one picture again

Random and adversarial pictures without end: triangle lists of many families, and scenes with the camera in
their midst that go through the front end. Each is drawn by every backend, on every SIMD target of this
machine, on one thread and on a random number of them, with random tile sizes, row strides, alignments and
optimizations left out, and compared bit for bit, in depth and payload and in all memory around the picture, with the
reference (the first backend of `edgewise list`, one thread, scalar). Wherever it can follow, the oracle
judges the reference. The front end is compared with itself, one triangle at a time.

Case k of shard I/N is number I + k N of the seed's sequence, whatever the machine: shards have nothing in
common and need not know of one another. --merge adds their results up, and refuses what does not belong
together: other seeds, programs (version and commit) or sequences, cases that two files share.

Without --for or --cases it goes on until Ctrl-C. On Ctrl-C, SIGTERM or SIGHUP the cases in work are
finished and all is written; twice ends it at once. With --json (or --resume) the file is also written every
half a minute, so that little is lost when the machine goes down. --resume of a file that isn't there yet begins
it, so that a job that may be started again names one file; --json alone refuses a record that exists.
A difference leaves a .tri with as few triangles as still differ, and the commands that show it again.

Exit status: 1 if anything differs; else 0, or 128 and the signal's number when stopped by one (130 after
Ctrl-C).)";

}  // namespace

void add_soak(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand(
      "soak", "Compare all backends on random pictures, for hours and on many machines");
  const auto o = std::make_shared<SoakOptions>();
  const auto add = [&](const char* name, const char* type, const char* help, auto parse) {
    command.add_option_function<std::string>(name, parse, help)->type_name(type);
  };
  add("--seed", "S", "Which sequence of cases (1)",
      [o](const std::string& text) { o->seed = parse_count("--seed", text, 0, ~std::uint64_t{0}); });
  add("--shard", "I/N", "Every N-th case from number I on (0/1: all)",
      [o](const std::string& text) { o->shard = parse_shard(text); });
  add("--for", "DURATION", "90s, 20m or 2h (until Ctrl-C)",
      [o](const std::string& text) { o->seconds = parse_duration("--for", text); });
  add("--cases", "N", "Stop after so many cases",
      [o](const std::string& text) { o->cases = parse_count("--cases", text, 1, kMostCases); });
  add("--case", "NUMBER", "Only this case",
      [o](const std::string& text) { o->only_case = parse_count("--case", text, 0, soak::kMostShards - 1); });
  add_integer(command, "--jobs", o->jobs, 1, kMaxThreads,
              "Cases drawn at once (all cores); no count depends on it");
  command.add_option("-o,--json", o->json, "Write the results as JSON; - for stdout, instead of the tables")
      ->type_name("FILE");
  command
      .add_option("--resume", o->resume,
                  "Go on from these results, if they exist, and write there (or to --json)")
      ->type_name("FILE");
  command.add_option("--merge", o->merge, "Add up results instead of drawing")->type_name("FILE");
  command.add_option("--out", o->out, "Folder for .tri files of differences (edgewise-soak-failures)")
      ->type_name("DIR");
  command.footer(kSoakFooter);
  command.callback([o, &action] { action = [o] { return soak_command(*o); }; });
}

}  // namespace edgewise::app
