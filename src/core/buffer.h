// Memory with huge pages, and buffers of it.
#pragma once

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>

namespace edgewise {

// Memory that is accessed tile by tile, not in order: large allocations request huge pages.
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

// Uninitialised memory for many records. Pages without a record are never touched, so a capacity for the
// worst case costs only address space.
template <typename T>
class Buffer {
 public:
  static_assert(std::is_trivially_default_constructible_v<T> && std::is_trivially_destructible_v<T>);

  // Capacity for at least `count` records. Growing discards the contents.
  void reserve(std::size_t count) {
    if (count <= capacity()) return;
    if (count > PTRDIFF_MAX / sizeof(T)) throw std::bad_alloc();
    data_.reset();  // first, so that both are never held at once
    const std::size_t bytes = count * sizeof(T);
    const std::align_val_t alignment = alignment_for(bytes, alignof(T));
    data_ = {static_cast<T*>(allocate_aligned(bytes, alignment)), Free{alignment, count}};
  }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  std::size_t capacity() const { return data_ ? data_.get_deleter().capacity : 0; }

 private:
  struct Free {
    std::align_val_t alignment{};
    std::size_t capacity = 0;
    void operator()(T* data) const { ::operator delete(data, alignment); }
  };

  std::unique_ptr<T, Free> data_;
};

}  // namespace edgewise
