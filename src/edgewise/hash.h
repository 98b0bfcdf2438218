// The hash of a picture: one number that is the same on every machine, backend, SIMD target and thread count.
// Any thread may call these functions.
#pragma once

#include "edgewise/cxx20.h"

#include <cstdint>
#include <span>

#include "edgewise/framebuffer.h"

#pragma GCC visibility push(default)
namespace edgewise {

// XXH3-64 (seed 0) of these 32-bit words, of which each is four bytes, the lowest first, on every machine:
//   width, height, then row by row from the top: the depths of the row, from the left, then its payloads,
//   if the frame has any.
// Stride, alignment and memory beside the image do not count.
std::uint64_t hash_of(const ConstFrameView& frame);

// XXH3-64 (seed 0) of the hashes in this order, of which each is eight bytes, the lowest first: one number
// for several pictures.
std::uint64_t hash_of_all(std::span<const std::uint64_t> hashes);

}  // namespace edgewise
#pragma GCC visibility pop
