#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/accuracy/score.h"

namespace edgewise::tools {

namespace {

using Json = nlohmann::json;

// Writes the 95 % upper bound of the rate only if no error was observed.
void add_rate(Json& score, std::uint64_t errors, std::uint64_t trials) {
  score["errors_per_million"] = lab::per_million(errors, trials);
  if (errors == 0 && trials != 0) score["bound_per_million"] = 1e6 * lab::rate_bound(trials);
}

Json score_json(const lab::CoverageScore& s, std::uint64_t crossings) {
  Json score{{"missing", s.missing},       {"extra", s.extra},       {"out_of_bounds", s.out_of_bounds},
             {"out_of_box", s.out_of_box}, {"worst_px", s.worst_px}, {"errors", s.errors()}};
  add_rate(score, s.errors(), crossings);
  return score;
}

Json score_json(const lab::VisibilityScore& s) {
  Json score{{"covered", s.covered},
             {"wrong_triangle", s.wrong_triangle},
             {"out_of_range", s.out_of_range},
             {"max_ulp", s.max_ulp},
             {"rms_ulp", s.rms_ulp}};
  add_rate(score, s.wrong_triangle, s.covered);
  return score;
}

Json score_json(const lab::FacingScore& s) {
  Json score{{"faces", s.faces}, {"misclassified", s.misclassified}, {"misled", s.misled}};
  add_rate(score, s.misclassified, s.faces);
  return score;
}

struct AddScore {
  Json& method;
  const SceneResult& scene;
  const ChosenMethods& methods;

