// The list of backends. A new one is a file that defines make_NAME() and idea_NAME: in backends/, with a line
// in one of the two lists here, of those that fill triangles by the contract and of those that draw another
// picture of them; or anywhere, named to CMake by EDGEWISE_BACKENDS, if it fills.
#include <algorithm>
#include <array>

#include "core/nearest_name.h"
#include "edgewise/backend.h"

#ifndef EDGEWISE_MORE_BACKENDS
#define EDGEWISE_MORE_BACKENDS(X)
#endif

#define EDGEWISE_FILLING_BACKENDS(X) \
  X(scanline)                        \
  X(naive)                           \
  X(tiled)                           \
  EDGEWISE_MORE_BACKENDS(X)

#define EDGEWISE_OTHER_BACKENDS(X) X(wireframe)

namespace edgewise {

#define EDGEWISE_DECLARE(name)               \
  extern const std::string_view idea_##name; \
  std::unique_ptr<Backend> make_##name();
EDGEWISE_FILLING_BACKENDS(EDGEWISE_DECLARE)
EDGEWISE_OTHER_BACKENDS(EDGEWISE_DECLARE)

std::span<const BackendInfo> backends() {
#define EDGEWISE_FILLING(name) BackendInfo{#name, idea_##name, make_##name, true},
#define EDGEWISE_OTHER(name) BackendInfo{#name, idea_##name, make_##name, false},
  static const std::array list{EDGEWISE_FILLING_BACKENDS(EDGEWISE_FILLING)
                                   EDGEWISE_OTHER_BACKENDS(EDGEWISE_OTHER)};
  return list;
}

std::span<const BackendInfo> filling_backends() {
  const auto all = backends();
  const auto filling = std::count_if(all.begin(), all.end(), [](const auto& b) { return b.fills; });
  return all.first(static_cast<std::size_t>(filling));
}

const BackendInfo& find_backend(std::string_view name) {
  return find_named("backend", name, backends(), &BackendInfo::name);
}

}  // namespace edgewise
