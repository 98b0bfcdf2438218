// Memory that backends go through tile by tile, that is, all over it: large pieces ask for huge pages.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <new>

namespace edgewise {

inline constexpr std::size_t kHugePage = std::size_t{1} << 21;

// What memory of so many bytes should begin at: a huge page if it fills some, else a cache line, or `least`.
inline std::align_val_t alignment_for(std::size_t bytes, std::size_t least = 1) {
  constexpr std::size_t kCacheLine = 64;
  return std::align_val_t{bytes >= 2 * kHugePage ? kHugePage : std::max(kCacheLine, least)};
}

// Throws std::bad_alloc for lack of memory. To be freed by ::operator delete with the same alignment.
inline void* allocate_aligned(std::size_t bytes, std::align_val_t alignment) {
  if (alignment != std::align_val_t{kHugePage}) return ::operator new(bytes, alignment);
  // The last page is to be a whole one, too: what of it is not touched costs no memory where advice is not
  // taken, and else less than a page.
  const std::size_t whole = (bytes + kHugePage - 1) / kHugePage * kHugePage;
  void* memory = ::operator new(whole, alignment);
#ifdef MADV_HUGEPAGE
  madvise(memory, whole, MADV_HUGEPAGE);
#endif
  return memory;
}

}  // namespace edgewise
