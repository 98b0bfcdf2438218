#include "lab/needs/needs.h"

#include <algorithm>

#include "edgewise/contract.h"

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
  all.push_back(ranges_.edge_values(contract::kSubBits));
  return all;
}

}  // namespace edgewise::lab
