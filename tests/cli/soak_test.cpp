// The soak test: cases depend only on seed and number, shards add up, and deliberately wrong backends are
// found.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <map>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "cli/soak/campaign.h"
#include "cli/soak/case.h"
#include "cli/soak/reduce.h"
#include "cli/soak/report.h"
#include "cli/soak/scenes.h"
#include "cli/soak/triangles.h"
#include "edgewise/contract.h"
#include "edgewise/tri_file.h"
#include "message_of.h"
#include "run_program.h"
#include "support/options.h"
#include "temp_dir.h"
#include "wrong_backend.h"

namespace edgewise::soak {
namespace {

using testing::Outcome;

// FNV-1a hash of the content of a case.
class Fingerprint {
 public:
  explicit Fingerprint(const Case& c) {
    add(c.number), add(c.width), add(c.height), add(c.background), add(c.threads), add(c.draws_seed);
    add(c.triangles);
    add(c.frontend.cull), add(c.frontend.shade), add(c.frontend.payload);
    if (!c.drawable) return;
    if (const auto* stream = std::get_if<TriangleStream>(&*c.drawable)) {
      add(stream->triangles);
      return;
    }
    const Scene& scene = std::get<Scene>(*c.drawable);
    for (const Mesh& mesh : scene.meshes) add(mesh.positions), add(mesh.triangles), add(mesh.colours);
    for (const Instance& i : scene.instances) add(i.scale), add(i.axis), add(i.angle), add(i.translation);
    const Camera& camera = scene.camera;
    add(camera.position), add(camera.yaw), add(camera.pitch);
    add(camera.fov_y), add(camera.near_z), add(camera.far_z);
  }
  std::uint64_t value() const { return hash_; }

