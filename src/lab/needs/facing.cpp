#include "lab/needs/needs.h"

#include <algorithm>

#include "lab/choice.h"
#include "lab/view_space.h"

namespace edgewise::lab {

FacingNeeds::FacingNeeds()
    : back_faces_{"back faces", {{"may be drawn"}, {"must be culled"}}}, test_{"facing test", {}} {
  // From the cheapest on: one coordinate of the normal; a dot product with a ray, which costs a subtraction,
  // or a mean and square roots; projected areas.
  for (const char* name : {"normal_z", "normal_dot_object", "normal_dot_eye", "normal_dot_centroid",
                           "normal_dot_mean_ray", "float_area", "snapped_area"})
    test_.answers.push_back({name});
  back_faces_.trial = test_.trial = "pixel";
}

void FacingNeeds::add(const StudiedFrame& frame) {
  Frontend frontend;
  const auto culled = frontend.run(frame.drawable, frame.options);
  const auto right = picture_of_ids(culled, frame.size());
  FrontendOptions options = frame.options;
  options.cull = Cull::none;
  const auto all = frontend.run(frame.drawable, options);
  back_faces_.trials += frame.pixels();
  test_.trials += frame.pixels();
  if (Answer& draw = back_faces_.answers.front(); draw.enough())
    compare_pictures(right, picture_of_ids(all, frame.size()), frame, draw);

  const ClippingScene seen = in_view_space(std::get<Scene>(frame.drawable), frame.size());
  for (Answer& answer : test_.answers) {
    if (!answer.enough()) continue;
    const auto fronts = fronts_of(find_facing_method(answer.name), seen);
    std::vector<ScreenTriangle> kept;
    std::copy_if(all.begin(), all.end(), std::back_inserter(kept),
                 [&](const ScreenTriangle& t) { return fronts[t.payload] != 0; });
    compare_pictures(right, picture_of_ids(kept, frame.size()), frame, answer);
  }
}

}  // namespace edgewise::lab
