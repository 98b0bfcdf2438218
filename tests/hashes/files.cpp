#include "hashes/files.h"

#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <variant>

#include "edgewise/tri_file.h"
#include "image/format.h"
#include "scene/tri_input.h"

namespace edgewise::hashes {

namespace {

template <typename Content, typename Write, typename Read>
std::string written(const Content& content, Write write, Read read) {
  std::ostringstream out, again;
  write(out, content);
  const std::string bytes = out.str();
  write(again, read(InputFile{std::make_unique<std::istringstream>(bytes), bytes.size()}));
  if (again.str() != bytes) throw std::runtime_error("a file is not read as it was written");
  return bytes;
}

}  // namespace

std::string tri_of(const Drawable& drawable, const ConstFrameView&) {
  return written(std::get<TriangleStream>(drawable), write_tri,
                 [](InputFile file) { return read_tri("a .tri file", std::move(file)); });
}

std::string ppm_of(const Drawable&, const ConstFrameView& frame) {
  return written(to_image(frame), write_ppm, [](InputFile file) {
    const Samples samples = read_ppm("a PPM", std::move(file));
    Image image{samples.width, samples.height, {}};
    for (const auto& [r, g, b] : samples.pixels) image.pixels.push_back(rgb(r / 257u, g / 257u, b / 257u));
    return image;
  });
}

std::string pfm_of(const Drawable&, const ConstFrameView& frame) {
  return written(
      to_depth_map(frame), [](std::ostream& out, const DepthMap& map) { write_pfm(out, map); },
      [](InputFile file) { return read_pfm("a PFM", std::move(file)); });
}

}  // namespace edgewise::hashes
