#pragma once

#include <stdexcept>
#include <string>

#include "edgewise/execution.h"

namespace edgewise {

inline constexpr int kLeastTileSize = 16;  // px

// `execution` with a resolved target. Throws std::invalid_argument.
inline Execution checked(const Execution& execution) {
  const auto [threads, tile_size, target] = execution;
  if (threads < 1 || threads > kMaxThreads)
    throw std::invalid_argument(std::to_string(threads) + " threads are outside 1 to " +
                                std::to_string(kMaxThreads));
  if (tile_size != kLeastTileSize && tile_size != 32 && tile_size != 64)
    throw std::invalid_argument("tile size " + std::to_string(tile_size) + " is not 16, 32 or 64");
  return {threads, tile_size, resolve(target)};
}

}  // namespace edgewise
