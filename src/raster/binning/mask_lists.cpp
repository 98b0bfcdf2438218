#include "raster/binning/mask_lists.h"

#include <bit>

namespace edgewise {

void MaskLists::reset(std::size_t cells, std::size_t masks) {
  lists_.assign(cells, {});
  used_ = 0;
  // Lists of about this many blocks: the unused part of the last block stays small.
  constexpr std::size_t kBlocksPerList = 4;
  block_bytes_ = std::bit_ceil(
      std::clamp(masks * sizeof(CoverageMask) / cells / kBlocksPerList, kSmallestBlock, kLargestBlock));
  // Few large slabs, because they get huge pages; but none much larger than all masks.
  first_slab_ = std::bit_ceil(std::max<std::size_t>(1, masks * sizeof(CoverageMask) / kLargestBlock));
}

CoverageMask* MaskLists::add_block(List& list) {
  const std::size_t page = used_ / kLargestBlock;
  const auto slab = static_cast<std::size_t>(std::bit_width(page / first_slab_ + 1)) - 1;
  const std::size_t pages_before = first_slab_ * ((std::size_t{1} << slab) - 1);
  slabs_[slab].reserve(first_slab_ << slab);
  auto* const block =
      reinterpret_cast<Header*>(slabs_[slab].data()[page - pages_before].bytes + used_ % kLargestBlock);
  used_ += block_bytes_;
  block->next = nullptr;
  (list.first == nullptr ? list.first : block_of(list.end)->next) = block;
  return reinterpret_cast<CoverageMask*>(block + 1);
}

}  // namespace edgewise
