// A question about one stage of a rasterizer, with its possible answers and what speaks against each.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "edgewise/scene.h"
#include "lab/method.h"

namespace edgewise::lab {

// One frame of the sequence that is studied. `options` have ids as payloads.
struct StudiedFrame {
  std::uint64_t index;
  const Drawable& drawable;
  FrontendOptions options;
};

// A pixel at which an answer shows an error.
struct Witness {
  std::uint64_t frame;
  int x_px, y_px;
  std::vector<std::uint32_t> right, drawn;  // ids of triangles; none: background
};

struct Answer {
  std::string name;
  std::optional<Witness> witness = {};  // the first; none: the answer is enough
  std::uint64_t wrong_px = 0;           // in the frame of the witness

  bool enough() const { return !witness; }
};

struct Question {
  std::string name;
  std::vector<Answer> answers;  // from the least precise on
  // Why the needed answer is enough. Empty `proof`: it was seen to be, in so many trials of all frames.
  std::string proof = {};
  std::uint64_t trials = 0;
  std::string trial = {};             // "pixel"
  std::string error = "wrong pixel";  // what Answer::wrong_px counts

  // The first answer from which all are enough; null if the last one is not.
  const Answer* needed() const;
  // The most precise answer that is less than needed; null if there is none.
  const Answer* next_weaker() const;
};

// "1 bit", "8 subpixel bits".
std::string bits_name(int bits, std::string_view kind = {});

}  // namespace edgewise::lab
