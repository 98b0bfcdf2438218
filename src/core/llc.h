// The size of the last-level cache (LLC) as reported by the processor, or 8 MB if it reports none. Other
// processes may share the cache.
#pragma once

#include <cstddef>

namespace edgewise {

std::size_t llc_bytes();

}  // namespace edgewise
