// Memory for the front end's output. Unlike a vector it never initialises: pages that no triangle is written
// to are never touched, so room for the worst case costs nothing but address space.
#pragma once

#include <cstddef>
#include <memory>

namespace edgewise {

template <typename T>
class Buffer {
 public:
  // Room for `count`; what was in it is lost when it grows.
  void reserve(std::size_t count) {
    if (count <= capacity_) return;
    data_.reset();  // first, so that both are never held at once
    capacity_ = 0;
    data_ = std::make_unique_for_overwrite<T[]>(count);
    capacity_ = count;
  }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  std::size_t capacity() const { return capacity_; }

 private:
  std::unique_ptr<T[]> data_;
  std::size_t capacity_ = 0;
};

}  // namespace edgewise
