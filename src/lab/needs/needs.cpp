#include "lab/needs/needs.h"

#include <algorithm>

#include "core/grid.h"
#include "edgewise/contract.h"
#include "lab/cases/to_stream.h"

namespace edgewise::lab {

const Answer* Question::needed() const {
  const auto failing =
      std::find_if(answers.rbegin(), answers.rend(), [](const Answer& a) { return !a.enough(); });
  return failing == answers.rbegin() ? nullptr : &*failing.base();
}

const Answer* Question::next_weaker() const {
  const Answer* const first_enough = needed();
  if (first_enough == nullptr) return &answers.back();
  return first_enough == answers.data() ? nullptr : first_enough - 1;
}

std::string bits_name(int bits, std::string_view kind) {
  return std::to_string(bits) + " " + std::string(kind) + (kind.empty() ? "bit" : " bit") +
         (bits == 1 ? "" : "s");
}

void Needs::add(const Drawable& drawable, FrontendOptions options) {
  if (const auto rounded = in_floats(drawable)) return add(*rounded, options);
  options.payload = Payload::id;
  options.shade = false;
  options.keep_unsnapped = options.keep_states = false;
  const StudiedFrame frame{frames_++, drawable, options};
  const auto reach = ranges_.add(frame);
  const CoverageScene scene = coverage_scene(drawable, options);
  pipelines_.add(frame, scene, reach, options_.threads);
  coverage_.add(frame, scene, options_.threads);
}

std::vector<Question> Needs::edges() const {
  std::vector<Question> all = coverage_.questions();
  all.push_back(ranges_.edge_values(Coarse::kSubBits));
  return all;
}

}  // namespace edgewise::lab
