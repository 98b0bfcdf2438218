// Memory that is accessed tile by tile, not in order: large allocations request huge pages.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <new>

namespace edgewise {

inline constexpr std::size_t kHugePage = std::size_t{1} << 21;

// The alignment for an allocation of `bytes`: a huge page from two huge pages on, else a cache line or
// `least`, whichever is larger.
inline std::align_val_t alignment_for(std::size_t bytes, std::size_t least = 1) {
  constexpr std::size_t kCacheLine = 64;
  return std::align_val_t{bytes >= 2 * kHugePage ? kHugePage : std::max(kCacheLine, least)};
}

// Throws std::bad_alloc if memory is exhausted. Free with ::operator delete with the same alignment.
inline void* allocate_aligned(std::size_t bytes, std::align_val_t alignment) {
  if (alignment != std::align_val_t{kHugePage}) return ::operator new(bytes, alignment);
  // Rounded up to whole huge pages. The unused end costs less than a page, and no memory without huge pages.
  const std::size_t whole = (bytes + kHugePage - 1) / kHugePage * kHugePage;
  void* memory = ::operator new(whole, alignment);
#ifdef MADV_HUGEPAGE
  madvise(memory, whole, MADV_HUGEPAGE);
#endif
  return memory;
}

}  // namespace edgewise
