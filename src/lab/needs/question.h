// A question about one stage of a rasterizer, with its possible answers and what speaks against each.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "edgewise/framebuffer.h"
#include "edgewise/scene.h"
#include "lab/error_marks.h"
#include "lab/method.h"

namespace edgewise::lab {

// One frame of the sequence that is studied. `options` have ids as payloads.
struct StudiedFrame {
  std::uint64_t index;
  const Drawable& drawable;
  FrontendOptions options;
  bool keep_pictures;  // whether answers that are not enough keep a MarkedPicture

  Size size() const { return {options.width, options.height}; }
  std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(options.width) * static_cast<std::uint64_t>(options.height);
  }
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
  MarkedPicture picture = {};           // of that frame; empty unless asked for

  bool enough() const { return !witness; }
};

struct Question {
  std::string name;
  std::vector<Answer> answers;  // from the cheapest on
  // Why the cheapest answer is enough. Empty `proof`: it was seen to be, in so many trials of all frames.
  std::string proof = {};
  std::uint64_t trials = 0;
  std::string trial = {};             // "pixel"
  std::string error = "wrong pixel";  // what Answer::wrong_px counts

  const Answer* cheapest() const;  // null: none is enough
};

// "1 bit", "8 subpixel bits".
std::string bits_name(int bits, std::string_view kind = {});

// Adds a witness to `answer` if the pictures of ids, row by row, differ. The answer must have none.
void compare_pictures(std::span<const std::uint32_t> right, std::span<const std::uint32_t> drawn,
                      const StudiedFrame& frame, Answer& answer);

// A frame's payloads, row by row without padding.
std::vector<std::uint32_t> payloads_of(const Framebuffer& frame);
// The exact picture of ids that `tiled` draws, or kNoTriangle.
std::vector<std::uint32_t> picture_of_ids(std::span<const ScreenTriangle> triangles, Size size);

}  // namespace edgewise::lab
