#include "cli/accuracy/closeup.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <system_error>
#include <tuple>

namespace edgewise::tools {

namespace {

// The largest part of the picture that a close-up shows, in px. Default: pixels stay large enough to see.
// Fine: for triangles smaller than pixels. Large: nearly all pixels are wrong, so only a large part can be
// recognized.
constexpr lab::Size kDefaultExtent{96, 72}, kFineExtent{24, 18}, kLargeExtent{240, 240};
constexpr int kLargestUncropped = 130;  // px; pictures up to this size are shown whole
constexpr int kPictureSide = 960, kLargestPixel = 64;
constexpr std::uint32_t kBackground = rgb(255, 255, 255), kLineColour = rgb(20, 20, 20),
                        kDot = rgb(120, 120, 120);
// Colours of correct pixels, pale so that marked errors stand out.
constexpr std::uint32_t kPaleColours[] = {rgb(222, 226, 230), rgb(203, 213, 209), rgb(226, 217, 203),
                                          rgb(207, 209, 224), rgb(217, 224, 207), rgb(224, 208, 212)};

// Counts error marks in any rectangle with a summed-area table (Crow, 1984).
class MarkCount {
 public:
  explicit MarkCount(const lab::MarkedPicture& p) : stride_(p.window.width + 1) {
    sums_.assign(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(p.window.height + 1), 0);
    auto mark = p.marks.begin();
    for (int y = 0; y < p.window.height; ++y)
      for (int x = 0; x < p.window.width; ++x)
        at(x + 1, y + 1) = (*mark++ == lab::Mark::none ? 0 : 1) + at(x, y + 1) + at(x + 1, y) - at(x, y);
  }
  int in(int x, int y, int width, int height) {
    return at(x + width, y + height) - at(x, y + height) - at(x + width, y) + at(x, y);
  }

 private:
  int& at(int x, int y) {
    return sums_[static_cast<std::size_t>(y) * static_cast<std::size_t>(stride_) +
                 static_cast<std::size_t>(x)];
  }
  int stride_;
  std::vector<int> sums_;
};

// The part of at most this size with the most marks, centred on their bounding box.
lab::Window most_wrong(const lab::Window& all, MarkCount& count, lab::Size most_px) {
  lab::Window part{std::min(all.width, most_px.width), std::min(all.height, most_px.height)};
  int most = -1;
  for (int y = 0; y + part.height <= all.height; ++y)
    for (int x = 0; x + part.width <= all.width; ++x)
      if (const int marks = count.in(x, y, part.width, part.height); marks > most)
        most = marks, part.x0 = x, part.y0 = y;

  int x0 = part.x1(), x1 = part.x0, y0 = part.y1(), y1 = part.y0;
  for (int y = part.y0; y < part.y1(); ++y)
    for (int x = part.x0; x < part.x1(); ++x)
      if (count.in(x, y, 1, 1) != 0) {
        x0 = std::min(x0, x), x1 = std::max(x1, x + 1);
        y0 = std::min(y0, y), y1 = std::max(y1, y + 1);
      }
  part.x0 = std::clamp((x0 + x1 - part.width) / 2, 0, all.width - part.width);
  part.y0 = std::clamp((y0 + y1 - part.height) / 2, 0, all.height - part.height);
  return part;
}

lab::Window part_of(const lab::MarkedPicture& picture) {
  const lab::Window& all = picture.window;
  MarkCount count(picture);
  if (picture.lines.size() > 2 * picture.marks.size()) return most_wrong(all, count, kFineExtent);
  if (all.width <= kLargestUncropped && all.height <= kLargestUncropped) return all;
  const lab::Window part = most_wrong(all, count, kDefaultExtent);
  const bool nearly_all =
      10 * count.in(part.x0, part.y0, part.width, part.height) > 9 * part.width * part.height;
  return nearly_all ? most_wrong(all, count, kLargeExtent) : part;
}

// Whether a line's bounding box overlaps the part.
bool near(const lab::Line& line, lab::Window part) {
  return std::max(line.x0, line.x1) >= part.x0 && std::min(line.x0, line.x1) <= part.x1() &&
         std::max(line.y0, line.y1) >= part.y0 && std::min(line.y0, line.y1) <= part.y1();
}

class Drawing {
 public:
  explicit Drawing(const Closeup& c)
      : closeup_(c),
        scale_(std::clamp(kPictureSide / std::max(c.part.width, c.part.height), 2, kLargestPixel)) {
    image_.width = c.part.width * scale_ + 1;
    image_.height = c.part.height * scale_ + 1;
    // The grid lines between pixels.
    image_.pixels.assign(static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height),
                         rgb(240, 240, 240));
  }
  Image take() {
    for (int y = 0; y < closeup_.part.height; ++y)
      for (int x = 0; x < closeup_.part.width; ++x) cell(x, y);
    for (const lab::Line& line : closeup_.lines) draw(line);
    return std::move(image_);
  }