 private:
  template <typename T>
  void add(const std::vector<T>& list) {
    for (const T& element : list) add(element);
  }
  template <typename T>
  void add(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || !std::is_integral_v<T>);
    const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
    for (std::size_t i = 0; i < sizeof(T); ++i) hash_ = (hash_ ^ bytes[i]) * 0x100000001B3u;
  }
  std::uint64_t hash_ = 0xCBF29CE484222325u;
};

std::uint64_t fingerprint(std::uint64_t seed, std::uint64_t number) {
  return Fingerprint(make_case(seed, number)).value();
}

Campaign campaign_of(std::uint64_t cases) {
  Campaign campaign;
  campaign.judged.backends.assign(backends().begin(), backends().end());
  campaign.cases = cases;
  campaign.jobs = 2;
  return campaign;
}

Record fresh(std::uint64_t seed, const Shard& shard) {
  static const Record blank =
      new_record(0, {}, {"scanline", "naive", "tiled"});  // only once, because it calls git for the commit
  Record record = blank;
  record.seed = seed;
  record.shards = {shard};
  return record;
}

// Runs a campaign and passes its record through JSON, so that tests notice what JSON loses.
Record soaked(const Campaign& campaign, Record record, const TempDir& folder) {
  const Record done = run(campaign, std::move(record));
  return read_record(folder.write("record.json", to_json(done).dump()));
}

TEST(SoakCases, DependOnSeedAndNumberAlone) {
  std::set<std::uint64_t> seen;
  std::uint64_t all = 0;
  for (std::uint64_t number = 0; number < 300; ++number) {
    const std::uint64_t here = fingerprint(1, number);
    EXPECT_EQ(here, fingerprint(1, number));
    EXPECT_TRUE(seen.insert(here).second) << number;
    EXPECT_TRUE(seen.insert(fingerprint(2, number)).second) << number;
    all = all * 31 + here;
  }
  // The same on every machine and with every compiler. If this value changes, increment kSequence.
  EXPECT_EQ(kSequence, 3);
  EXPECT_EQ(all, 1646711894174352523u);
}

TEST(SoakCases, KeepTheContractAndIncludeEachFamily) {
  std::map<std::string_view, std::uint64_t> cases, drawn;
  std::set<int> threads;
  bool wide = false, single = false;
  for (std::uint64_t number = 0; number < 1500; ++number) {
    const Case c = make_case(3, number);
    ++cases[c.family];
    threads.insert(c.threads);
    wide |= std::max(c.width, c.height) > 1024;
    single |= c.width == 1 || c.height == 1;
    ASSERT_EQ(c.triangles.empty(), c.drawable.has_value());
    for (const ScreenTriangle& t : c.triangles) {
      for (int i = 0; i < 3; ++i) {
        ASSERT_LE(std::abs(t.x_sub[i]), contract::kGuardSub);
        ASSERT_LE(std::abs(t.y_sub[i]), contract::kGuardSub);
        ASSERT_GE(t.z[i], contract::kDepthHead);
        ASSERT_LE(t.z[i], contract::kDepthHead + contract::kDepthRange);
      }
      drawn[c.family] += lab::covered_pixels(std::span(&t, 1), c.width, c.height) != 0 ? 1u : 0u;
    }
    if (c.drawable) drawn[c.family] += Frontend().run(*c.drawable, c.frontend).size();
  }
  EXPECT_EQ(cases.size(), triangle_families().size() + scene_families().size());
  for (const auto& [family, count] : cases) {
    EXPECT_GT(count, 40u) << family;
    EXPECT_GT(drawn[family], count) << family;
  }
  EXPECT_GE(threads.size(), 4u);
  EXPECT_TRUE(wide);
  EXPECT_TRUE(single);
}

TEST(SoakShards, AreDisjointAndCoverAllCases) {
  std::set<std::uint64_t> numbers;
  for (std::uint64_t index = 0; index < 7; ++index)
    for (std::uint64_t k = 0; k < 10; ++k) EXPECT_TRUE(numbers.insert((Shard{index, 7, 0}.number(k))).second);
  EXPECT_EQ(numbers.size(), 70u);
  EXPECT_EQ(*numbers.rbegin(), 69u);
}

TEST(SoakShards, OverlapsAreFound) {
  // Compares with the shards' case numbers, for all small shards.
  std::vector<Shard> all;
  for (std::uint64_t of = 1; of <= 6; ++of)
    for (std::uint64_t index = 0; index < of; ++index)
      for (const std::uint64_t cases : {0u, 1u, 2u, 5u}) all.push_back({index, of, cases});
  for (const Shard& a : all)
    for (const Shard& b : all) {
      bool meet = false;
      for (std::uint64_t i = 0; i < a.cases; ++i)
        for (std::uint64_t k = 0; k < b.cases; ++k) meet |= a.number(i) == b.number(k);
      EXPECT_EQ(overlap(a, b), meet) << a.index << '/' << a.of << ' ' << b.index << '/' << b.of;
    }
}

TEST(Soak, FindsNoDifferenceAndTalliesAddUpOverShards) {
  const TempDir folder;
  const Record whole = soaked(campaign_of(60), fresh(5, {}), folder);
  EXPECT_EQ(whole.tally.differences(), 0u) << report(whole);
  EXPECT_EQ(whole.tally.cases, 60u);
  EXPECT_GT(whole.tally.oracle_frames, 0u);
  EXPECT_GT(whole.tally.frontend_lists, 0u);
  EXPECT_GE(whole.tally.frames, 60 * backends().size() * supported_targets().size() * 2);
  const auto& by = whole.tally.by.at("backend_simd_target");
  EXPECT_EQ(by.size(), backends().size() * supported_targets().size());
  RecordProperty("cases", static_cast<int>(whole.tally.cases));
  RecordProperty("comparisons", static_cast<int>(whole.tally.frames));

  Record sum;
  for (std::uint64_t index = 0; index < 3; ++index) {
    Campaign campaign = campaign_of(20);
    campaign.jobs = static_cast<int>(index) + 1;
    const Record part = soaked(campaign, fresh(5, {index, 3, 0}), folder);
    if (index == 0)
      sum = part;
    else
      merge(sum, part);
  }
  EXPECT_EQ(sum.tally, whole.tally);
  EXPECT_EQ(sum.shards.size(), 3u);
  EXPECT_EQ(sum.machines.size(), 1u);
}

TEST(Soak, ResumesARecord) {
  const TempDir folder;
  const Record whole = soaked(campaign_of(16), fresh(6, {1, 2, 0}), folder);
  Record part = soaked(campaign_of(7), fresh(6, {1, 2, 0}), folder);
  part = soaked(campaign_of(9), continued(part, fresh(6, {1, 2, 0})), folder);
  EXPECT_EQ(part.tally, whole.tally);
  EXPECT_EQ(part.shards, whole.shards);
  EXPECT_GT(part.seconds, 0.0);

  EXPECT_NE(message_of([&] { continued(part, fresh(7, {1, 2, 0})); }), "");
  EXPECT_NE(message_of([&] { continued(part, fresh(6, {0, 2, 0})); }), "");
  merge(part, fresh(6, {0, 2, 0}));
  EXPECT_NE(message_of([&] { continued(part, fresh(6, {1, 2, 0})); }), "");
}

TEST(Soak, StopsOnRequestAndAtTheTimeLimit) {
  Campaign campaign = campaign_of(1'000'000);
  campaign.seconds = 0.05;
  const Record late = run(campaign, fresh(1, {}));
  EXPECT_LT(late.tally.cases, 1'000'000u);
  EXPECT_EQ(late.tally.cases, late.shards[0].cases);
  campaign.seconds.reset();
  std::atomic<int> asked = 0;
  campaign.stop = [&] { return ++asked > 10; };
  EXPECT_EQ(run(campaign, fresh(1, {})).tally.cases, 10u);
}

TEST(SoakMerge, RefusesRecordsThatCannotBeAdded) {
  const auto with = [](std::uint64_t seed, const Shard& shard) {
    Record record = fresh(seed, shard);
    record.tally.cases = shard.cases;
    return record;
  };
  const Record first = with(1, {0, 2, 10});
  const auto refusal = [&](const Record& other) {
    return message_of([&] {
      Record copy = first;
      merge(copy, other);
    });
  };
  EXPECT_EQ(refusal(with(1, {1, 2, 10})), "");
  EXPECT_EQ(refusal(with(1, {1, 4, 10})), "");
  EXPECT_NE(refusal(with(1, {0, 2, 1})).find("same cases"), std::string::npos);
  EXPECT_NE(refusal(with(1, {2, 4, 1})).find("same cases"), std::string::npos);
  EXPECT_NE(refusal(with(1, {0, 3, 5})).find("same cases"), std::string::npos);
  EXPECT_NE(refusal(with(2, {1, 2, 10})).find("seeds"), std::string::npos);
  for (const char* key : {"edgewise_version", "commit"}) {
    Record other = with(1, {1, 2, 10});
    other.machines[0][key] = "another";
    EXPECT_NE(refusal(other).find("different programs"), std::string::npos);
  }
  Record other = with(1, {1, 2, 10});
  other.backends.pop_back();
  EXPECT_NE(refusal(other).find("backends"), std::string::npos);
}

TEST(SoakMerge, ReadingRefusesAnInvalidRecord) {
  const TempDir folder;
  const nlohmann::json whole = to_json(run(campaign_of(2), fresh(1, {})));
  const auto refusal = [&](const char* change, const nlohmann::json& value) {
    nlohmann::json json = whole;
    json[nlohmann::json::json_pointer(change)] = value;
    const auto path = folder.write("record.json", json.dump());
    return message_of([&] { read_record(path); });
  };
  EXPECT_EQ(refusal("/cases", 2), "");
  for (const char* count : {"/seed", "/cases", "/frames", "/pixels", "/frames_differ", "/shards/0/cases",
                            "/shards/0/of", "/by/judge/scanline/compared", "/by/judge/scanline/differ"})
    for (const nlohmann::json& no_count : {nlohmann::json(-1), nlohmann::json(1.5), nlohmann::json("2")})
      EXPECT_NE(refusal(count, no_count).find("is not a count"), std::string::npos)
          << count << ' ' << no_count;
  const nlohmann::json shard{{"shard", 0}, {"of", 1}, {"cases", 1}};
  EXPECT_NE(refusal("/shards", {shard, shard}).find("drawn twice, in shards 0/1 and 0/1"), std::string::npos);
}

// Wrong only at pixel (0, 0), only on several threads, and only if a triangle covers it.
class WrongInTheCorner : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                    const Execution& execution) override {
    right_->draw(triangles, frame, background, execution);
    if (execution.threads > 1 && frame.depth[0] != contract::kDepthClear) frame.depth[0] ^= 1;
  }
  std::unique_ptr<Backend> right_ = backends()[0].make();
};

