#include "lab/needs/question.h"

#include <algorithm>

#include "edgewise/backend.h"
#include "lab/truth.h"

namespace edgewise::lab {

const Answer* Question::cheapest() const {
  const auto found = std::find_if(answers.begin(), answers.end(), [](const Answer& a) { return a.enough(); });
  return found == answers.end() ? nullptr : &*found;
}

std::string bits_name(int bits, std::string_view kind) {
  return std::to_string(bits) + " " + std::string(kind) + (kind.empty() ? "bit" : " bit") +
         (bits == 1 ? "" : "s");
}

void compare_pictures(std::span<const std::uint32_t> right, std::span<const std::uint32_t> drawn,
                      const StudiedFrame& frame, Answer& answer) {
  const auto ids = [](std::uint32_t id) {
    return id == kNoTriangle ? std::vector<std::uint32_t>{} : std::vector{id};
  };
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (right[i] == drawn[i]) continue;
    ++answer.wrong_px;
    if (answer.witness) continue;
    const int x = static_cast<int>(i % static_cast<std::size_t>(frame.options.width)),
              y = static_cast<int>(i / static_cast<std::size_t>(frame.options.width));
    answer.witness = Witness{frame.index, x, y, ids(right[i]), ids(drawn[i])};
  }
  if (answer.witness && frame.keep_pictures)
    answer.picture = mark_visible_triangles(right, drawn, {frame.options.width, frame.options.height});
}

std::vector<std::uint32_t> payloads_of(const Framebuffer& frame) {
  std::vector<std::uint32_t> payloads;
  payloads.reserve(static_cast<std::size_t>(frame.width()) * static_cast<std::size_t>(frame.height()));
  for (int y = 0; y < frame.height(); ++y) {
    const std::uint32_t* row = frame.payload_row(y);
    payloads.insert(payloads.end(), row, row + frame.width());
  }
  return payloads;
}

std::vector<std::uint32_t> picture_of_ids(std::span<const ScreenTriangle> triangles, Size size) {
  Framebuffer frame(size.width, size.height);
  find_backend("tiled").make()->draw(triangles, frame.view(), kNoTriangle, {});
  return payloads_of(frame);
}

}  // namespace edgewise::lab
