// Judges methods on one scene, per family.
#pragma once

#include "cli/accuracy/accuracy.h"

namespace edgewise::tools {

// The methods that the plan names, in registry order.
struct ChosenMethods {
  std::vector<const lab::CoverageMethod*> coverage;
  std::vector<const lab::VisibilityMethod*> visibility;
  std::vector<const lab::FacingMethod*> facing;
  std::vector<const lab::ClippingMethod*> clipping;
  std::vector<const lab::ProjectionMethod*> projection;

  bool has(Family family) const;
  std::vector<std::pair<Family, const lab::MethodInfo*>> all() const;
};
ChosenMethods methods_of(const AccuracyPlan& plan);

// Whether a method covers positions of so many bits exactly. Those of others than backends have 8.
inline bool is_exact(const lab::CoverageMethod& method, int subpixel_bits) {
  return method.info.exact && (method.backend || subpixel_bits == 8);
}

// The inputs of judge() and its sink for close-ups.
struct Judging {
  const AccuracyPlan& plan;
  const ChosenMethods& methods;
  const lab::LabScene& scene;
  std::vector<Closeup>& closeups;
};

// Fill in all of `result` except what identifies the scene (family, name). Of coverage they set the
// kind of a scene that is not small.
void judge(const lab::CoverageScene& scene, const Judging& judging, SceneResult& result);
void judge(const lab::VisibilityScene& scene, const Judging& judging, SceneResult& result);
void judge(const lab::FacingScene& scene, const Judging& judging, SceneResult& result);
void judge(const lab::ClippingScene& scene, const Judging& judging, SceneResult& result);
void judge(const lab::ProjectionScene& scene, const Judging& judging, SceneResult& result);

CubeResult judge_turning_cube(const AccuracyPlan& plan, const ChosenMethods& methods,
                              std::vector<Closeup>& closeups);
std::vector<MotionResult> judge_motions(const AccuracyPlan& plan, const ChosenMethods& methods);
std::vector<ChoiceResult> judge_choices(const AccuracyPlan& plan, const ChosenMethods& methods);

// "coverage-drtk_quad-float_le"
std::string closeup_name(Family family, std::string_view scene, std::string_view method);

}  // namespace edgewise::tools
