// One method for each of the four stages from a scene to its picture: facing, clipping, coverage and
// visibility. The library's own pipeline uses the exact methods; any stage may use a laboratory method
// instead.
#pragma once

#include <string>

#include "lab/clipping/clipping.h"
#include "lab/coverage/coverage.h"
#include "lab/facing/facing.h"
#include "lab/visibility/visibility.h"

namespace edgewise::lab {

struct StageMethods {
  const CoverageMethod* coverage = nullptr;
  const ClippingMethod* clipping = &clipping_methods().front();
  const VisibilityMethod* visibility = &visibility_methods().front();
  const FacingMethod* facing = &facing_methods().front();

  // Whether the stage uses the library's method.
  bool our_coverage() const { return coverage->contract_depth; }
  bool our_clipping() const { return clipping == &clipping_methods().front(); }
  bool our_visibility() const { return visibility == &visibility_methods().front(); }
  bool our_facing() const { return facing == &facing_methods().front(); }
  bool fills() const { return coverage->fills; }
  bool ours() const { return our_coverage() && our_clipping() && our_visibility() && our_facing(); }

  bool operator==(const StageMethods&) const = default;
};

// This backend for coverage, and the library's methods for the other stages. Throws like the finders below.
StageMethods our_choice(std::string_view backend);
// All throw std::invalid_argument for an unknown name; the message suggests the nearest known one.
const ClippingMethod& find_clipping_method(std::string_view name);
const VisibilityMethod& find_visibility_method(std::string_view name);
const FacingMethod& find_facing_method(std::string_view name);

// Sets the stage of `choice` to which the named method belongs; false if no method has this name.
bool put(std::string_view method, StageMethods& choice);

// The part of a choice that can be drawn, and the reason if that is not all of it.
struct Drawn {
  StageMethods choice;
  std::string because;  // empty if it is all
};
// Streams keep only the coverage method: they are clipped already, and have no camera for facing tests and
// view distances. A visibility method brings exact coverage of its own, so it replaces an inexact coverage
// method.
Drawn drawable_part(const StageMethods& choice, bool stream);

// The names of the methods that are not the library's, joined by " + "; the backend's name if there are none.
std::string describe(const StageMethods& choice);

}  // namespace edgewise::lab
