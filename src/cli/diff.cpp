// `edgewise diff`: compares two pictures, or two depth files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "cli/commands.h"
#include "core/input_file.h"
#include "edgewise/image.h"
#include "image/format.h"
#include "support/console.h"
#include "support/json_text.h"
#include "support/output_path.h"
#include "support/source.h"

namespace edgewise::tools {

namespace {

struct DiffOptions {
  std::string a, b, mask, output;
  std::optional<Format> format;
  bool json = false;
};

bool is_depth(const std::string& path) {
  const auto format = format_of_input(path);
  if (!format)
    throw std::invalid_argument(path + ": unknown kind of file; .png, .ppm and .pfm can be compared");
  return format == Format::pfm;
}

template <typename A, typename B>
void check_sizes(const std::string& a_path, const A& a, const std::string& b_path, const B& b) {
  if (a.width != b.width || a.height != b.height)
    throw std::invalid_argument(fmt::format("different sizes: {} is {}x{} pixels, {} is {}x{}", a_path,
                                            a.width, a.height, b_path, b.width, b.height));
}

template <typename T>
MaskedDifference masked_difference(const DiffOptions& o, const T& a, const T& b) {
  check_sizes(o.a, a, o.b, b);
  if (o.mask.empty()) return difference(a, b, nullptr);
  const Samples mask = read_samples(o.mask);
  check_sizes(o.a, a, o.mask, mask);
  return difference(a, b, &mask);
}

int diff(DiffOptions o) {
  for (std::string* input : {&o.a, &o.b, &o.mask}) *input = input_path(*input);
  if ((descriptor_of(o.a) == 0) + (descriptor_of(o.b) == 0) + (descriptor_of(o.mask) == 0) > 1)
    throw std::invalid_argument("only one of A, B and --mask can be standard input");
  const bool depth = is_depth(o.a);
  if (depth != is_depth(o.b))
    throw std::invalid_argument(
        fmt::format("{} and {}: a picture cannot be compared with a depth file", o.a, o.b));
  std::optional<OutputFile> output;
  if (!o.output.empty()) {
    output = output_file("--output", o.output, OutputKind::picture, o.format);
    check_files({{"--output", output->path}}, {o.a, o.b, o.mask});
  }

  const MaskedDifference masked = depth ? masked_difference(o, read_pfm(o.a), read_pfm(o.b))
                                        : masked_difference(o, read_samples(o.a), read_samples(o.b));
  const Difference& d = masked.outside;
  if (output) write_image(output->path, d.picture, output->format);
  const auto pixels = std::uint64_t(d.picture.width) * std::uint64_t(d.picture.height);
  if (o.json) {
    nlohmann::json result{
        {"pixels", pixels}, {"differing", d.count}, {"largest", d.largest}, {"first", nullptr}};
    if (!depth) result["scale"] = masked.scale;
    if (d.count > 0) result["first"] = {d.first_x, d.first_y};
    if (!o.mask.empty()) result["masked"] = masked.masked, result["differing_in_mask"] = masked.ignored;
    print(json_text(result) + "\n");
  } else {
    const std::string_view where = o.mask.empty() ? "" : " outside the mask";
    const std::uint64_t compared = pixels - masked.masked;
    std::string text =
        d.count == 0 ? fmt::format("equal: {} pixels{}", compared, where)
                     : fmt::format("{} of {} pixels{} differ, by up to {:.9g}{}; the first at x {}, y {}",
                                   d.count, compared, where, d.largest,
                                   depth ? "" : fmt::format(" of {}", masked.scale), d.first_x, d.first_y);
    if (!o.mask.empty()) text += fmt::format("; {} of {} in the mask differ", masked.ignored, masked.masked);
    print(text + "\n");
  }
  return d.count == 0 ? kDone : kDiffers;
}

constexpr const char* kDiffFooter = R"(Examples:
  edgewise diff a.png b.ppm
  edgewise diff a.pfm b.pfm -o where.png     (grey where equal, red where not)
  edgewise diff golden.png now.png --mask mask.png    (the mask of `edgewise portable`)
  edgewise render cube -o - | edgewise diff - golden.png

Pictures are compared sample by sample, as RGB: palettes are looked up, grey is R = G = B, and alpha
and transparent colours (tRNS) are ignored. Nothing converts colours: gAMA, iCCP, sRGB and cHRM are
ignored. An 8-bit sample v equals the 16-bit sample 257 v. If one of the pictures has 16 bits, the
difference is given of 65535, otherwise of 255. Samples of a PPM with another maximum are scaled to
255 or 65535 and rounded. With --mask, pixels count as equal where the mask is not black.

One of A, B and --mask may be standard input: - or /dev/stdin. With -o -, messages go to stderr.

Exit status: 0 equal, 1 different, 2 cannot be compared.)";

}  // namespace

Action add_diff(CLI::App& command) {
  const auto o = std::make_shared<DiffOptions>();
  command.add_option("A", o->a, "Picture (.png, .ppm) or depth file (.pfm)")->required();
  command.add_option("B", o->b, "Another file of the same kind and size")->required();
  add_text(command, "-o,--output", "FILE", o->output, "Picture of the difference (.png, .ppm; - for stdout)");
  add_text(command, "--mask", "FILE", o->mask, "Picture that is not black where A and B may differ");
  add_format(command, o->format, {Format::png, Format::ppm});
  command.add_flag("--json", o->json, "Print JSON");
  command.footer(kDiffFooter);
  return [o] { return diff(*o); };
}

}  // namespace edgewise::tools
