// The four families of methods that the laboratory compares.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "lab/method.h"

namespace edgewise::lab {

enum class Family { coverage, visibility, facing, clipping };
inline constexpr std::array kFamilies{Family::coverage, Family::visibility, Family::facing, Family::clipping};

std::string_view name_of(Family family);
// Throws std::invalid_argument for an unknown name; the message suggests the nearest known one.
Family find_family(std::string_view name);
// In the order of the family's registry.
std::vector<MethodInfo> methods_of(Family family);

}  // namespace edgewise::lab
