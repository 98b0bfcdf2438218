// Reduces a failing list to a nearly minimal one: delta debugging (Zeller and Hildebrandt, "Simplifying and
// isolating failure-inducing input", 2002) that tests complements only, not the subsets themselves.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace edgewise::soak {

// Removes parts while fails(list) holds without them: first halves of the list, at last single elements. The
// order is kept. `list` itself must fail. Makes at most `most_attempts` calls, and none once stop() is true.
template <typename T, typename Fails, typename Stop>
std::vector<T> reduce(std::vector<T> list, int most_attempts, const Fails& fails, const Stop& stop) {
  for (std::size_t part = (list.size() + 1) / 2; part > 0; part = part == 1 ? 0 : (part + 1) / 2)
    for (std::size_t begin = 0; begin < list.size() && list.size() > 1;) {
      if (most_attempts-- <= 0 || stop()) return list;
      const std::size_t end = std::min(begin + part, list.size());
      std::vector<T> rest(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(begin));
      rest.insert(rest.end(), list.begin() + static_cast<std::ptrdiff_t>(end), list.end());
      if (fails(rest))
        list = std::move(rest);
      else
        begin = end;
    }
  return list;
}

}  // namespace edgewise::soak
