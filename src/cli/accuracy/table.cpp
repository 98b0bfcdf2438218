#include <fmt/format.h>

#include <algorithm>

#include "cli/accuracy/accuracy.h"

namespace edgewise::tools {

namespace {

// Three significant digits, or a whole number.
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

using Row = std::vector<std::string>;

// Columns are as wide as their widest cell. The first is aligned to the left, the others to the right.
std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (const Row& row : rows) {
    text += fmt::format("{:<{}}", row.front(), widths.front());
    for (std::size_t i = 1; i < row.size(); ++i) text += fmt::format("{:>{}}", row[i], widths[i] + 2);
    text += '\n';
  }
  return text;
}

// A count of a method's scores, as a rate or as it is.
template <typename Scores>
struct Column {
  const char* head;
  std::uint64_t (*count)(const Scores&);
  bool is_rate = true;
};

using Coverage = CoverageScores;
constexpr Column<Coverage> kSamples[] = {
    {"snapped", [](const Coverage& s) { return s.snapped.errors(); }},
    {"source", [](const Coverage& s) { return s.source.errors(); }},
    {"gaps", [](const Coverage& s) { return s.cracks.gaps; }, false},
    {"double hits", [](const Coverage& s) { return s.cracks.double_hits; }, false},
    {"at T-junctions", [](const Coverage& s) { return s.cracks.t_junctions; }, false}};
constexpr Column<Coverage> kPixels[] = {
    {"snapped", [](const Coverage& s) { return s.visible.wrong_snapped; }, false},
    {"source", [](const Coverage& s) { return s.visible.wrong_source; }, false},
    {"of those through", [](const Coverage& s) { return s.visible.wrong_surface; }, false},
    {"slits", [](const Coverage& s) { return s.visible.slits; }, false}};
constexpr Column<lab::VisibilityScores> kVisibility[] = {
    {"snapped", [](const lab::VisibilityScores& s) { return s.snapped.wrong_triangle; }},
    {"source", [](const lab::VisibilityScores& s) { return s.source.wrong_triangle; }}};
constexpr Column<lab::FacingScores> kFacing[] = {
    {"snapped", [](const lab::FacingScores& s) { return s.snapped.misclassified; }},
    {"source", [](const lab::FacingScores& s) { return s.source.misclassified; }}};
constexpr Column<lab::ClippingScore> kClipping[] = {
    {"per 10^6", [](const lab::ClippingScore& s) { return s.wrong(); }},
    {"missing", [](const lab::ClippingScore& s) { return s.missing; }, false},
    {"extra", [](const lab::ClippingScore& s) { return s.extra; }, false},
    {"triangle", [](const lab::ClippingScore& s) { return s.wrong_triangle; }, false},
    {"depth", [](const lab::ClippingScore& s) { return s.wrong_depth; }, false}};
constexpr Column<lab::ProjectionScore> kProjection[] = {
    {"per 10^6", [](const lab::ProjectionScore& s) { return s.wrong; }},
    {"by rounding", [](const lab::ProjectionScore& s) { return s.by_rounding; }},
    {"by projection", [](const lab::ProjectionScore& s) { return s.by_projection; }},
    {"folds", [](const lab::ProjectionScore& s) { return s.folds; }, false}};

// The scenes of one family and kind, which a table sums.
struct Summed {
  std::vector<const SceneResult*> scenes;
  std::uint64_t trials = 0;

  std::string heading(std::string_view what, std::string_view trial) const {
    const SceneResult& first = *scenes.front();
    const std::string kind(kSceneKinds[static_cast<std::size_t>(first.kind)]);
    return fmt::format("\n{}{}: {}\n{} {} in {} scene{}\n", name_of(first.family),
                       first.kind == SceneKind::scenes ? "" : ", " + kind, what, trials, trial, scenes.size(),
                       scenes.size() == 1 ? "" : "s");
  }

