#include "raster/patch_lists.h"

#include <bit>

namespace edgewise {

void PatchLists::reset(std::size_t cells, std::size_t patches) {
  lists_.assign(cells, {});
  used_ = 0;
  // What a list leaves empty of its last block should be little beside the rest.
  constexpr std::size_t kBlocks = 8;
  block_bytes_ =
      std::bit_ceil(std::clamp(patches * sizeof(Patch) / cells / kBlocks, kSmallestBlock, kLargestBlock));
}

Patch* PatchLists::add_block(List& list) {
  const std::size_t piece = used_ / kLargestBlock;
  const auto slab = static_cast<std::size_t>(std::bit_width(piece / kFirstSlab + 1)) - 1;
  const std::size_t pieces_before = kFirstSlab * ((std::size_t{1} << slab) - 1);
  slabs_[slab].reserve(kFirstSlab << slab);
  auto* const block =
      reinterpret_cast<Header*>(slabs_[slab].data()[piece - pieces_before].bytes + used_ % kLargestBlock);
  used_ += block_bytes_;
  block->next = nullptr;
  (list.first == nullptr ? list.first : block_of(list.end)->next) = block;
  return reinterpret_cast<Patch*>(block + 1);
}

}  // namespace edgewise
