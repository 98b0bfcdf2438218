#include <fmt/format.h>

#include <algorithm>

#include "cli/accuracy/accuracy.h"

namespace edgewise::tools {

namespace {

// Three significant digits, or a whole number, short enough for the narrowest column.
std::string digits(double v) {
  if (v == 0.0) return "0";
  if (v >= 9'999'999.5) return fmt::format("{:.1e}", v);
  if (v >= 99.5) return fmt::format("{:.0f}", v);
  return v >= 0.001 ? fmt::format("{:.3g}", v) : fmt::format("{:.0e}", v);
}

std::string rate(std::uint64_t errors, std::uint64_t trials) {
  if (trials == 0) return "-";
  const double bound = 1e6 * lab::rate_bound(trials);
  if (errors == 0) return bound < 10 ? fmt::format("0 (<{:.2g})", bound) : fmt::format("0 (<{:.0f})", bound);
  return digits(lab::per_million(errors, trials));
}

// Sums a family's scenes per method.
class FamilyTable {
 public:
  FamilyTable(const AccuracyReport& report, Family family, SceneKind kind) {
    for (const SceneResult& scene : report.scenes) {
      if (scene.family != family || scene.kind != kind) continue;
      scenes_.push_back(&scene);
      trials_ += scene.trials();
    }
  }
  bool empty() const { return scenes_.empty(); }
  std::uint64_t trials() const { return trials_; }
  std::size_t methods() const { return scenes_.front()->methods.size(); }
  const std::string& name(std::size_t method) const { return scenes_.front()->methods[method].name; }

  // The sum over all scenes of a count of the method's scores, to which these members lead.
  template <typename Scores, typename Part, typename... Path>
  std::uint64_t sum(std::size_t method, Part Scores::*part, Path... path) const {
    std::uint64_t total = 0;
    for (const SceneResult* scene : scenes_)
      total += at(std::get<Scores>(scene->methods[method].score), part, path...);
    return total;
  }
  // The largest such figure.
  template <typename Scores, typename Part, typename... Path>
  double most(std::size_t method, Part Scores::*part, Path... path) const {
    double most = 0.0;
    for (const SceneResult* scene : scenes_)
      most = std::max(most, at(std::get<Scores>(scene->methods[method].score), part, path...));
    return most;
  }
  std::uint64_t sum(std::uint64_t SceneResult::*count) const {
    std::uint64_t total = 0;
    for (const SceneResult* scene : scenes_) total += scene->*count;
    return total;
  }
  // "coverage, meshes"
  std::string subject() const {
    const SceneResult& first = *scenes_.front();
    const std::string_view kind = kSceneKinds[static_cast<std::size_t>(first.kind)];
    return std::string(name_of(first.family)) +
           (first.kind == SceneKind::scenes ? "" : ", " + std::string(kind));
  }
  std::string title(std::string_view what, std::string_view trials) const {
    return fmt::format("\n{}: {}\n{} {} in {} scene{}\n", subject(), what, trials_, trials, scenes_.size(),
                       scenes_.size() == 1 ? "" : "s");
  }
  // The scene with the highest error rate.
  std::string most_wrong_on(std::size_t method) const {
    const SceneResult* worst = nullptr;
    double most = 0.0;
    for (const SceneResult* scene : scenes_) {
      const double rate = lab::per_million(errors(scene->methods[method].score), scene->trials());
      if (rate > most) most = rate, worst = scene;
    }
    return worst == nullptr ? "-" : worst->name;
  }
  // For each scene that has more than half of the errors of some methods: the rates of all without it.
  std::string without_dominant() const {
    std::string text;
    for (const SceneResult* scene : scenes_) {
      std::string dominated, line = "  without it:";
      for (std::size_t i = 0; i < methods(); ++i) {
        std::uint64_t all = 0;
        for (const SceneResult* other : scenes_) all += errors(other->methods[i].score);
        const std::uint64_t here = errors(scene->methods[i].score);
        if (2 * here > all) add_item(dominated, name(i));
        add_item(line, fmt::format("{} {}", name(i), rate(all - here, trials_ - scene->trials())));
      }
      if (scenes_.size() > 1 && !dominated.empty())
        text += fmt::format("over half of the errors are on {}, of{}\n{}\n", scene->name, dominated, line);
    }
    return text;
  }

