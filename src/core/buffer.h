// Uninitialised memory for many records. Pages without a record are never touched, so a capacity for the
// worst case costs only address space.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "core/pages.h"

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

  // Capacity for at least `count` records. Growing discards the contents.
  void reserve(std::size_t count) {
    if (count <= capacity_) return;
    data_.reset();  // first, so that both are never held at once
    capacity_ = 0;
    const std::size_t bytes = count * sizeof(T);
    const std::align_val_t alignment = alignment_for(bytes, alignof(T));
    data_ = {static_cast<T*>(allocate_aligned(bytes, alignment)), Free{alignment}};
    capacity_ = count;
  }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  std::size_t capacity() const { return capacity_; }

 private:
  struct Free {
    std::align_val_t alignment{};
    void operator()(T* data) const { ::operator delete(data, alignment); }
  };

  std::unique_ptr<T, Free> data_;
  std::size_t capacity_ = 0;
};

}  // namespace edgewise
