#include "hashes/files.h"

#include <memory>
#include <sstream>
#include <variant>

#include "edgewise/tri_file.h"
#include "image/format.h"
#include "scene/tri_input.h"

namespace edgewise::hashes {

namespace {

template <typename Content>
std::string bytes_of(void (*write)(std::ostream&, const Content&), const Content& content) {
  std::ostringstream out;
  write(out, content);
  return out.str();
}

InputFile input(const std::string& bytes) {
  return {std::make_unique<std::istringstream>(bytes), bytes.size()};
}

Image image_of(const Samples& samples) {
  Image image{samples.width, samples.height, {}};
  for (const auto& [r, g, b, alpha] : samples.pixels)
    image.pixels.push_back(rgb(r / 257u, g / 257u, b / 257u));
  return image;
}

}  // namespace

const FileFormat kTri{[](const Drawable& drawable, const ConstFrameView&) {
                        return bytes_of(write_tri, std::get<TriangleStream>(drawable));
                      },
                      [](const std::string& name, const std::string& bytes) {
                        return bytes_of(write_tri, read_tri(name, input(bytes)));
                      }};
const FileFormat kPpm{
    [](const Drawable&, const ConstFrameView& frame) { return bytes_of(write_ppm, to_image(frame)); },
    [](const std::string& name, const std::string& bytes) {
      return bytes_of(write_ppm, image_of(read_ppm(name, input(bytes))));
    }};
const FileFormat kPfm{
    [](const Drawable&, const ConstFrameView& frame) { return bytes_of(write_pfm, to_depth_map(frame)); },
    [](const std::string& name, const std::string& bytes) {
      const FloatMap map = read_pfm(name, input(bytes));
      return bytes_of(write_pfm, DepthMap{map.width, map.height, map.values});
    }};

}  // namespace edgewise::hashes
