// Whether two planes in memory share an element.
#pragma once

#include <cstddef>
#include <cstdint>

namespace edgewise {

// Rows of elements of four bytes. `stride`, in elements from row to row, is at least `width`.
struct Rows {
  const void* first;
  std::ptrdiff_t width, height, stride;

  std::uintptr_t address() const { return reinterpret_cast<std::uintptr_t>(first); }
  std::uintptr_t end() const {
    return address() + 4 * static_cast<std::uintptr_t>((height - 1) * stride + width);
  }
};

// Of a frame's depth or payload.
template <typename View>
Rows rows_of(const View& frame, const std::uint32_t* plane) {
  return {plane, frame.width, frame.height, frame.stride};
}

// Rows may lie between those of the other plane, as of two pictures side by side, if strides are equal. If
// not, any shared address counts.
inline bool overlap(const Rows& a, const Rows& b) {
  if (a.first == nullptr || b.first == nullptr || a.end() <= b.address() || b.end() <= a.address())
    return false;
  if (a.stride != b.stride) return true;
  const auto step = 4 * a.stride;
  auto gap =
      static_cast<std::ptrdiff_t>(b.address() - a.address()) % step;  // from a row of a's to one of b's
  if (gap < 0) gap += step;
  return gap < 4 * a.width || step - gap < 4 * b.width;
}

}  // namespace edgewise
