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
  FamilyTable(const AccuracyReport& report, Family family, bool smallest) {
    for (const SceneResult& scene : report.scenes) {
      if (scene.family != family || scene.smallest != smallest) continue;
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
  // None if those of a scene are not known.
  std::optional<std::uint64_t> folds(std::size_t method) const {
    std::uint64_t total = 0;
    for (const SceneResult* scene : scenes_) {
      const auto& folds = std::get<CoverageScores>(scene->methods[method].score).cracks.folds;
      if (!folds) return std::nullopt;
      total += *folds;
    }
    return total;
  }
  std::size_t scenes() const { return scenes_.size(); }
  std::string title(std::string_view what, std::string_view trials) const {
    const SceneResult& first = *scenes_.front();
    return fmt::format("\n{}: {}, {} {} in {} {}scene{}\n", name_of(first.family), what, trials_, trials,
                       scenes_.size(), first.smallest ? "small " : "", scenes_.size() == 1 ? "" : "s");
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
  // For each scene that has more than half of the errors of some methods: their rates without it.
  std::string without_dominant() const {
    std::string text;
    for (const SceneResult* scene : scenes_) {
      std::string line;
      for (std::size_t i = 0; i < methods(); ++i) {
        std::uint64_t all = 0;
        for (const SceneResult* other : scenes_) all += errors(other->methods[i].score);
        const std::uint64_t here = errors(scene->methods[i].score);
        if (scenes_.size() == 1 || 2 * here <= all) continue;
        const std::string item = fmt::format("{} {}", name(i), rate(all - here, trials_ - scene->trials()));
        line += line.empty() ? fmt::format("over half on {}; without it:", scene->name) : ",";
        const std::size_t column = line.size() - (line.rfind('\n') + 1);
        line += (column + item.size() > 78 ? "\n  " : " ") + item;
      }
      if (!line.empty()) text += line + '\n';
    }
    return text;
  }

 private:
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
      "\ncoverage: pixels with the wrong visible triangle, and depth errors, in {} scene{}\n"
      "depth ulp: 2^-31 of the depth range for backends, a float's ulp for others\n",
      t.scenes(), t.scenes() == 1 ? "" : "s");
  constexpr const char* kLine = "{:<21}{:>9}{:>9}{:>10}{:>12}{:>9}\n";
  text += fmt::format(kLine, "", "wrong", "wrong", "of those", "depth: max", "RMS");
  text += fmt::format(kLine, "method", "snapped", "source", "through", "ulp", "ulp");
  for (std::size_t i = 0; i < t.methods(); ++i) {
    const auto sum = [&](auto count) { return t.sum(i, &CoverageScores::visible, count); };
    const auto most = [&](auto figure) { return digits(t.most(i, &CoverageScores::visible, figure)); };
    using S = lab::VisibleTriangleScore;
    text += fmt::format(kLine, t.name(i), sum(&S::wrong_snapped), sum(&S::wrong_source),
                        sum(&S::wrong_surface), most(&S::max_ulp), most(&S::rms_ulp));
  }
  return text + "through: showing neither the right triangle nor one that touches it\n";
}

std::string coverage_table(const FamilyTable& t) {
  std::string text = t.title("errors per 10^6 edge crossings", "crossings");
  constexpr const char* kLine = "{:<21}{:>11}{:>11}{:>9}{:>9}{:>10}{:>8}\n";
  text += fmt::format(kLine, "", "snapped", "source", "cracks:", "double", "at T-", "");
  text += fmt::format(kLine, "method", "reference", "reference", "gaps", "hits", "junctions", "folds");
  for (std::size_t i = 0; i < t.methods(); ++i) {
    const auto errors = [&](lab::CoverageScore CoverageScores::*truth) {
      using S = lab::CoverageScore;
      return rate(t.sum(i, truth, &S::missing) + t.sum(i, truth, &S::extra), t.trials());
    };
    const auto cracks = [&](auto count) { return t.sum(i, &CoverageScores::cracks, count); };
    using C = CrackCounts;
    const auto folds = t.folds(i);
    text += fmt::format(kLine, t.name(i), errors(&CoverageScores::snapped), errors(&CoverageScores::source),
                        cracks(&C::gaps), cracks(&C::double_hits), cracks(&C::t_junctions),
                        folds ? std::to_string(*folds) : "-");
  }
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

std::string choice_table(const ChoiceResult& choice) {
  std::string text = fmt::format("\nwhole frames of {}: wrong pixels, {} frames of {}x{}\n", choice.name,
                                 choice.frames, choice.size.width, choice.size.height);
  constexpr const char* kLine = "{:<18}{:>12}{:>10}{:>10}{:>10}\n";
  text += fmt::format(kLine, "method", "per frame", "least", "worst", "holes");
  const auto add = [&](std::string_view name, const ChoiceTotal& of) {
    text += fmt::format(kLine, name, digits(static_cast<double>(of.wrong) / choice.frames), of.least, of.most,
                        of.holes);
  };
  for (const auto& [name, of] : choice.methods) add(name, of);
  if (choice.float_projection) add("floats alone", *choice.float_projection);
  return text;
}

}  // namespace

std::string accuracy_tables(const AccuracyReport& report) {
  constexpr std::string (*kTables[])(const FamilyTable&) = {coverage_table, visibility_table, facing_table,
                                                            clipping_table, projection_table};
  std::string text;
  for (const Family family : lab::kFamilies)
    for (const bool smallest : {false, true})
      if (const FamilyTable table(report, family, smallest); !table.empty())
        text += kTables[static_cast<std::size_t>(family)](table);
  if (report.turning_cube) text += cube_table(*report.turning_cube) + motion_table(report.motions);
  for (const ChoiceResult& choice : report.choices) text += choice_table(choice);
  return text.substr(text.starts_with('\n') ? 1 : 0);
}

}  // namespace edgewise::tools