 private:
  // Breaks lines.
  static void add_item(std::string& list, std::string_view item) {
    if (!list.empty() && list.back() != ':') list += ',';
    constexpr std::size_t kColumns = 78, kIntroduction = 50;
    const std::size_t last_break = list.rfind('\n');
    const std::size_t column =
        last_break == std::string::npos ? list.size() + kIntroduction : list.size() - last_break;
    list += (column + item.size() > kColumns ? "\n  " : " ") + std::string(item);
  }
  template <typename T>
  static T at(const T& value) {
    return value;
  }
  template <typename T, typename Part, typename... Path>
  static auto at(const T& value, Part T::*part, Path... path) {
    return at(value.*part, path...);
  }
  static std::uint64_t errors(const Score& score) {
    struct Visit {
      std::uint64_t operator()(const CoverageScores& s) const { return s.source.errors(); }
      std::uint64_t operator()(const lab::VisibilityScores& s) const { return s.snapped.wrong_triangle; }
      std::uint64_t operator()(const lab::FacingScores& s) const { return s.source.misclassified; }
      std::uint64_t operator()(const lab::ClippingScore& s) const { return s.wrong(); }
      std::uint64_t operator()(const lab::ProjectionScore& s) const { return s.wrong; }
    };
    return std::visit(Visit{}, score);
  }
  std::vector<const SceneResult*> scenes_;
  std::uint64_t trials_ = 0;
};

constexpr std::string_view kMostWrongOn = "most wrong on";

// Of the last column, " most wrong on".
std::size_t last_width(const FamilyTable& t) {
  std::size_t widest = kMostWrongOn.size();
  for (std::size_t i = 0; i < t.methods(); ++i) widest = std::max(widest, t.most_wrong_on(i).size());
  return widest + 1;
}

// Pixels with the wrong visible triangle, and depth errors.
std::string visible_triangle_table(const FamilyTable& t) {
  std::string text = fmt::format(
      "\n{}: wrong pixels, and depth errors\n"
      "depth ulp: 2^-31 of the depth range for backends, a float's ulp for others\n",
      t.subject());
  constexpr const char* kLine = "{:<21}{:>9}{:>9}{:>9}{:>8}{:>12}{:>9}\n";
  text += fmt::format(kLine, "", "wrong", "wrong", "of those", "", "depth: max", "RMS");
  text += fmt::format(kLine, "method", "snapped", "source", "through", "slits", "ulp", "ulp");
  for (std::size_t i = 0; i < t.methods(); ++i) {
    const auto sum = [&](auto count) { return t.sum(i, &CoverageScores::visible, count); };
    const auto most = [&](auto figure) { return digits(t.most(i, &CoverageScores::visible, figure)); };
    using S = lab::VisibleTriangleScore;
    text += fmt::format(kLine, t.name(i), sum(&S::wrong_snapped), sum(&S::wrong_source),
                        sum(&S::wrong_surface), sum(&S::slits), most(&S::max_ulp), most(&S::rms_ulp));
  }
  return text + fmt::format(
                    "through: showing neither the right triangle nor one that touches it\n"
                    "slits: background one pixel wide between triangles of meshes; the exact picture\n"
                    "has {}\n",
                    t.sum(&SceneResult::slits));
}

std::string coverage_table(const FamilyTable& t) {
  std::string text = t.title("errors per 10^6 edge crossings", "crossings");
  constexpr const char* kLine = "{:<21}{:>13}{:>13}{:>10}{:>10}{:>11}\n";
  text += fmt::format(kLine, "", "snapped", "source", "cracks:", "double", "at T-");
  text += fmt::format(kLine, "method", "reference", "reference", "gaps", "hits", "junctions");
  for (std::size_t i = 0; i < t.methods(); ++i) {
    const auto errors = [&](lab::CoverageScore CoverageScores::*truth) {
      using S = lab::CoverageScore;
      return rate(t.sum(i, truth, &S::missing) + t.sum(i, truth, &S::extra), t.trials());
    };
    const auto cracks = [&](auto count) { return t.sum(i, &CoverageScores::cracks, count); };
    using C = CrackCounts;
    text += fmt::format(kLine, t.name(i), errors(&CoverageScores::snapped), errors(&CoverageScores::source),
                        cracks(&C::gaps), cracks(&C::double_hits), cracks(&C::t_junctions));
  }
  if (const std::uint64_t shared = t.sum(&SceneResult::shared_crossings); shared != 0)
    text += fmt::format("cracks: of {} crossings of shared edges; 0 is below {:.2g} per 10^6 (95 %)\n",
                        shared, 1e6 * lab::rate_bound(shared));
  return text + t.without_dominant() + visible_triangle_table(t);
}

std::string visibility_table(const FamilyTable& t) {
  using S = lab::VisibilityScores;
  using One = lab::VisibilityScore;
  std::string text = t.title("wrong triangles per 10^6 pixels", "pixels");
  text += fmt::format("{:<17}{:>25}{:>19}\n", "", "snapped reference", "source reference");
  constexpr const char* kLine = "{:<17}{:>10}{:>7}{:>8}{:>11}{:>8}{:>{}}\n";
  text += fmt::format(kLine, "method", "per 10^6", "beyond", "ulp", "per 10^6", "ulp", kMostWrongOn,
                      last_width(t));
  for (std::size_t i = 0; i < t.methods(); ++i) {
    const auto wrong = [&](One S::*truth) {
      return rate(t.sum(i, truth, &One::wrong_triangle), t.sum(i, truth, &One::covered));
    };
    const auto ulp = [&](One S::*truth) { return digits(t.most(i, truth, &One::max_ulp)); };
    text +=
        fmt::format(kLine, t.name(i), wrong(&S::snapped), t.sum(i, &S::snapped, &One::out_of_range),
                    ulp(&S::snapped), wrong(&S::source), ulp(&S::source), t.most_wrong_on(i), last_width(t));
  }
  return text + t.without_dominant() +
         "beyond: pixels whose depth is outside the depth range of their triangle\n";
}

std::string facing_table(const FamilyTable& t) {
  using S = lab::FacingScores;
  using One = lab::FacingScore;
  std::string text = t.title("misjudged per 10^6 faces that cover a sample", "faces");
  text += fmt::format("{:<20}{:>20}{:>20}\n", "", "snapped reference", "source reference");
  constexpr const char* kLine = "{:<20}{:>13}{:>7}{:>13}{:>7}{:>{}}\n";
  text += fmt::format(kLine, "method", "per 10^6", "faces", "per 10^6", "faces", kMostWrongOn, last_width(t));
  for (std::size_t i = 0; i < t.methods(); ++i) {
    const auto wrong = [&](One S::*truth) { return t.sum(i, truth, &One::misclassified); };
    const auto share = [&](One S::*truth) { return rate(wrong(truth), t.sum(i, truth, &One::faces)); };
    text += fmt::format(kLine, t.name(i), share(&S::snapped), wrong(&S::snapped), share(&S::source),
                        wrong(&S::source), t.most_wrong_on(i), last_width(t));
  }
  return text + t.without_dominant();
}

std::string clipping_table(const FamilyTable& t) {
  using S = lab::ClippingScore;
  std::string text = t.title("wrong per 10^6 pixels", "pixels");
  constexpr const char* kLine = "{:<15}{:>9}{:>8}{:>7}{:>7}{:>7}{:>5}{:>4}{:>{}}\n";
  text += fmt::format(kLine, "method", "per 10^6", "missing", "extra", "tri", "depth", "hair", "NaN",
                      kMostWrongOn, last_width(t));
  for (std::size_t i = 0; i < t.methods(); ++i) {
    const std::uint64_t missing = t.sum(i, &S::missing), extra = t.sum(i, &S::extra),
                        triangle = t.sum(i, &S::wrong_triangle), depth = t.sum(i, &S::wrong_depth);
    text += fmt::format(kLine, t.name(i), rate(missing + extra + triangle + depth, t.trials()), missing,
                        extra, triangle, depth, t.sum(i, &S::hairline), t.sum(i, &S::not_a_number),
                        t.most_wrong_on(i), last_width(t));
  }
  return text + t.without_dominant() +
         "tri: wrong visible triangle; hair: right within 1/64 px of the sample\n";
}

std::string projection_table(const FamilyTable& t) {
  using S = lab::ProjectionScore;
  std::string text = t.title("wrong samples per 10^6 edge crossings", "crossings");
  constexpr const char* kLine = "{:<15}{:>10}{:>13}{:>15}{:>7}{:>{}}\n";
  text += fmt::format(kLine, "method", "per 10^6", "by rounding", "by projection", "folds", kMostWrongOn,
                      last_width(t));
  for (std::size_t i = 0; i < t.methods(); ++i) {
    const auto part = [&](auto count) { return rate(t.sum(i, count), t.trials()); };
    text += fmt::format(kLine, t.name(i), part(&S::wrong), part(&S::by_rounding), part(&S::by_projection),
                        t.sum(i, &S::folds), t.most_wrong_on(i), last_width(t));
  }
  return text + t.without_dominant() +
         "by rounding: of exact positions, rounded exactly to as many bits; by projection:\n"
         "samples that differ from those\n";
}

// Cracks; the last column sums all errors against the snapped reference.
std::string cube_table(const CubeResult& cube) {
  std::string text = fmt::format("\nrotating cube: wrong pixels per frame, {} frames of {}x{}\n", cube.frames,
                                 cube.width, cube.height);
  text += fmt::format("{:<18}{:>24}{:>27}{:>11}\n", "", "gaps", "double hits", "snapped");
  constexpr const char* kLine = "{:<18}{:>7}{:>7}{:>10}{:>10}{:>7}{:>10}{:>11}\n";
  text += fmt::format(kLine, "method", "median", "worst", "total", "median", "worst", "total", "total");
  for (const CubeMethodResult& m : cube.methods)
    text += fmt::format(kLine, m.name, m.gaps.median, m.gaps.worst, m.gaps.total, m.double_hits.median,
                        m.double_hits.worst, m.double_hits.total,
                        m.snapped.missing.total + m.snapped.extra.total);
  return text + fmt::format("total 0: occurs in fewer than {} of all frames, with 95 % confidence\n",
                            digits(lab::rate_bound(static_cast<std::uint64_t>(cube.frames))));
}

std::string motion_table(const std::vector<MotionResult>& motions) {
  std::string text =
      fmt::format("\nmotion: superfluous changes of pixels per 10^6 true ones, {} frames\n{:<21}",
                  motions.front().frames, "method");
  for (const MotionResult& motion : motions) text += fmt::format("{:>14}", motion.name);
  for (std::size_t i = 0; i < motions.front().superfluous.size(); ++i) {
    text += fmt::format("\n{:<21}", motions.front().superfluous[i].first);
    for (const MotionResult& motion : motions)
      text += fmt::format("{:>14}", rate(motion.superfluous[i].second, motion.changes));
  }
  return text + '\n';
}

}  // namespace

std::string accuracy_tables(const AccuracyReport& report) {
  constexpr std::string (*kTables[])(const FamilyTable&) = {coverage_table, visibility_table, facing_table,
                                                            clipping_table, projection_table};
  std::string text;
  for (const Family family : lab::kFamilies)
    for (const SceneKind kind :
         {SceneKind::scenes, SceneKind::meshes, SceneKind::triangles, SceneKind::our_grid, SceneKind::small})
      if (const FamilyTable table(report, family, kind); !table.empty())
        text += kTables[static_cast<std::size_t>(family)](table);
  if (report.turning_cube) text += cube_table(*report.turning_cube) + motion_table(report.motions);
  return text.substr(text.starts_with('\n') ? 1 : 0);
}

}  // namespace edgewise::tools