class WritesBehindTheLastRow : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                    const Execution& execution) override {
    right_->draw(triangles, frame, background, execution);
    if (frame.stride > frame.width) frame.depth[frame.height * frame.stride - 1] = 0;
  }
  std::unique_ptr<Backend> right_ = backends()[0].make();
};

// Wrong in every frame, and used as the reference: only the oracle can find it.
class WrongReference : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                    const Execution& execution) override {
    std::vector<ScreenTriangle> moved(triangles.begin(), triangles.end());
    for (ScreenTriangle& t : moved)
      for (std::int32_t& x : t.x_sub) x = std::max(x - 1, -contract::kGuardSub);
    right_->draw(moved, frame, background, execution);
  }
  std::unique_ptr<Backend> right_ = backends()[0].make();
};

TEST(SoakFindings, AreReportedReducedAndReplayed) {
  const TempDir folder;
  Campaign campaign = campaign_of(40);
  campaign.judged.backends = {backends()[0], testing::wrong_backend<WrongInTheCorner>()};
  campaign.failure_folder = folder.path() / "the soak's failures";
  campaign.program = EDGEWISE_PROGRAM;
  const Record record = soaked(campaign, fresh(8, {}), folder);
  ASSERT_GT(record.tally.frames_differ, 0u);
  ASSERT_FALSE(record.findings.empty());
  EXPECT_LE(record.findings.size(), kMostFindings);
  EXPECT_EQ(to_json(record).at("bounds_95"), nullptr);
  int replayed = 0;
  for (const auto& finding : record.findings) {
    EXPECT_EQ(finding.at("backend"), "wrong");
    EXPECT_EQ(finding.at("judge"), backends()[0].name);
    EXPECT_GT(finding.at("threads"), 1);
    EXPECT_EQ(finding.at("pixels"), 1u);
    EXPECT_EQ(finding.at("first"), nlohmann::json({0, 0}));
    EXPECT_EQ(finding.at("reduced_to"), 1u) << finding;
    ASSERT_TRUE(finding.contains("file")) << finding;
    const TriangleStream stream = read_tri(finding.at("file").get<std::string>());
    EXPECT_EQ(stream.triangles.size(), 1u);
    EXPECT_EQ(stream.width, finding.at("width"));
    const auto commands = finding.at("replay").get<std::vector<std::string>>();
    EXPECT_EQ(commands.at(0), "'" EDGEWISE_PROGRAM "' soak --seed 8 --case " + finding.at("case").dump());
    replayed += commands.size() == 2;
    // The program lacks the wrong backend, so the command must run and find nothing.
    const auto script = folder.write("replay.sh", "cd / && " + commands.at(1));
    EXPECT_EQ(testing::run_program("/bin/sh", script.string()).status, 0) << commands.at(1);
  }
  EXPECT_EQ(replayed, static_cast<int>(record.findings.size()));
  const std::string text = report(record);
  EXPECT_NE(text.find("reproduce: '" EDGEWISE_PROGRAM "' verify '"), std::string::npos) << text;
  EXPECT_NE(text.find("DIFFER."), std::string::npos);

  // The same case alone, as the command draws it.
  campaign.cases = 1;
  campaign.failure_folder.clear();
  const std::uint64_t number = record.findings[0].at("case");
  const Record again = run(campaign, fresh(8, {number, number + 1, 0}));
  EXPECT_EQ(again.findings.at(0).at("case"), number);
}

