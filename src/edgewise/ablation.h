// Ideas of the tiled backend that can be switched off, to see what each is worth.
#pragma once

#include "edgewise/cxx20.h"

#include <array>
#include <string>

namespace edgewise {

// How tiles go to the frame, where the target has vectors. Stores past the caches (non-temporal) save reading
// what they overwrite, and leave the caches to the triangles; but a frame that stays in the last cache from
// one draw to the next is written, and read by whoever shows it, faster there.
enum class WriteOut {
  through_caches,
  past_caches,
  // Past the caches where frame and triangles don't fit half of the last one (tiles without a triangle: where
  // the frame alone does not), and where one that would fit, and takes more than an eighth of it, is found to
  // be written faster so: each backend object tries it now and then.
  automatic
};

struct Ablation {
  bool vector_setup = true;        // boxes and triangles a vector at a time, where the target has vectors
  bool prefetch = true;            // records are asked for before they are needed; lists always are
  bool patches = true;             // small triangles are resolved where they are binned; needs vector_setup
  bool hierarchical_depth = true;  // what lies behind all that a block, or the tile, shows is dropped
  WriteOut write_out = WriteOut::automatic;
};

// What differs from the default, as "no prefetch, …"; empty where nothing does.
std::string describe(const Ablation& ideas);

// Each idea left out, the write-out both ways, and all left out: what a test must compare.
constexpr std::array<Ablation, 7> kAblations{{{.vector_setup = false},
                                              {.prefetch = false},
                                              {.patches = false},
                                              {.hierarchical_depth = false},
                                              {.write_out = WriteOut::through_caches},
                                              {.write_out = WriteOut::past_caches},
                                              {false, false, false, false, WriteOut::through_caches}}};

}  // namespace edgewise
