// "Did you mean …?" for every place that looks a name up.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace edgewise {

// "unknown KIND 'NAME'; did you mean 'NEAREST'? (known: …)", the nearest by edit distance.
std::string unknown_name(std::string_view kind, std::string_view name,
                         std::span<const std::string_view> known);

}  // namespace edgewise
