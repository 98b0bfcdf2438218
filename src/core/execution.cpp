#include "core/execution.h"

#include <stdexcept>
#include <string>

namespace edgewise {

Execution checked(const Execution& execution) {
  if (execution.threads < 1 || execution.threads > kMaxThreads)
    throw std::invalid_argument(std::to_string(execution.threads) + " threads are outside 1 to " +
                                std::to_string(kMaxThreads));
  if (execution.tile_size != 16 && execution.tile_size != 32 && execution.tile_size != 64)
    throw std::invalid_argument("tile size " + std::to_string(execution.tile_size) + " is not 16, 32 or 64");
  return {execution.threads, execution.tile_size, resolve(execution.target)};
}

}  // namespace edgewise