TEST(SoakFindings, IncludeWritesOutsideThePicture) {
  const TempDir folder;
  Campaign campaign = campaign_of(6);
  campaign.judged.backends = {backends()[0], testing::wrong_backend<WritesBehindTheLastRow>()};
  campaign.failure_folder = folder.path() / "failures";
  const Record record = soaked(campaign, fresh(9, {}), folder);
  ASSERT_FALSE(record.findings.empty());
  EXPECT_EQ(record.findings[0].at("pixels"), 0u);
  EXPECT_EQ(record.findings[0].at("written_outside"), 1u);
}

// Wrong only with stepped values.
class WrongWhenStepped : public AblatableBackend {
  void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                    const Execution& execution) override {
    right_->draw(triangles, frame, background, execution);
    if (ablation.stepped) frame.depth[0] ^= 1;
  }
  std::unique_ptr<Backend> right_ = backends()[0].make();
};

TEST(SoakFindings, IncludeWrongSteppedValues) {
  Campaign campaign = campaign_of(40);
  campaign.judged.backends = {backends()[0], testing::wrong_backend<WrongWhenStepped>()};
  const Record record = run(campaign, fresh(13, {}));
  EXPECT_GT(record.tally.frames_differ, 0u);
  EXPECT_EQ(record.tally.by.at("backend_ablation").at("wrong, stepped").differ, record.tally.frames_differ);
  EXPECT_EQ(record.findings.at(0).at("ablation"), "stepped");
  EXPECT_NE(report(record).find("ablation: 'stepped'"), std::string::npos) << report(record);
}

