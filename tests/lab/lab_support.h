// Shared by the tests of the laboratory's families: lookup by name.
#pragma once

#include <algorithm>
#include <string_view>

namespace edgewise::lab {

template <typename Methods>
const auto& method_named(const Methods& all, std::string_view name) {
  return *std::find_if(all.begin(), all.end(), [&](const auto& m) { return m.info.name == name; });
}

template <typename Cases>
auto make_case_named(const Cases& all, std::string_view name) {
  return std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; })->make();
}

}  // namespace edgewise::lab
