// Whether tiles go to the frame through the caches or past them (WriteOut::automatic).
//
// A frame that stays in the last cache from one draw to the next is written faster there; of one that does
// not, each line is read before it is overwritten. What stays is not to be known beforehand: whoever else
// runs on the processor shares that cache, and virtual machines don't tell with how many. So where a frame
// ought to stay, one is now and then written through the caches several times in a row, but for a few tiles,
// which go past them; and until the next look all do, if those took clearly less time. Not the other way
// round: a few tiles written through the caches always find room there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "edgewise/ablation.h"

namespace edgewise {

class WriteOutChoice {
 public:
  // `cache_bytes`: of the last cache.
  explicit WriteOutChoice(std::size_t cache_bytes) : cache_bytes_(cache_bytes) {}

  struct Frame {
    std::size_t bytes, triangle_bytes;
    int tiles, threads;
  };
  struct ForTile {
    WriteOut way;                        // through_caches or past_caches
    std::int64_t* elapsed_ns = nullptr;  // where the time that it takes is wanted, if it is
  };

  // Before a frame's tiles.
  void begin_frame(const Frame& frame);
  // Each tile is asked for once; any thread may ask.
  ForTile for_tile(int tile, bool empty);
  // After them. Learns from the times.
  void end_frame();

 private:
  struct Likeness {
    std::size_t frame_bytes;
    int tiles, triangle_bytes_log2, threads;
    bool all_fit;
    bool operator==(const Likeness&) const = default;
  };
  // What was found out of frames that are alike.
  struct Kind {
    Likeness like{};
    int frame = 0;                  // since the last look began
    int votes = 0, votes_past = 0;  // in this look, of its frames
    bool past = false;
  };
  struct Pair {
    std::int64_t through_ns = 0, past_ns = 0;  // 0: not known
    bool through_empty = false, past_empty = false;
  };
  static constexpr std::size_t kKinds = 64, kPairs = 64;
  void bring_kind_to_front(const Frame& frame);

  std::size_t cache_bytes_;
  bool frame_fits_ = false, all_fit_ = false, in_doubt_ = false, looks_ = false;
  std::array<Kind, kKinds> kinds_{};  // the one drawn last comes first
  std::array<Pair, kPairs> pairs_{};
};

}  // namespace edgewise