TEST(SoakFindings, AreKeptIfNoFileCanBeWritten) {
  Campaign campaign = campaign_of(6);
  campaign.judged.backends = {backends()[0], testing::wrong_backend<WritesBehindTheLastRow>()};
  campaign.failure_folder = "/dev/null/failures";
  const Record record = run(campaign, fresh(9, {}));
  ASSERT_FALSE(record.findings.empty());
  EXPECT_NE(record.findings[0].at("trouble").get<std::string>().find("/dev/null/failures"),
            std::string::npos);
  EXPECT_EQ(record.findings[0].at("replay").size(), 1u);
  EXPECT_NE(report(record).find("no file: "), std::string::npos);
}

TEST(SoakFindings, IncludeAWrongReference) {
  Campaign campaign = campaign_of(40);
  campaign.judged.backends = {testing::wrong_backend<WrongReference>()};
  const Record record = run(campaign, fresh(10, {}));
  ASSERT_FALSE(record.findings.empty());
  for (const auto& finding : record.findings) EXPECT_EQ(finding.at("judge"), "oracle");
}

TEST(SoakFindings, IncludeAWrongFrontEnd) {
  const TempDir folder;
  Campaign campaign = campaign_of(60);
  campaign.judged.frontend = [](Frontend& frontend, const Drawable& drawable,
                                const FrontendOptions& options) {
    const std::span<const ScreenTriangle> all = frontend.run(drawable, options);
    return options.threads > 1 && !all.empty() ? all.first(all.size() - 1) : all;
  };
  campaign.failure_folder = folder.path() / "failures";
  const Record record = soaked(campaign, fresh(11, {}), folder);
  EXPECT_GT(record.tally.frontend_lists_differ, 0u);
  EXPECT_EQ(record.tally.frames_differ, 0u);
  int files = 0;
  for (const auto& finding : record.findings) {
    EXPECT_EQ(finding.at("backend"), "front end");
    EXPECT_EQ(finding.contains("file"), finding.at("family") == "stream");
    if (!finding.contains("file")) continue;
    ++files;
    EXPECT_EQ(read_tri(finding["file"].get<std::string>()).triangles.size(), 1u);
  }
  EXPECT_GT(files, 0);
}

TEST(SoakFindings, IncludeAWrongWholeFrame) {
  const TempDir folder;
  Campaign campaign = campaign_of(120);
  campaign.judged.backends = {backends()[0], testing::wrong_backend<testing::IgnoresSources>()};
  campaign.failure_folder = folder.path() / "failures";
  campaign.program = EDGEWISE_PROGRAM;
  const Record record = soaked(campaign, fresh(14, {}), folder);
  ASSERT_FALSE(record.findings.empty());
  const auto& by = record.tally.by.at("backend_input");
  EXPECT_EQ(by.at("wrong, scene or stream").differ, record.tally.frames_differ);
  EXPECT_EQ(by.at("wrong, screen triangles").differ, 0u);
  EXPECT_GT(by.at("wrong, screen triangles").compared, 0u);
  for (const auto& finding : record.findings) {
    EXPECT_EQ(finding.at("family"), "stream");
    EXPECT_EQ(finding.at("input"), "scene or stream");
    EXPECT_EQ(finding.at("reduced_to"), 1u) << finding;
    EXPECT_EQ(finding.at("replay").size(), 2u) << "verify draws whole frames, too";
  }
  EXPECT_NE(report(record).find(", scene or stream, tile "), std::string::npos) << report(record);
}

