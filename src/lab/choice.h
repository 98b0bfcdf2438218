// Which method stands at each of the four stages from a scene to its picture: facing, clipping, coverage and
// visibility. All exact is the pipeline of the library; each stage may be replaced by a method of the
// laboratory.
#pragma once

#include <string>

#include "lab/clipping/clipping.h"
#include "lab/coverage/coverage.h"
#include "lab/facing/facing.h"
#include "lab/visibility/visibility.h"

namespace edgewise::lab {

struct Choice {
  const CoverageMethod* coverage = nullptr;
  const ClippingMethod* clipping = &clipping_methods().front();
  const VisibilityMethod* visibility = &visibility_methods().front();
  const FacingMethod* facing = &facing_methods().front();

  // Those of the library.
  bool our_coverage() const { return coverage->contract_depth; }
  bool our_clipping() const { return clipping == &clipping_methods().front(); }
  bool our_visibility() const { return visibility == &visibility_methods().front(); }
  bool our_facing() const { return facing == &facing_methods().front(); }
  bool fills() const { return coverage->fills; }
  bool ours() const { return our_coverage() && our_clipping() && our_visibility() && our_facing(); }

  bool operator==(const Choice&) const = default;
};

// With this backend at the stage of coverage, and ours elsewhere.
Choice our_choice(std::string_view backend);
// All throw std::invalid_argument, with the nearest known name, for an unknown one.
const ClippingMethod& find_clipping_method(std::string_view name);
const VisibilityMethod& find_visibility_method(std::string_view name);
const FacingMethod& find_facing_method(std::string_view name);

// Puts a method of any family at its stage; false if no method has this name.
bool put(std::string_view method, Choice& choice);

// What can be drawn of a choice, and why not all of it.
struct Drawn {
  Choice choice;
  std::string because;  // empty if it is all
};
// A stream has been clipped, and has no camera to judge faces and distances by. A visibility method covers
// exactly, by itself; so it takes the place of a coverage method that does not.
Drawn drawable_part(const Choice& choice, bool stream);

// The names of what is not ours; the backend's if all is.
std::string describe(const Choice& choice);

}  // namespace edgewise::lab
