// Whether tiles go to the frame through the caches or past them (WriteOut::automatic).
//
// A frame that stays in the last cache from one draw to the next is written faster there; one that does not
// has each line read before it is overwritten. What stays is not to be known beforehand: the last cache is
// shared with whoever else runs on the processor, and virtual machines don't tell with how many. So where a
// frame ought to stay, two tiles of each 64 are now and then written the other way for a few frames in a row,
// as the caches need some to settle, and the second's time is compared with that of a tile written as most
// are. The first is there because a tile written through the caches asks for its right neighbour's place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "edgewise/tiled_ideas.h"

namespace edgewise {

class WriteOutChoice {
 public:
  // `cache_bytes`: of the last cache.
  explicit WriteOutChoice(std::size_t cache_bytes);

  struct ForTile {
    WriteOut way;                        // through_caches or past_caches
    std::int64_t* elapsed_ns = nullptr;  // where the time that it takes is wanted, if it is
  };

  // Before a frame's tiles.
  void begin_frame(std::size_t frame_bytes, std::size_t triangle_bytes, int threads);
  // Each tile is asked for once; any thread may ask.
  ForTile for_tile(int tile, bool empty);
  // After them. Learns from the times.
  void end_frame();

 private:
  static constexpr std::size_t kGroups = 64;  // of tiles that are looked at
  struct Pair {
    std::int64_t usual_ns = 0, other_ns = 0;  // 0: not known
    bool usual_empty = false, other_empty = false;
  };

  std::size_t cache_bytes_;
  std::size_t frame_bytes_ = 0;
  int threads_ = 0;
  int frame_ = 0;  // of those since another kind came, or since it was last begun to look
  bool frame_fits_ = false, all_fit_ = false, in_doubt_ = false, looks_ = false;
  bool rather_past_ = false;  // found out: the frame does not stay, though it ought to
  int frames_against_ = 0;    // how many in a row spoke against the choice
  std::array<Pair, kGroups> pairs_{};
};

}  // namespace edgewise
