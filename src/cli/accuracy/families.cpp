// Judges visibility, facing, clipping and projection methods against the exact references of their family.
#include <algorithm>

#include "cli/accuracy/score.h"
#include "core/parallel.h"
#include "lab/cases/backend_comparison.h"

namespace edgewise::tools {

namespace {

// Calls score_one(method) for all methods, on several threads.
template <typename Method, typename ScoreOne>
void score_all(const std::vector<const Method*>& methods, const Judging& judging, SceneResult& result,
               ScoreOne&& score_one) {
  result.methods.resize(methods.size());
  parallel_for(judging.plan.threads, static_cast<int>(methods.size()), [&](int n) {
    const auto i = static_cast<std::size_t>(n);
    const lab::MethodInfo& info = methods[i]->info;
    result.methods[i] = {std::string(info.name), info.exact, score_one(*methods[i])};
  });
}

// Adds a close-up for each method for which wrong(score) holds.
template <typename Method, typename Wrong, typename Picture>
void picture_all(const std::vector<const Method*>& methods, const Judging& judging, const SceneResult& result,
                 Wrong&& wrong, Picture&& picture) {
  if (!judging.plan.pictures || !judging.scene.smallest) return;
  for (std::size_t i = 0; i < methods.size(); ++i)
    if (wrong(result.methods[i].score))
      judging.closeups.push_back(closeup(
          closeup_name(result.family, judging.scene.name, methods[i]->info.name), picture(*methods[i])));
}

// Pixels that show a triangle.
std::uint64_t covered_pixels(const std::vector<std::uint32_t>& visible) {
  return static_cast<std::uint64_t>(
      std::count_if(visible.begin(), visible.end(), [](std::uint32_t id) { return id != lab::kNoTriangle; }));
}

}  // namespace

void judge(const lab::VisibilityScene& scene, const Judging& judging, SceneResult& result) {
  const auto& methods = judging.methods.visibility;
  const auto truth = lab::true_visible_triangles(scene);
  result.width = scene.width;
  result.height = scene.height;
  result.triangles = scene.triangles.size();
  result.covered = covered_pixels(truth.snapped);
  score_all(methods, judging, result,
            [&](const lab::VisibilityMethod& method) { return lab::score(method, scene, truth); });
  lab::VisibilityFrame frame;
  picture_all(
      methods, judging, result,
      [](const Score& score) { return std::get<lab::VisibilityScores>(score).snapped.wrong_triangle != 0; },
      [&](const lab::VisibilityMethod& method) {
        method.draw(scene, frame);
        lab::MarkedPicture picture =
            lab::mark_visible_triangles(truth.snapped, frame.visible, {scene.width, scene.height});
        for (const lab::VisibilityTriangle& t : scene.triangles)
          for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            picture.lines.push_back({t.screen.x_q15[i] / 32768.0, t.screen.y_q15[i] / 32768.0,
                                     t.screen.x_q15[j] / 32768.0, t.screen.y_q15[j] / 32768.0});
          }
        return picture;
      });
}

void judge(const lab::FacingScene& scene, const Judging& judging, SceneResult& result) {
  const auto& methods = judging.methods.facing;
  const auto facts = lab::facing_facts(scene, judging.plan.threads);
  result.width = scene.view.size.width;
  result.height = scene.view.size.height;
  result.triangles = scene.faces.size();
  result.covered = static_cast<std::uint64_t>(std::count_if(
      facts.begin(), facts.end(), [](const lab::FaceFacts& f) { return f.source.covers_sample; }));
  score_all(methods, judging, result,
            [&](const lab::FacingMethod& method) { return lab::score(method, scene, facts); });
  std::vector<std::uint8_t> front(scene.faces.size());
  constexpr std::size_t kMostPictured = 20;  // more faces would occlude one another
  if (scene.faces.size() > kMostPictured) return;
  picture_all(
      methods, judging, result,
      [](const Score& score) { return std::get<lab::FacingScores>(score).source.misclassified != 0; },
      [&](const lab::FacingMethod& method) {
        method.classify(scene, front);
        return lab::mark_faces(scene, facts, front);
      });
}

void judge(const lab::ClippingScene& scene, const Judging& judging, SceneResult& result) {
  const auto& methods = judging.methods.clipping;
  const auto truth = lab::clipping_truth(scene, judging.plan.threads);
  result.width = scene.size.width;
  result.height = scene.size.height;
  result.triangles = scene.mesh().triangles.size();
  result.covered = covered_pixels(truth.visible);
  score_all(methods, judging, result,
            [&](const lab::ClippingMethod& method) { return lab::score(method, scene, truth); });
  lab::ClippingFrame frame(scene.size);
  picture_all(
      methods, judging, result,
      [](const Score& score) {  // the picture doesn't show wrong depths
        const auto& s = std::get<lab::ClippingScore>(score);
        return s.missing + s.extra + s.wrong_triangle != 0;
      },
      [&](const lab::ClippingMethod& method) {
        method.draw(scene, frame);
        return lab::mark_visible_triangles(truth.visible, lab::payloads_of(frame.picture),
                                           {scene.size.width, scene.size.height});
      });
}

void judge(const lab::ProjectionScene& scene, const Judging& judging, SceneResult& result) {
  const auto& methods = judging.methods.projection;
  result.width = scene.size.width;
  result.height = scene.size.height;
  std::vector<lab::ProjectionScore> scores(methods.size());
  for (int frame = 0; frame < scene.frames; ++frame) {
    const lab::ProjectionJudge judge(scene.make(frame), scene.size, judging.plan.threads);
    result.triangles += judge.triangles();
    result.covered += judge.covered();
    result.crossings += judge.crossings();
    parallel_for(judging.plan.threads, static_cast<int>(methods.size()), [&](int n) {
      const auto i = static_cast<std::size_t>(n);
      scores[i] += judge.score(*methods[i]);
    });
  }
  for (std::size_t i = 0; i < methods.size(); ++i)
    result.methods.push_back({std::string(methods[i]->info.name), methods[i]->info.exact, scores[i]});
}

}  // namespace edgewise::tools
