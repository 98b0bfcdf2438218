// The size of the machine's last cache, which decides where a frame is best written to.
#pragma once

#include <cstddef>

namespace edgewise {

std::size_t last_cache_bytes();

}  // namespace edgewise
