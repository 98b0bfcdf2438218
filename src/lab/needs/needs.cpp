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
  visibility_.add(frame, scene, options_.threads);
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
  all.push_back(ranges_.edge_values(smallest().subpixel_bits));
  return all;
}

Pipeline Needs::smallest() const {
  using Order = Pipeline::Order;
  Pipeline result = kFull;
  const auto fewest = [](std::span<const int> available, int otherwise, auto&& enough) {
    const auto found = std::find_if(available.begin(), available.end(), enough);
    return found == available.end() ? otherwise : *found;
  };
  result.subpixel_bits = fewest(kPipelineSubpixelBits, kFull.subpixel_bits,
                                [&](int bits) { return coverage_.enough_subpixel_bits(bits); });
  result.edge_bits = ranges_.edge_value_bits(result.subpixel_bits) <= 32 ? 32 : 64;
  const Question visibility = visibility_.questions().front();
  const Answer* const cheapest = visibility.cheapest();
  constexpr Order kOrders[] = {Order::submission, Order::mean, Order::farthest, Order::depth};
  if (cheapest != nullptr) result.order = kOrders[cheapest - visibility.answers.data()];
  result.depth_bits =
      result.order != Order::depth ? 0 : fewest(kPipelineDepthBits, kFull.depth_bits, [&](int bits) {
        return visibility_.enough_depth_bits(bits);
      });
  return result;
}

std::uint64_t wrong_px(const Pipeline& pipeline, const VisibilityScene& scene,
                       std::span<const std::uint32_t> truth) {
  VisibilityFrame frame;
  draw(pipeline, scene, frame);
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i < frame.visible.size(); ++i) wrong += frame.visible[i] != truth[i];
  return wrong;
}

}  // namespace edgewise::lab
