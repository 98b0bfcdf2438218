// `edgewise diff`: compares two pictures, or two depth files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "cli/commands.h"
#include "core/file_extension.h"
#include "edgewise/image.h"
#include "support/console.h"
#include "support/json_text.h"
#include "support/output_path.h"

namespace edgewise::tools {

namespace {

struct DiffOptions {
  std::string a, b, mask, output;
  bool json = false;
};

bool is_depth_path(const std::string& path) {
  return extension_of(path) == ".pfm";
}

void check_kind(const std::string& path) {
  if (!is_depth_path(path) && !is_image_path(path))
    throw std::invalid_argument(path + ": unknown kind of file; .png, .ppm and .pfm can be compared");
}

template <typename A, typename B>
void check_sizes(const std::string& a_path, const A& a, const std::string& b_path, const B& b) {
  if (a.width != b.width || a.height != b.height)
    throw std::invalid_argument(fmt::format("different sizes: {} is {}x{} pixels, {} is {}x{}", a_path,
                                            a.width, a.height, b_path, b.width, b.height));
}

struct MaskedDifference {
  Difference outside;         // of the mask
  std::uint64_t masked = 0;   // pixels of the mask that are not black
  std::uint64_t ignored = 0;  // of those, the pixels that differ
};

std::vector<std::uint32_t>& pixels_of(Image& image) {
  return image.pixels;
}
std::vector<float>& pixels_of(DepthMap& map) {
  return map.depth01;
}

template <typename T>
MaskedDifference masked_difference(const DiffOptions& o, T a, T b) {
  check_sizes(o.a, a, o.b, b);
  if (o.mask.empty()) return {difference(a, b)};
  const Image mask = read_image(o.mask);
  check_sizes(o.a, a, o.mask, mask);
  const std::uint64_t all = difference(a, b).count;
  MaskedDifference result;
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
    if ((mask.pixels[i] & 0xFFFFFF) == 0) continue;
    ++result.masked;
    pixels_of(b)[i] = pixels_of(a)[i];
  }
  result.outside = difference(a, b);
  result.ignored = all - result.outside.count;
  return result;
}

int diff(const DiffOptions& o) {
  check_kind(o.a);
  check_kind(o.b);
  const bool depth = is_depth_path(o.a);
  if (depth != is_depth_path(o.b))
    throw std::invalid_argument(
        fmt::format("{} and {}: a picture cannot be compared with a depth file", o.a, o.b));
  if (!o.output.empty() && !is_image_path(o.output))
    throw std::invalid_argument("--output " + o.output + ": the name must end in .png or .ppm");
  if (!o.mask.empty() && !is_image_path(o.mask))
    throw std::invalid_argument("--mask " + o.mask + ": the name must end in .png or .ppm");
  for (const std::string& input : {o.a, o.b, o.mask}) check_output_is_not_input(o.output, input);

  const MaskedDifference masked = depth ? masked_difference(o, read_pfm(o.a), read_pfm(o.b))
                                        : masked_difference(o, read_image(o.a), read_image(o.b));
  const Difference& d = masked.outside;
  if (!o.output.empty()) write_image(o.output, d.picture);
  const auto pixels = std::uint64_t(d.picture.width) * std::uint64_t(d.picture.height);
  if (o.json) {
    nlohmann::json result{
        {"pixels", pixels}, {"differing", d.count}, {"largest", d.largest}, {"first", nullptr}};
    if (d.count > 0) result["first"] = {d.first_x, d.first_y};
    if (!o.mask.empty()) result["masked"] = masked.masked, result["differing_in_mask"] = masked.ignored;
    print(json_text(result) + "\n");
  } else {
    const std::string_view where = o.mask.empty() ? "" : " outside the mask";
    const std::uint64_t compared = pixels - masked.masked;
    std::string text =
        d.count == 0
            ? fmt::format("equal: {} pixels{}", compared, where)
            : fmt::format("{} of {} pixels{} differ, by up to {:.9g}{}; the first at x {}, y {}", d.count,
                          compared, where, d.largest, depth ? "" : " of 255", d.first_x, d.first_y);
    if (!o.mask.empty()) text += fmt::format("; {} of {} in the mask differ", masked.ignored, masked.masked);
    print(text + "\n");
  }
  return d.count == 0 ? kDone : kDiffers;
}

constexpr const char* kDiffFooter = R"(Examples:
  edgewise diff a.png b.ppm
  edgewise diff a.pfm b.pfm -o where.png     (grey where equal, red where not)
  edgewise diff golden.png now.png --mask mask.png    (the mask of `edgewise portable`)

Pictures are compared as 8-bit RGB: 16-bit PNGs are reduced to 8 bits, and alpha is ignored.
With --mask, pixels count as equal where the mask is not black.

Exit status: 0 equal, 1 different, 2 cannot be compared.)";

}  // namespace

void add_diff(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("diff", "Compare two pictures, or two depth files");
  const auto o = std::make_shared<DiffOptions>();
  command.add_option("A", o->a, "Picture (.png, .ppm) or depth file (.pfm)")->required();
  command.add_option("B", o->b, "Another file of the same kind and size")->required();
  command.add_option("-o,--output", o->output, "Picture of the difference, .png or .ppm")->type_name("FILE");
  command.add_option("--mask", o->mask, "Picture that is not black where A and B may differ")
      ->type_name("FILE");
  command.add_flag("--json", o->json, "Print JSON");
  command.footer(kDiffFooter);
  command.callback([o, &action] { action = [o] { return diff(*o); }; });
}

}  // namespace edgewise::tools