TEST(SoakFindings, AreNotReducedAfterARequestToStop) {
  const TempDir folder;
  Campaign campaign = campaign_of(1);
  campaign.judged.backends = {backends()[0], testing::wrong_backend<WrongInTheCorner>()};
  campaign.jobs = 1;
  campaign.failure_folder = folder.path();
  std::uint64_t number = 0;
  std::vector<nlohmann::json> found;
  const auto draw = [&] { found = run(campaign, fresh(8, {number, number + 1, 0})).findings; };
  for (draw(); found.empty() || found[0].at("triangles") < 10; draw()) ++number;
  EXPECT_EQ(found[0].at("reduced_to"), 1u);

  int asked = 0;
  campaign.stop = [&] { return ++asked > 1; };  // once the case has begun
  draw();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GT(found[0].at("reduced_to"), 1u);
  EXPECT_EQ(found[0].at("replay").size(), 1u);
  EXPECT_EQ(asked, 3) << "before the first case, the first attempt and the search for another command";
}

TEST(SoakFindings, BeyondTheMaximumLeaveNoFiles) {
  const TempDir folder;
  Campaign campaign = campaign_of(10);
  campaign.judged.backends = {backends()[0], testing::wrong_backend<WrongInTheCorner>()};
  campaign.failure_folder = folder.path() / "failures";
  Record before = fresh(8, {});
  before.findings.resize(kMostFindings - 1, {{"case", 0}});
  const Record record = run(campaign, before);
  EXPECT_GT(record.tally.frames_differ, 1u);
  EXPECT_EQ(record.findings.size(), kMostFindings);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(campaign.failure_folder), {}), 1);
}

TEST(SoakFindings, AnExceptionEndsTheTestAndNamesTheCase) {
  class Throws : public Backend {
    void draw_checked(std::span<const ScreenTriangle>, FrameView, std::uint32_t, const Execution&) override {
      throw std::length_error("too much");
    }
  };
  Campaign campaign = campaign_of(4);
  campaign.judged.backends = {backends()[0], testing::wrong_backend<Throws>()};
  campaign.jobs = 1;
  const std::string said = message_of([&] { run(campaign, fresh(12, {})); });
  EXPECT_TRUE(said.starts_with("seed 12, case 0 (")) << said;
  EXPECT_TRUE(said.ends_with("): too much")) << said;
}

TEST(SoakFindings, AFailureKeepsTheResultsOfFinishedCases) {
  // Draws two cases and throws std::bad_alloc in the third.
  class Tires : public Backend {
    void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                      const Execution& execution) override {
      const auto frames_a_case = static_cast<int>(2 * supported_targets().size());
      if (++drawn_ > 2 * frames_a_case) throw std::bad_alloc();
      backends()[0].make()->draw(triangles, frame, background, execution);
    }
    int drawn_ = 0;
  };
  Campaign campaign = campaign_of(4);
  campaign.judged.backends = {backends()[0], testing::wrong_backend<Tires>()};
  campaign.jobs = 1;
  std::uint64_t done = 0;
  campaign.on_failure = [&](const Record& record) { done = record.tally.cases; };
  const std::string said = message_of([&] { run(campaign, fresh(12, {})); });
  EXPECT_TRUE(said.ends_with("): out of memory")) << said;
  EXPECT_EQ(done, 2u);

  campaign.on_failure = [](const Record&) { throw std::runtime_error("a full disk"); };
  EXPECT_EQ(message_of([&] { run(campaign, fresh(12, {})); }), said);
}

TEST(SoakReduce, KeepsOnlyWhatIsNeeded) {
  std::vector<int> list(100);
  for (int i = 0; i < 100; ++i) list[static_cast<std::size_t>(i)] = i;
  const auto fails = [](const std::vector<int>& l) {
    return std::count(l.begin(), l.end(), 17) == 1 && std::count(l.begin(), l.end(), 80) == 1;
  };
  const auto never = [] { return false; };
  EXPECT_EQ(reduce(list, 1000, fails, never), (std::vector<int>{17, 80}));
  EXPECT_TRUE(fails(reduce(list, 5, fails, never)));
}

TEST(SoakReduce, StopsOnRequest) {
  int attempts = 0;
  const auto fails = [&](const std::vector<int>& l) { return ++attempts, !l.empty(); };
  EXPECT_EQ(reduce(std::vector<int>(64), 1000, fails, [&] { return attempts == 3; }).size(), 16u);
  EXPECT_EQ(attempts, 3);
}

