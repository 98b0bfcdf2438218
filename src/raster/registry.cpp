// The list of backends. A backend is a file that defines make_NAME() and summary_NAME. Put it in src/raster
// and add a line below, or pass it to CMake in EDGEWISE_BACKENDS.
#include <array>

#include "core/nearest_name.h"
#include "edgewise/backend.h"

#ifndef EDGEWISE_MORE_BACKENDS
#define EDGEWISE_MORE_BACKENDS(X)
#endif

#define EDGEWISE_BACKENDS(X) \
  X(scanline)                \
  X(naive)                   \
  X(tiled)                   \
  EDGEWISE_MORE_BACKENDS(X)

namespace edgewise {

#define EDGEWISE_DECLARE(name)                  \
  extern const std::string_view summary_##name; \
  std::unique_ptr<Backend> make_##name();
EDGEWISE_BACKENDS(EDGEWISE_DECLARE)
EDGEWISE_DECLARE(wireframe)

std::span<const BackendInfo> backends() {
#define EDGEWISE_ENTRY(name) BackendInfo{#name, summary_##name, make_##name},
  static const std::array list{EDGEWISE_BACKENDS(EDGEWISE_ENTRY)};
  return list;
}

const BackendInfo& find_backend(std::string_view name) {
  return find_named("backend", name, backends(), &BackendInfo::name);
}

const BackendInfo& wireframe() {
  static const BackendInfo info{"wireframe", summary_wireframe, make_wireframe};
  return info;
}

// Initialized when the library is loaded: a child forked during a later initialization would wait for its
// lock.
[[maybe_unused]] static const auto kMade = (wireframe(), backends());

}  // namespace edgewise
