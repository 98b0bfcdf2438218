#include "lab/needs/needs.h"

#include <algorithm>

namespace edgewise::lab {

void Needs::add(const Drawable& drawable, FrontendOptions options) {
  options.payload = Payload::id;
  options.shade = false;
  options.keep_unsnapped = options.keep_states = false;
  const StudiedFrame frame{frames_++, drawable, options, options_.keep_pictures};
  const auto reach = ranges_.add(frame);
  if (options_.ranges_only) return;
  if (std::holds_alternative<Scene>(drawable)) {
    if (!clipping_) clipping_.emplace();
    clipping_->add(frame, reach);
    if (options.cull == Cull::back) {
      if (!facing_) facing_.emplace();
      facing_->add(frame);
    }
  }
  const VisibilityScene scene = visibility_scene(drawable, options);
  most_triangles_ = std::max<std::uint64_t>(most_triangles_, scene.triangles.size());
  visibility_.add(frame, scene, true_visible_triangles(scene), options_.threads);
  coverage_.add(frame, coverage_scene(drawable, options), options_.threads);
}

std::vector<Question> Needs::questions() const {
  std::vector<Question> all;
  const auto append = [&](std::vector<Question> some) {
    std::move(some.begin(), some.end(), std::back_inserter(all));
  };
  if (clipping_) append(clipping_->questions(ranges_));
  if (facing_) append(facing_->questions());
  append(visibility_.questions());
  append(coverage_.questions());
  all.push_back(ranges_.edge_values(coverage_.fewest_subpixel_bits()));
  return all;
}

Pipeline Needs::smallest() const {
  using Order = Pipeline::Order;
  Pipeline result{};
  result.subpixel_bits = pipeline_subpixel_bits(coverage_.fewest_subpixel_bits());
  result.edge_bits = ranges_.edge_value_bits(result.subpixel_bits) <= 32 ? 32 : 64;
  const Question visibility = visibility_.questions().front();
  const Answer* const cheapest = visibility.cheapest();
  const auto index = cheapest == nullptr ? visibility.answers.size() - 1
                                         : static_cast<std::size_t>(cheapest - visibility.answers.data());
  constexpr Order kOrders[] = {Order::submission, Order::mean, Order::farthest, Order::depth};
  result.order = kOrders[index];
  if (result.order == Order::depth) {
    const int fewest = visibility_.fewest_depth_bits();
    result.depth_bits = fewest == 0 ? kFull.depth_bits : fewest <= 16 ? 16 : fewest <= 24 ? 24 : 30;
  }
  return result;
}

std::uint64_t wrong_px(const Pipeline& pipeline, const VisibilityScene& scene,
                       const TrueVisibleTriangles& truth) {
  VisibilityFrame frame;
  draw(pipeline, scene, frame);
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i < frame.visible.size(); ++i) wrong += frame.visible[i] != truth.floats[i];
  return wrong;
}

}  // namespace edgewise::lab
