#include "core/llc.h"

#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#endif

namespace edgewise {

namespace {

// Not from sysconf(): glibc 2.36 takes all last caches of an AMD socket together.
std::size_t find() {
  constexpr std::size_t kUsual = std::size_t{8} << 20;
#if defined(__x86_64__) || defined(__i386__)
  // Cache parameters, in the same form at one leaf or the other (CPUID in Intel SDM volume 2 and AMD APM
  // volume 3). Caches come from the first level up.
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
  return kUsual;
}

}  // namespace

std::size_t llc_bytes() {
  static const std::size_t bytes = find();
  return bytes;
}

}  // namespace edgewise
