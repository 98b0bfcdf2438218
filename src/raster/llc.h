// The size of the last-level cache (LLC) as Linux reports it, or 48 MB where it reports none. Other processes
// may share the cache, and a virtual machine may report more than its share.
#pragma once

#include <cstddef>
#include <string>

namespace edgewise {

std::size_t llc_bytes();

// Of the caches in a folder such as /sys/devices/system/cpu/cpu0/cache: index0 … index9, each with a file
// `size` like "512K". The largest is the last level. 0 if the folder names no size.
std::size_t largest_cache_bytes(const std::string& folder);

}  // namespace edgewise