 private:
  std::uint32_t& at(int x, int y) {
    return image_.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
                         static_cast<std::size_t>(x)];
  }
  void cell(int px, int py) {
    const std::size_t i = static_cast<std::size_t>(py) * static_cast<std::size_t>(closeup_.part.width) +
                          static_cast<std::size_t>(px);
    const lab::Mark mark = closeup_.marks[i];
    const std::uint32_t visible = closeup_.visible[i];
    const std::uint32_t colour = mark != lab::Mark::none ? lab::colour_of(mark)
                                 : visible == lab::kNoTriangle
                                     ? kBackground
                                     : kPaleColours[visible % std::size(kPaleColours)];
    const int gap = scale_ < 6 ? 0 : 1;  // between pixels
    for (int y = gap; y < scale_; ++y)
      for (int x = gap; x < scale_; ++x) at(px * scale_ + x, py * scale_ + y) = colour;
    // The sample point.
    const int reach = scale_ / 16, middle = scale_ / 2;
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
        if (x * x + y * y <= reach * reach)
          at(px * scale_ + middle + x, py * scale_ + middle + y) =
              mark == lab::Mark::none ? kDot : kLineColour;
  }
  // Antialiased line: steps along the longer axis and splits the ink between the two nearest pixels (Wu, "An
  // efficient antialiasing technique", 1991).
  void draw(const lab::Line& line) {
    const auto to_x = [&](double x) { return (x - closeup_.part.x0) * scale_; };
    const auto to_y = [&](double y) { return (y - closeup_.part.y0) * scale_; };
    double x0 = to_x(line.x0), y0 = to_y(line.y0), x1 = to_x(line.x1), y1 = to_y(line.y1);
    const bool steep = std::abs(y1 - y0) > std::abs(x1 - x0);
    if (steep) std::swap(x0, y0), std::swap(x1, y1);
    if (x0 > x1) std::swap(x0, x1), std::swap(y0, y1);
    const double slope = x1 > x0 ? (y1 - y0) / (x1 - x0) : 0.0;
    const int limit = steep ? image_.height : image_.width;
    const int begin = static_cast<int>(std::clamp(std::round(x0), 0.0, double(limit)));
    const int end = static_cast<int>(std::clamp(std::round(x1) + 1, 0.0, double(limit)));
    for (int x = begin; x < end; ++x) {
      const double y = y0 + slope * (x - x0);
      if (y < -2 || y > image_.width + image_.height) continue;
      const int below = static_cast<int>(std::floor(y));
      ink(x, below, 1.0 - (y - below), steep);
      ink(x, below + 1, y - below, steep);
    }
  }
  void ink(int along, int across, double opacity, bool steep) {
    const int x = steep ? across : along, y = steep ? along : across;
    if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
    std::uint32_t& pixel = at(x, y);
    const auto channel = [&](int shift) {
      const double from = pixel >> shift & 255, to = kLineColour >> shift & 255;
      return static_cast<std::uint32_t>(from + (to - from) * opacity + 0.5);
    };
    pixel = rgb(channel(0), channel(8), channel(16));
  }

  const Closeup& closeup_;
  int scale_;
  Image image_;
};

}  // namespace

Closeup closeup(const std::string& name, const lab::MarkedPicture& picture) {
  Closeup result{name, part_of(picture), {}, {}, {}};
  const lab::Window& part = result.part;
  for (int y = part.y0; y < part.y1(); ++y)
    for (int x = part.x0; x < part.x1(); ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.window.width) +
                            static_cast<std::size_t>(x);
      result.visible.push_back(picture.visible[i]);
      result.marks.push_back(picture.marks[i]);
    }
  std::copy_if(picture.lines.begin(), picture.lines.end(), std::back_inserter(result.lines),
               [&](const lab::Line& line) { return near(line, part); });
  return result;
}

void add_unless_known(Closeup closeup, std::vector<Closeup>& closeups, std::size_t first) {
  const auto shows = [](const Closeup& c) {
    return std::tie(c.part.x0, c.part.y0, c.part.width, c.part.height, c.visible, c.marks, c.lines);
  };
  const auto known = closeups.begin() + static_cast<std::ptrdiff_t>(first);
  if (std::none_of(known, closeups.end(), [&](const Closeup& c) { return shows(c) == shows(closeup); }))
    closeups.push_back(std::move(closeup));
}

Image draw(const Closeup& closeup) {
  return Drawing(closeup).take();
}

void check_closeup_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  auto existing = folder;
  while (!existing.empty() && !std::filesystem::exists(existing, ignored)) existing = existing.parent_path();
  if (existing.empty()) existing = ".";
  if (!std::filesystem::is_directory(existing, ignored))
    throw std::runtime_error(existing.string() + ": not a folder");
  if (access(existing.c_str(), W_OK) != 0)
    throw std::runtime_error(existing.string() + ": cannot be written");
}

void write_closeups(const std::filesystem::path& folder, std::span<const Closeup> closeups) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": " + error.message());
  for (const Closeup& c : closeups) write_image(folder / (c.name + ".png"), draw(c));
}

}  // namespace edgewise::tools
