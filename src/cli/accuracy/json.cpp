#include <nlohmann/json.hpp>

#include "cli/accuracy/score.h"

namespace edgewise::tools {

namespace {

using Json = nlohmann::json;

// Adds a method's scores.
struct AddScore {
  Json& method;
  const SceneResult& scene;

  Json with_rate(Json score, std::uint64_t errors, std::uint64_t trials) const {
    score["errors_per_million"] = lab::per_million(errors, trials);
    return score;
  }
  Json score_json(const lab::CoverageScore& s, std::uint64_t wrong_pixels) const {
    return with_rate({{"errors", s.errors()}, {"wrong_pixels", wrong_pixels}}, s.errors(), scene.crossings);
  }
  void operator()(const CoverageScores& s) const {
    method["snapped"] = score_json(s.snapped, s.visible.wrong_snapped);
    method["source"] = score_json(s.source, s.visible.wrong_source);
    method["source"]["wrong_surface_pixels"] = s.visible.wrong_surface;
    method["source"]["slits"] = s.visible.slits;
    method["cracks"] = {{"gaps", s.cracks.gaps},
                        {"double_hits", s.cracks.double_hits},
                        {"t_junctions", s.cracks.t_junctions}};
  }
  void operator()(const lab::VisibilityScores& s) const {
    for (const auto& [truth, of] : {std::pair("snapped", s.snapped), {"source", s.source}})
      method[truth] = with_rate({{"wrong_triangle", of.wrong_triangle}}, of.wrong_triangle, of.covered);
  }
  void operator()(const lab::FacingScores& s) const {
    for (const auto& [truth, of] : {std::pair("snapped", s.snapped), {"source", s.source}})
      method[truth] = with_rate({{"misclassified", of.misclassified}}, of.misclassified, of.faces);
  }
  void operator()(const lab::ClippingScore& s) const {
    method["score"] = with_rate({{"missing", s.missing},
                                 {"extra", s.extra},
                                 {"wrong_triangle", s.wrong_triangle},
                                 {"wrong_depth", s.wrong_depth}},
                                s.wrong(), scene.covered);
  }
  void operator()(const lab::ProjectionScore& s) const {
    method["score"] = with_rate({{"errors", s.wrong},
                                 {"by_rounding", s.by_rounding},
                                 {"by_projection", s.by_projection},
                                 {"folds", s.folds}},
                                s.wrong, scene.crossings);
  }
};

Json scene_json(const SceneResult& scene) {
  Json result{{"name", scene.name},
              {"family", name_of(scene.family)},
              {"triangles", scene.triangles},
              {"covered", scene.covered},
              {"kind", kSceneKinds[static_cast<std::size_t>(scene.kind)]},
              {"methods", Json::array()}};
  if (scene.crossings != 0) result["crossings"] = scene.crossings;
  if (scene.family == Family::coverage) {
    result["shared_crossings"] = scene.shared_crossings;
    result["largest_side_px"] = scene.largest_side_px;
    result["slits"] = scene.slits;
  }
  for (const MethodResult& method : scene.methods) {
    Json& entry = result["methods"].emplace_back(Json{{"name", method.name}});
    std::visit(AddScore{entry, scene}, method.score);
    if (broke_promise(method)) entry["broke_promise"] = true;
  }
  return result;
}

Json motion_json(const MotionResult& motion) {
  Json result{{"name", motion.name},
              {"frames", motion.frames},
              {"changes", motion.changes},
              {"methods", Json::array()}};
  for (const auto& [name, superfluous] : motion.superfluous)
    result["methods"].push_back({{"name", name}, {"superfluous", superfluous}});
  return result;
}

Json choice_json(const ChoiceResult& choice) {
  const auto total = [](const ChoiceTotal& of) -> Json {
    return {{"least", of.least}, {"most", of.most}, {"wrong_pixels", of.wrong}, {"holes", of.holes}};
  };
  Json result{{"name", choice.name},
              {"summary", choice.summary},
              {"frames", choice.frames},
              {"methods", Json::array()}};
  for (const auto& [name, of] : choice.methods) {
    result["methods"].push_back(total(of));
    result["methods"].back()["name"] = name;
  }
  if (choice.float_projection) result["float_projection"] = total(*choice.float_projection);
  return result;
}

Json cube_json(const CubeResult& cube) {
  Json result{{"frames", cube.frames}, {"methods", Json::array()}};
  for (const CubeMethodResult& m : cube.methods) {
    Json method{{"name", m.name},
                {"gaps", {{"total", m.gaps}}},
                {"double_hits", {{"total", m.double_hits}}},
                {"missing", {{"total", m.missing}}},
                {"extra", {{"total", m.extra}}}};
    if (m.exact && m.wrong_snapped != 0) method["broke_promise"] = true;
    result["methods"].push_back(method);
  }
  return result;
}

}  // namespace

Json accuracy_json(const AccuracyReport& report, const AccuracyPlan& plan) {
  Json result{{"subpixel_bits", plan.subpixel_bits}, {"methods", Json::array()}, {"scenes", Json::array()}};
  const ChosenMethods methods = methods_of(plan);
  for (const auto& [family, info] : methods.all())
    result["methods"].push_back({{"family", name_of(family)},
                                 {"name", info->name},
                                 {"source", info->source},
                                 {"promise", info->promise},
                                 {"exact", info->exact}});
  for (std::size_t i = 0; i < methods.coverage.size(); ++i)  // which come first
    result["methods"][i]["max_side_px"] = methods.coverage[i]->promise.max_side_px;
  for (const SceneResult& scene : report.scenes) result["scenes"].push_back(scene_json(scene));
  if (report.turning_cube) result["turning_cube"] = cube_json(*report.turning_cube);
  for (const MotionResult& motion : report.motions) result["motions"].push_back(motion_json(motion));
  for (const ChoiceResult& choice : report.choices) result["choices"].push_back(choice_json(choice));
  return result;
}

}  // namespace edgewise::tools
