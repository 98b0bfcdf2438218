// Words are split into bytes by shifts, so the byte order of the machine does not matter. On a little-endian
// one, compilers make a copy of it.
#include "edgewise/hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstddef>
#include <vector>

namespace edgewise {

namespace {

class Hasher {
 public:
  Hasher() { XXH3_64bits_reset(&state_); }

  template <typename Word>
  void add(std::span<const Word> words) {
    bytes_.resize(words.size() * sizeof(Word));
    auto byte = bytes_.begin();
    for (const Word word : words)
      for (std::size_t i = 0; i < sizeof(Word); ++i) *byte++ = static_cast<unsigned char>(word >> 8 * i);
    XXH3_64bits_update(&state_, bytes_.data(), bytes_.size());
  }
  std::uint64_t digest() const { return XXH3_64bits_digest(&state_); }

 private:
  XXH3_state_t state_;
  std::vector<unsigned char> bytes_;
};

}  // namespace

std::uint64_t hash_of(const ConstFrameView& frame) {
  const std::uint32_t size[] = {static_cast<std::uint32_t>(frame.width),
                                static_cast<std::uint32_t>(frame.height)};
  Hasher hasher;
  hasher.add(std::span<const std::uint32_t>(size));
  for (int y = 0; y < frame.height; ++y)
    for (const std::uint32_t* const plane : {frame.depth, frame.payload})
      if (plane != nullptr) hasher.add(std::span(plane + y * frame.stride, size[0]));
  return hasher.digest();
}

std::uint64_t hash_of_all(std::span<const std::uint64_t> hashes) {
  Hasher hasher;
  hasher.add(hashes);
  return hasher.digest();
}

}  // namespace edgewise