  // The last column names the scene that has over half of the errors in column `ranked`.
  template <typename Scores, std::size_t kCount>
  std::string table(const Column<Scores> (&columns)[kCount], int ranked = -1) const {
    std::vector<Row> rows{{"method"}};
    for (const auto& column : columns) rows.front().push_back(column.head);
    if (ranked >= 0) rows.front().emplace_back("over half on");
    for (std::size_t i = 0; i < scenes.front()->methods.size(); ++i) {
      const auto score = [&](const SceneResult* scene) -> const Scores& {
        return std::get<Scores>(scene->methods[i].score);
      };
      Row& row = rows.emplace_back(Row{scenes.front()->methods[i].name});
      for (const auto& column : columns) {
        std::uint64_t sum = 0;
        for (const SceneResult* scene : scenes) sum += column.count(score(scene));
        row.push_back(column.is_rate ? rate(sum, trials) : std::to_string(sum));
      }
      if (ranked < 0) continue;
      const auto errors_on = [&](const SceneResult* scene) { return columns[ranked].count(score(scene)); };
      const SceneResult* const worst = std::ranges::max(scenes, {}, errors_on);
      std::uint64_t all = 0;
      for (const SceneResult* scene : scenes) all += errors_on(scene);
      row.push_back(2 * errors_on(worst) > all ? worst->name : "-");
    }
    return aligned(rows);
  }
};

std::string coverage_table(const Summed& of) {
  std::uint64_t shared = 0, slits = 0;
  for (const SceneResult* scene : of.scenes) shared += scene->shared_crossings, slits += scene->slits;
  std::string text = of.heading("errors per 10^6 edge crossings; cracks", "crossings") + of.table(kSamples);
  if (shared != 0)
    text += fmt::format("cracks: of {} crossings of shared edges; 0 is below {:.2g} per 10^6 (95 %)\n",
                        shared, 1e6 * lab::rate_bound(shared));
  text += "wrong pixels\n" + of.table(kPixels);
  return text + fmt::format(
                    "through: showing neither the right triangle nor one that touches it\n"
                    "slits: background one pixel wide between triangles of meshes; the exact picture\n"
                    "has {}\n",
                    slits);
}
std::string visibility_table(const Summed& of) {
  return of.heading("wrong triangles per 10^6 pixels", "pixels") + of.table(kVisibility, 0);
}
std::string facing_table(const Summed& of) {
  return of.heading("misjudged per 10^6 faces that cover a sample", "faces") + of.table(kFacing, 1);
}
std::string clipping_table(const Summed& of) {
  return of.heading("wrong pixels", "pixels") + of.table(kClipping, 0);
}
std::string projection_table(const Summed& of) {
  return of.heading("wrong samples per 10^6 edge crossings", "crossings") + of.table(kProjection, 0) +
         "by rounding: of exact positions, rounded exactly to as many bits; by projection:\n"
         "samples that differ from those\n";
}

std::string cube_table(const CubeResult& cube) {
  std::vector<Row> rows{{"method", "gaps", "double hits", "snapped"}};
  for (const CubeMethodResult& m : cube.methods)
    rows.push_back(
        {m.name, std::to_string(m.gaps), std::to_string(m.double_hits), std::to_string(m.wrong_snapped)});
  return fmt::format(
      "\nrotating cube: wrong pixels of {} frames of {}x{}\n{}0: in fewer than {} of all frames, "
      "with 95 % confidence\n",
      cube.frames, cube.width, cube.height, aligned(rows),
      digits(lab::rate_bound(static_cast<std::uint64_t>(cube.frames))));
}

std::string motion_table(const std::vector<MotionResult>& motions) {
  std::vector<Row> rows{{"method"}};
  for (const auto& [method, superfluous] : motions.front().superfluous) rows.push_back({method});
  for (const MotionResult& motion : motions) {
    rows.front().push_back(motion.name);
    for (std::size_t i = 0; i < motion.superfluous.size(); ++i)
      rows[i + 1].push_back(rate(motion.superfluous[i].second, motion.changes));
  }
  return fmt::format("\nmotion: superfluous changes of pixels per 10^6 true ones, {} frames\n{}",
                     motions.front().frames, aligned(rows));
}

std::string choice_table(const ChoiceResult& choice) {
  std::vector<Row> rows{{"method", "per frame", "least", "worst", "holes"}};
  const auto add = [&](std::string_view name, const ChoiceTotal& of) {
    rows.push_back({std::string(name), digits(static_cast<double>(of.wrong) / choice.frames),
                    std::to_string(of.least), std::to_string(of.most), std::to_string(of.holes)});
  };
  for (const auto& [name, of] : choice.methods) add(name, of);
  if (choice.float_projection) add("floats alone", *choice.float_projection);
  return fmt::format("\nwhole frames of {}: wrong pixels, {} frames of {}x{}\n{}", choice.name, choice.frames,
                     choice.size.width, choice.size.height, aligned(rows));
}

}  // namespace

std::string accuracy_tables(const AccuracyReport& report) {
  constexpr std::string (*kTables[])(const Summed&) = {coverage_table, visibility_table, facing_table,
                                                       clipping_table, projection_table};
  std::string text;
  for (const Family family : lab::kFamilies)
    for (const SceneKind kind : {SceneKind::scenes, SceneKind::meshes, SceneKind::triangles,
                                 SceneKind::our_grid, SceneKind::small}) {
      Summed of;
      for (const SceneResult& scene : report.scenes)
        if (scene.family == family && scene.kind == kind)
          of.scenes.push_back(&scene), of.trials += scene.trials();
      if (!of.scenes.empty()) text += kTables[static_cast<std::size_t>(family)](of);
    }
  if (report.turning_cube) text += cube_table(*report.turning_cube) + motion_table(report.motions);
  for (const ChoiceResult& choice : report.choices) text += choice_table(choice);
  return text.substr(text.starts_with('\n') ? 1 : 0);
}

}  // namespace edgewise::tools
