// The size of the last-level cache (LLC) as reported by the processor, or 8 MB if it reports none. Other
// processes may share the cache.
#pragma once

#include <cstddef>

namespace edgewise {

std::size_t llc_bytes();

// The L2 size that is assumed for every processor: most have 0.5 to 2 MB per core.
inline constexpr std::size_t kL2Bytes = std::size_t{1} << 20;

}  // namespace edgewise
