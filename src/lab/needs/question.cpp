#include "lab/needs/question.h"

#include <algorithm>
#include <stdexcept>

#include "edgewise/backend.h"
#include "edgewise/framebuffer.h"
#include "lab/truth.h"

namespace edgewise::lab {

const Answer* Question::cheapest() const {
  const auto found = std::find_if(answers.begin(), answers.end(), [](const Answer& a) { return a.enough(); });
  return found == answers.end() ? nullptr : &*found;
}

const Answer& Question::of(std::string_view wanted) const {
  const auto found =
      std::find_if(answers.begin(), answers.end(), [&](const Answer& a) { return a.name == wanted; });
  if (found == answers.end()) throw std::out_of_range("no such answer");
  return *found;
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

std::vector<std::uint32_t> picture_of_ids(std::span<const ScreenTriangle> triangles, Size size) {
  Framebuffer frame(size.width, size.height);
  find_backend("tiled").make()->draw(triangles, frame.view(), kNoTriangle, {});
  std::vector<std::uint32_t> ids;
  ids.reserve(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  for (int y = 0; y < size.height; ++y) {
    const std::uint32_t* row = frame.view().payload + y * frame.stride();
    ids.insert(ids.end(), row, row + size.width);
  }
  return ids;
}

}  // namespace edgewise::lab
