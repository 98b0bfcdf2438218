#include "lab/needs/needs.h"

#include <fmt/format.h>

#include <algorithm>

#include "lab/clipping/pipeline.h"
#include "lab/view_space.h"

namespace edgewise::lab {

namespace {

constexpr std::uint16_t kPlanes[kViewPlanes] = {kNear, kFar, kGuard};
enum Level { kNothing, kDrop, kClip };

// Draws a frame that treats triangles beyond one plane at this level, and clips at the others.
std::vector<std::uint32_t> draw_at(Level level, std::uint16_t plane, const ClippingScene& scene, Cull cull,
                                   ClippingFrame& frame) {
  draw_clipped(scene, frame, [&](const ClipVertex(&triangle)[3], std::uint32_t id) {
    std::uint16_t any = 0, all = kInvisible;
    for (const ClipVertex& v : triangle) {
      const std::uint16_t sides = outside_of(v, frame.view);
      any |= sides, all &= sides;
    }
    if (level == kNothing && (any & plane) != 0) all = 0;
    if ((any & kNotFinite) != 0 || all != 0) return;
    auto planes = static_cast<std::uint16_t>(any & kMustClip);
    // Clipping at the sides would hide the lack of a near plane: a point between two of them has w >= 0.
    if (level != kClip && (any & plane) != 0) planes &= plane == kNear ? 0 : ~plane;
    const auto polygon = planes == 0 ? std::span<const ClipVertex>(triangle)
                                     : frame.clipper.clip(triangle, planes, frame.view);
    const auto before = static_cast<std::ptrdiff_t>(frame.triangles.size());
    emit(polygon, id, false, frame);
    frame.triangles.erase(std::remove_if(frame.triangles.begin() + before, frame.triangles.end(),
                                         [&](const ScreenTriangle& t) {
                                           const std::int64_t area = contract::signed_area(t);
                                           return !keeps(cull, (area > 0) - (area < 0));
                                         }),
                          frame.triangles.end());
  });
  return payloads_of(frame.picture);
}

}  // namespace

ClippingNeeds::ClippingNeeds() {
  for (std::size_t i = 0; i < questions_.size(); ++i) {
    const std::string name(name_of(static_cast<ViewPlane>(i)));
    questions_[i] = {name, {{"nothing"}, {"drop whole triangles"}, {"clip"}}};
    questions_[i].trial = "pixel";
  }
}

void ClippingNeeds::add(const StudiedFrame& frame, const std::array<Reach, kViewPlanes>& reach) {
  std::optional<ClippingScene> seen;
  std::optional<ClippingFrame> canvas;
  std::vector<std::uint32_t> right;
  const auto draw = [&](Level level, std::uint16_t plane) {
    return draw_at(level, plane, *seen, frame.options.cull, *canvas);
  };
  for (std::size_t i = 0; i < questions_.size(); ++i) {
    Question& question = questions_[i];
    question.trials += frame.pixels();
    const bool doubts[] = {reach[i].beyond != 0, reach[i].crossing != 0};
    for (const Level level : {kNothing, kDrop}) {
      if (!doubts[level] || !question.answers[level].enough()) continue;
      if (!seen) {
        seen = in_world_space(std::get<Scene>(frame.drawable), frame.size());
        canvas.emplace(frame.size());
        right = draw(kClip, kNear);
      }
      compare_pictures(right, draw(level, kPlanes[i]), frame, question.answers[level]);
    }
  }
}

std::vector<Question> ClippingNeeds::questions(const Ranges& ranges) const {
  std::vector<Question> result(questions_.begin(), questions_.end());
  for (int i = 0; i < kViewPlanes; ++i) {
    const auto plane = static_cast<ViewPlane>(i);
    const Reach& reach = ranges.reach(plane);
    Question& question = result[static_cast<std::size_t>(i)];
    if (reach.beyond == 0)
      question.proof = ranges.describe(plane);
    else if (reach.crossing == 0 && !question.answers[kNothing].enough())
      question.proof = fmt::format(
          "of the {} triangles that reach beyond it, each lies outside one side of the view", reach.beyond);
  }
  return result;
}

}  // namespace edgewise::lab
