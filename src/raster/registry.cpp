// The list of backends. A new one is a file that defines make_NAME() and idea_NAME: in backends/, with a line
// here; or anywhere, named to CMake by EDGEWISE_BACKENDS.
#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "edgewise/backend.h"
#include "nearest_name.h"

#ifndef EDGEWISE_MORE_BACKENDS
#define EDGEWISE_MORE_BACKENDS(X)
#endif

#define EDGEWISE_BACKENDS(X) \
  X(scanline)                \
  X(naive)                   \
  X(tiled)                   \
  EDGEWISE_MORE_BACKENDS(X)

namespace edgewise {

#define EDGEWISE_DECLARE(name)               \
  extern const std::string_view idea_##name; \
  std::unique_ptr<Backend> make_##name();
EDGEWISE_BACKENDS(EDGEWISE_DECLARE)

std::span<const BackendInfo> backends() {
#define EDGEWISE_ENTRY(name) BackendInfo{#name, idea_##name, make_##name},
  static const std::array list{EDGEWISE_BACKENDS(EDGEWISE_ENTRY)};
  return list;
}

const BackendInfo& find_backend(std::string_view name) {
  const auto all = backends();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& b) { return b.name == name; });
  if (found != all.end()) return *found;
  std::vector<std::string_view> names;
  for (const auto& b : all) names.push_back(b.name);
  throw std::invalid_argument(unknown_name("backend", name, names));
}

}  // namespace edgewise
