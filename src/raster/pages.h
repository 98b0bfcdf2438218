// Memory for what backends go through tile by tile, that is, all over it: large pieces ask for huge pages.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <new>

namespace edgewise {

inline constexpr std::align_val_t kHugePage{std::size_t{1} << 21};

// Where memory of so many bytes should begin: at a huge page if it fills some, else at a cache line, or at a
// multiple of `least` bytes.
inline std::align_val_t page_alignment(std::size_t bytes, std::size_t least = 1) {
  constexpr std::size_t kCacheLine = 64;
  const bool large = bytes >= 2 * static_cast<std::size_t>(kHugePage);
  return large ? kHugePage : std::align_val_t{std::max(kCacheLine, least)};
}

// Throws std::bad_alloc for lack of memory. To be freed by ::operator delete with the same alignment.
inline void* allocate_pages(std::size_t bytes, std::align_val_t alignment) {
  void* memory = ::operator new(bytes, alignment);
#ifdef MADV_HUGEPAGE
  // Advice: where it is not taken, all is as before, and slower.
  constexpr auto kSize = static_cast<std::size_t>(kHugePage);
  if (alignment == kHugePage) madvise(memory, bytes / kSize * kSize, MADV_HUGEPAGE);
#endif
  return memory;
}

}  // namespace edgewise
