// Memory for many records. Unlike a vector it never initialises: pages that no record is written to are never
// touched, so room for the worst case costs nothing but address space. Large buffers ask for huge pages,
// since a backend goes through records in the order of tiles: all over the buffer.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace edgewise {

template <typename T>
class Buffer {
 public:
  static_assert(std::is_trivially_default_constructible_v<T> && std::is_trivially_destructible_v<T>);

  Buffer() = default;
  Buffer(Buffer&& other) noexcept
      : data_(std::move(other.data_)), capacity_(std::exchange(other.capacity_, 0)) {}
  Buffer& operator=(Buffer&& other) noexcept {
    data_ = std::move(other.data_);
    capacity_ = std::exchange(other.capacity_, 0);
    return *this;
  }

  // Room for `count`; what was in it is lost when it grows.
  void reserve(std::size_t count) {
    if (count <= capacity_) return;
    data_.reset();  // first, so that both are never held at once
    capacity_ = 0;
    const std::size_t bytes = count * sizeof(T);
    const bool large = bytes >= 2 * kHugePage;
    const std::align_val_t alignment{large ? kHugePage : kLeastAlignment};
    data_ = {static_cast<T*>(::operator new(bytes, alignment)), Free{alignment}};
#ifdef MADV_HUGEPAGE
    // Advice: where it is not taken, all is as before, and slower.
    if (large) madvise(data_.get(), bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
    capacity_ = count;
  }
  T* data() {
    return data_.get();
  }
  const T* data() const {
    return data_.get();
  }
  std::size_t capacity() const {
    return capacity_;
  }

 private:
  static constexpr std::size_t kLeastAlignment = alignof(T) > 64 ? alignof(T) : 64;  // a cache line
  static constexpr std::size_t kHugePage = std::size_t{1} << 21;
  struct Free {
    std::align_val_t alignment{};
    void operator()(T* data) const { ::operator delete(data, alignment); }
  };

  std::unique_ptr<T, Free> data_;
  std::size_t capacity_ = 0;
};

}  // namespace edgewise
