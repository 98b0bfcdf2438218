#include "raster/binning/slice_ranges.h"

#include <algorithm>

namespace edgewise {

namespace {

struct Pieces {
  std::size_t begin, end;
  explicit Pieces(std::uint64_t bits) : begin(bits & 0xFFFFFFFF), end(bits >> 32) {}
  Pieces(std::size_t b, std::size_t e) : begin(b), end(e) {}
  std::uint64_t bits() const { return std::uint64_t{begin} | std::uint64_t{end} << 32; }
  std::size_t count() const { return end - begin; }
};

}  // namespace

void SliceRanges::use(std::size_t slice, std::size_t begin, std::size_t end) {
  slices_[slice].begin = begin, slices_[slice].used = true;
  slices_[slice].left.store(Pieces(begin, end).bits(), std::memory_order_relaxed);
}

void SliceRanges::start(std::size_t count, const Slicing& slicing) {
  const std::size_t first = slicing.first, most = slicing.most, at_once = slicing.at_once;
  if (slices_.size() < most) slices_ = std::vector<Slice>(most);
  count_ = count, slicing_ = slicing, next_ = first;
  const std::size_t pieces = (count + at_once - 1) / at_once;
  for (Slice& slice : slices_) slice.left = 0, slice.used = false;
  for (std::size_t i = 0; i < first; ++i) use(i, pieces * i / first, pieces * (i + 1) / first);
}

std::optional<SliceRanges::Inputs> SliceRanges::next(std::size_t slice) {
  std::atomic<std::uint64_t>& left = slices_[slice].left;
  for (std::uint64_t bits = left.load(std::memory_order_relaxed);;) {
    const Pieces pieces(bits);
    if (pieces.count() == 0) return std::nullopt;
    if (left.compare_exchange_weak(bits, Pieces(pieces.begin + 1, pieces.end).bits(),
                                   std::memory_order_relaxed))
      return Inputs{pieces.begin * slicing_.at_once, std::min(count_, (pieces.begin + 1) * slicing_.at_once)};
  }
}

std::optional<std::size_t> SliceRanges::split() {
  const std::size_t slice = std::atomic_ref(next_).fetch_add(1, std::memory_order_relaxed);
  while (slice < slicing_.most) {  // stays unused if there is nothing to take
    std::size_t longest = 0;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < slicing_.most; ++i) {
      const std::uint64_t left = slices_[i].left.load(std::memory_order_relaxed);
      if (Pieces(left).count() > Pieces(bits).count()) longest = i, bits = left;
    }
    const Pieces rest(bits);
    if (rest.count() < 2 || rest.count() * slicing_.at_once < slicing_.least_rest) break;
    const std::size_t middle = rest.end - rest.count() / 2;
    if (slices_[longest].left.compare_exchange_strong(bits, Pieces(rest.begin, middle).bits(),
                                                      std::memory_order_relaxed)) {
      use(slice, middle, rest.end);
      return slice;
    }
  }
  return std::nullopt;
}

std::span<const std::size_t> SliceRanges::in_order() {
  order_.clear();
  order_.reserve(slices_.size());
  for (std::size_t i = 0; i < slices_.size(); ++i)
    if (slices_[i].used) order_.push_back(i);
  std::ranges::sort(order_, {}, [&](std::size_t i) { return slices_[i].begin; });
  return order_;
}

}  // namespace edgewise
