#include "core/llc.h"

#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#endif

namespace edgewise {

namespace {

// sysconf() is no alternative: glibc 2.36 adds up all last-level caches of an AMD socket.
std::size_t detect_llc_bytes() {
  constexpr std::size_t kFallback = std::size_t{8} << 20;
#if defined(__x86_64__) || defined(__i386__)
  // Intel reports cache parameters at the first leaf, AMD in the same form at the second (CPUID in Intel SDM
  // volume 2 and AMD APM volume 3). The last entry is the last level.
  constexpr unsigned kLeaves[] = {4, 0x8000001D};
  for (const unsigned leaf : kLeaves) {
    std::size_t last = 0;
    unsigned a, b, c, d;
    for (unsigned i = 0; __get_cpuid_count(leaf, i, &a, &b, &c, &d) && (a & 31) != 0; ++i) {
      const std::size_t ways = (b >> 22) + 1, partitions = ((b >> 12) & 1023) + 1, line = (b & 4095) + 1;
      last = ways * partitions * line * (std::size_t{c} + 1);
    }
    if (last != 0) return last;
  }
#endif
  return kFallback;
}

}  // namespace

std::size_t llc_bytes() {
  static const std::size_t bytes = detect_llc_bytes();
  return bytes;
}

}  // namespace edgewise
