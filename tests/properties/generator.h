// Helpers of the generators.
#pragma once

#include <rapidcheck.h>

#include <cstdint>

#include "core/random.h"
#include "edgewise/contract.h"

namespace edgewise::testing {

inline std::int32_t between(Random& random, std::int32_t low, std::int32_t high) {
  return low + static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(high - low + 1)));
}

inline float pixels(std::int32_t sub) {
  return static_cast<float>(sub) / contract::kSub;
}

// `make` turns random numbers and a size of 1 to 100 into a value; `simpler` lists simpler values to try
// instead.
template <typename Value, typename Make, typename Simpler>
rc::Gen<Value> generator(Make make, Simpler simpler) {
  return [=](rc::Random source, int size) {
    Random random(source.next());
    return rc::shrinkable::shrinkRecur(make(random, size), simpler);
  };
}

}  // namespace edgewise::testing