  // Every pixel of the image is a trial, because background pixels may be wrong too.
  void add_wrong_pixels(Json& score, std::uint64_t wrong) const {
    score["wrong_pixels"] = wrong;
    const auto pixels = static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
    if (wrong == 0) score["wrong_pixels_bound_per_million"] = 1e6 * lab::rate_bound(pixels);
  }
  void operator()(const CoverageScores& s) const {
    method["snapped"] = score_json(s.snapped, scene.crossings);
    method["source"] = score_json(s.source, scene.crossings);
    method["cracks"] = {{"gaps", s.cracks.gaps},
                        {"double_hits", s.cracks.double_hits},
                        {"t_junctions", s.cracks.t_junctions}};
    add_wrong_pixels(method["snapped"], s.visible.wrong_snapped);
    add_wrong_pixels(method["source"], s.visible.wrong_source);
    method["source"]["wrong_surface_pixels"] = s.visible.wrong_surface;
    method["source"]["slits"] = s.visible.slits;
    const lab::CoverageMethod& scored = methods.find_coverage(method["name"].get<std::string>());
    if (scored.contract_depth && scored.info.exact)
      method["snapped"]["unexplained_pixels"] = s.visible.unexplained;
    method["depth"] = {{"max_ulp", s.visible.max_ulp}, {"rms_ulp", s.visible.rms_ulp}};
  }
  void operator()(const lab::VisibilityScores& s) const {
    method["snapped"] = score_json(s.snapped);
    method["snapped"]["depth_ties"] = s.depth_ties;
    method["source"] = score_json(s.source);
    method["broken"] = s.broken;
  }
  void operator()(const lab::FacingScores& s) const {
    method["snapped"] = score_json(s.snapped);
    method["source"] = score_json(s.source);
    method["disagreements"] = s.disagreements;
    method["broken"] = s.broken;
  }
  void operator()(const lab::ClippingScore& s) const {
    Json& score = method["score"] = {{"missing", s.missing},
                                     {"extra", s.extra},
                                     {"wrong_triangle", s.wrong_triangle},
                                     {"depth_ties", s.depth_ties},
                                     {"wrong_depth", s.wrong_depth},
                                     {"worst_distance", s.worst_distance},
                                     {"hairline", s.hairline},
                                     {"differs_from_ours", s.differs_from_ours},
                                     {"not_a_number", s.not_a_number},
                                     {"out_of_range", s.out_of_range},
                                     {"broken", s.broken}};
    add_rate(score, s.wrong(), scene.covered);
  }
  void operator()(const lab::ProjectionScore& s) const {
    Json& score = method["score"] = {{"errors", s.wrong},
                                     {"by_rounding", s.by_rounding},
                                     {"by_projection", s.by_projection},
                                     {"folds", s.folds}};
    add_rate(score, s.wrong, scene.crossings);
  }
};

Json scene_json(const SceneResult& scene, const ChosenMethods& methods) {
  Json result{{"name", scene.name},       {"family", name_of(scene.family)},
              {"summary", scene.summary}, {"width", scene.width},
              {"height", scene.height},   {"triangles", scene.triangles},
              {"covered", scene.covered}, {"kind", kSceneKinds[static_cast<std::size_t>(scene.kind)]},
              {"methods", Json::array()}};
  if (scene.crossings != 0) result["crossings"] = scene.crossings;
  if (scene.family == Family::coverage) {
    result["shared_crossings"] = scene.shared_crossings;
    result["largest_side_px"] = scene.largest_side_px;
    result["slits"] = scene.slits;
  }
  if (scene.family == Family::facing) result["faces"] = scene.triangles;
  for (const MethodResult& method : scene.methods) {
    Json& entry = result["methods"].emplace_back(Json{{"name", method.name}});
    std::visit(AddScore{entry, scene, methods}, method.score);
  }
  return result;
}

Json per_frame_json(const PerFrame& counts, int frames) {
  Json result{{"median", counts.median}, {"worst", counts.worst}, {"total", counts.total}};
  if (counts.total == 0) result["bound_per_frame"] = lab::rate_bound(static_cast<std::uint64_t>(frames));
  return result;
}

Json counts_json(const CubeCounts& counts, int frames) {
  return {{"missing", per_frame_json(counts.missing, frames)},
          {"extra", per_frame_json(counts.extra, frames)}};
}

Json motion_json(const MotionResult& motion) {
  Json result{{"name", motion.name},     {"frames", motion.frames},   {"width", motion.width},
              {"height", motion.height}, {"changes", motion.changes}, {"methods", Json::array()}};
  for (const auto& [name, superfluous] : motion.superfluous)
    result["methods"].push_back({{"name", name}, {"superfluous", superfluous}});
  return result;
}

Json cube_json(const CubeResult& cube) {
  Json result{
      {"frames", cube.frames}, {"width", cube.width}, {"height", cube.height}, {"methods", Json::array()}};
  for (const CubeMethodResult& method : cube.methods) {
    Json& entry = result["methods"].emplace_back(counts_json(method.source, cube.frames));
    entry["name"] = method.name;
    entry["gaps"] = per_frame_json(method.gaps, cube.frames);
    entry["double_hits"] = per_frame_json(method.double_hits, cube.frames);
    entry["snapped"] = counts_json(method.snapped, cube.frames);
  }
  return result;
}

}  // namespace

Json accuracy_json(const AccuracyReport& report, const AccuracyPlan& plan) {
  Json result{{"quick", plan.quick},
              {"subpixel_bits", plan.subpixel_bits},
              {"ok", report.ok()},
              {"methods", Json::array()},
              {"scenes", Json::array()}};
  const ChosenMethods methods = methods_of(plan);
  for (const auto& [family, info] : methods.all()) {
    Json& method = result["methods"].emplace_back(Json{{"family", name_of(family)},
                                                       {"name", info->name},
                                                       {"summary", info->summary},
                                                       {"source", info->source},
                                                       {"promise", info->promise},
                                                       {"exact", info->exact}});
    if (family == Family::projection)
      method["other_bits"] = std::ranges::any_of(lab::projections_with_other_bits(),
                                                 [&](const auto& m) { return m.info.name == info->name; });
    if (family != Family::coverage) continue;
    const lab::CoverageMethod& coverage = methods.find_coverage(info->name);
    method["max_side_px"] = coverage.promise.max_side_px;
    method["engine"] = coverage.engine;
    if (!coverage.simd) method["simd_note"] = coverage.simd_note;
  }
  for (const SceneResult& scene : report.scenes) result["scenes"].push_back(scene_json(scene, methods));
  if (report.turning_cube) result["turning_cube"] = cube_json(*report.turning_cube);
  for (const MotionResult& motion : report.motions) result["motions"].push_back(motion_json(motion));
  return result;
}

}  // namespace edgewise::tools
