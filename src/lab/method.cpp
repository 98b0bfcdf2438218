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

template <typename Methods>
std::vector<MethodInfo> infos(const Methods& methods) {
  std::vector<MethodInfo> list;
  for (const auto& method : methods) list.push_back(method.info);
  return list;
}

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
      return infos(coverage_methods());
    case Family::visibility:
      return infos(visibility_methods());
    case Family::facing:
      return infos(facing_methods());
    case Family::clipping:
      return infos(clipping_methods());
    case Family::projection:
      return infos(projection_methods());
  }
  throw std::invalid_argument("not a family");
}

}  // namespace edgewise::lab