TEST(GuardedFrame, CountsWordsWrittenOutsideThePicture) {
  for (const lab::GuardedFrame::Layout layout : {lab::GuardedFrame::Layout{0, 0}, {3, 5}, {40, 15}}) {
    lab::GuardedFrame frame(5, 4, layout);
    const FrameView view = frame.view();
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(view.depth) / 4 % 16, static_cast<unsigned>(layout.offset));
    for (int y = 0; y < 4; ++y) std::fill_n(view.depth + y * view.stride, 5, 1u);
    EXPECT_EQ(frame.written_outside(), 0u);
    view.depth[-1] = 0;
    view.payload[3 * view.stride + 5] = 0;
    EXPECT_EQ(frame.written_outside(), 2u);
    if (layout.padding > 0) view.payload[5] = 0;
    EXPECT_EQ(frame.written_outside(), layout.padding > 0 ? 3u : 2u);
    EXPECT_EQ(frame.copy().depth_row(3)[4], 1u);
  }
}

TEST(SoakOptions, DurationsHaveUnits) {
  EXPECT_EQ(tools::parse_duration("--for", "90s"), 90.0);
  EXPECT_EQ(tools::parse_duration("--for", "20m"), 1200.0);
  EXPECT_EQ(tools::parse_duration("--for", "1.5h"), 5400.0);
}

class SoakProgram : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  Outcome soak(const std::string& arguments) const {
    return testing::run_program(EDGEWISE_PROGRAM, "soak " + arguments);
  }
  nlohmann::json json(const std::string& name) const {
    return nlohmann::json::parse(file_content(path(name)), nullptr, false);
  }
  TempDir folder_;
};

TEST_F(SoakProgram, ReplaysOneCase) {
  const Outcome outcome = soak("--seed 7 --case 123456 -o " + path("a.json"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(json("a.json").at("cases"), 1);
  EXPECT_EQ(json("a.json").at("seed"), 7);
  EXPECT_EQ(json("a.json").at("shards").at(0).at("shard"), 123456);
  EXPECT_TRUE(json("a.json").at("by").at("family").contains(std::string(make_case(7, 123456).family)));
}

TEST_F(SoakProgram, MergesShards) {
  ASSERT_EQ(soak("--seed 4 --shard 0/2 --cases 5 -o " + path("a.json")).status, 0);
  ASSERT_EQ(soak("--seed 4 --shard 1/2 --cases 5 -o " + path("b.json")).status, 0);
  const Outcome merged = soak("--merge " + path("a.json") + " " + path("b.json") + " -o " + path("all.json"));
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_NE(merged.out.find("Seed 4, 2 shards: 10 cases"), std::string::npos) << merged.out;
  EXPECT_EQ(json("all.json").at("frames"),
            json("a.json").at("frames").get<int>() + json("b.json").at("frames").get<int>());
  EXPECT_EQ(json("all.json").at("differences"), 0);

  const Outcome twice = soak("--merge " + path("all.json") + " " + path("b.json") + " -o " + path("c.json"));
  EXPECT_EQ(twice.status, 2);
  EXPECT_NE(twice.err.find("same cases"), std::string::npos) << twice.err;
  EXPECT_EQ(folder_.count(), 3u);

  auto differs = json("b.json");
  differs["frames_differ"] = 1;
  folder_.write("d.json", differs.dump());
  EXPECT_EQ(soak("--merge " + path("a.json") + " " + path("d.json")).status, 1);
}

TEST_F(SoakProgram, WritesItsRecordOnCtrlCAndResumesIt) {
  const std::string file = path("a.json");
  for (const int signal_number : {SIGINT, SIGTERM}) {
    const auto cases_before = std::filesystem::exists(file) ? json("a.json").at("cases").get<int>() : 0;
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (const int n : {SIGINT, SIGTERM}) signal(n, SIG_DFL);
      if (freopen("/dev/null", "w", stdout) != nullptr)
        execl(EDGEWISE_PROGRAM, "edgewise", "soak", "--resume", file.c_str(), nullptr);
      _exit(99);
    }
    // The program writes the first record just before it starts drawing.
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!std::filesystem::exists(file) && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    kill(child, signal_number);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 128 + signal_number);
    EXPECT_EQ(folder_.count(), 1u);
    EXPECT_GT(read_record(file).tally.cases, static_cast<std::uint64_t>(cases_before));
  }
}

}  // namespace
}  // namespace edgewise::soak
