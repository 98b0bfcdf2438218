#include "lab/method.h"

#include <stdexcept>

#include "core/nearest_name.h"
#include "lab/clipping/clipping.h"
#include "lab/coverage/coverage.h"
#include "lab/facing/facing.h"
#include "lab/projection/projection.h"
#include "lab/visibility/visibility.h"

namespace edgewise::lab {

namespace {

constexpr std::array<std::string_view, kFamilies.size()> kNames{"coverage", "visibility", "facing",
                                                                "clipping", "projection"};

}  // namespace

std::string_view name_of(Family family) {
  return kNames[static_cast<std::size_t>(family)];
}

Family find_family(std::string_view name) {
  return find_named("family", name, std::span<const Family>(kFamilies),
                    [](Family family) { return name_of(family); });
}

std::vector<MethodInfo> methods_of(Family family) {
  switch (family) {
    case Family::coverage:
      return infos_of(coverage_methods());
    case Family::visibility:
      return infos_of(visibility_methods());
    case Family::facing:
      return infos_of(facing_methods());
    case Family::clipping:
      return infos_of(clipping_methods());
    case Family::projection:
      return infos_of(projection_methods());
  }
  throw std::invalid_argument("not a family");
}

}  // namespace edgewise::lab
