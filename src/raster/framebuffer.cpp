#include "edgewise/framebuffer.h"

#include <stdexcept>
#include <string>

#include "core/buffer.h"
#include "edgewise/contract.h"

namespace edgewise {

namespace {
constexpr int kPixelsPerLine = 16;  // 64 bytes of 32-bit pixels

int checked_side(int side) {
  if (side < 1 || side > contract::kMaxImageSide)
    throw std::invalid_argument("image side " + std::to_string(side) + " is outside 1 to " +
                                std::to_string(contract::kMaxImageSide));
  return side;
}

// Whole cache lines. Not a multiple of a page: then the rows of a tile would compete for the same cache sets.
std::ptrdiff_t stride_for(int width) {
  constexpr int kPixelsPerPage = 1024;
  const int whole_lines = (width + kPixelsPerLine - 1) / kPixelsPerLine * kPixelsPerLine;
  return whole_lines % kPixelsPerPage == 0 ? whole_lines + kPixelsPerLine : whole_lines;
}
}  // namespace

Framebuffer::Framebuffer(int width, int height)
    : width_(checked_side(width)),
      height_(checked_side(height)),
      stride_(stride_for(width)),
      depth_(allocate()),
      payload_(allocate()) {}

Framebuffer::Plane Framebuffer::allocate() const {
  const auto pixels = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height_);
  const std::size_t bytes = pixels * sizeof(std::uint32_t);
  const std::align_val_t alignment = alignment_for(bytes);
  return Plane(static_cast<std::uint32_t*>(allocate_aligned(bytes, alignment)), Release{alignment});
}

}  // namespace edgewise
