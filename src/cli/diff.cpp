// `edgewise diff`: compares two pictures, or two depth files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "cli/commands.h"
#include "core/input_file.h"
#include "edgewise/image.h"
#include "image/format.h"
#include "support/console.h"
#include "support/json.h"
#include "support/output_path.h"
#include "support/source.h"

namespace edgewise::tools {

namespace {

struct DiffOptions {
  std::string a, b, mask, output;
  std::optional<Format> format;
  bool json = false;
};

int diff(DiffOptions o) {
  for (std::string* input : {&o.a, &o.b, &o.mask}) *input = input_path(*input);
  if ((descriptor_of(o.a) == 0) + (descriptor_of(o.b) == 0) + (descriptor_of(o.mask) == 0) > 1)
    throw std::invalid_argument("only one of A, B and --mask can be standard input");
  std::optional<OutputFile> output;
  if (!o.output.empty()) {
    output = output_file("--output", o.output, OutputKind::picture, o.format);
    check_files({{"--output", output->path}}, {o.a, o.b, o.mask});
  }

  std::vector<std::string> warnings;
  const Difference d = difference(std::filesystem::path(o.a), o.b, o.mask, &warnings);
  for (const std::string& warning : warnings) print_note("warning: " + warning);
  if (output) write_image(output->path, d.picture, output->format);
  const auto pixels = std::uint64_t(d.picture.width) * std::uint64_t(d.picture.height);
  if (o.json) {
    nlohmann::json result{
        {"pixels", pixels}, {"differing", d.count}, {"largest", d.largest}, {"first", nullptr}};
    if (std::isinf(d.largest)) result["infinite"] = true;  // JSON has no such number: `largest` is null
    if (d.scale != 1) result["scale"] = d.scale;
    if (d.alpha_count > 0) result["differing_in_alpha"] = d.alpha_count;
    if (d.count > 0) result["first"] = {d.first_x, d.first_y};
    if (!o.mask.empty()) result["masked"] = d.masked, result["differing_in_mask"] = d.masked_count;
    print(json_text(result) + "\n");
  } else {
    const std::string_view where = o.mask.empty() ? "" : " outside the mask";
    const std::uint64_t compared = pixels - d.masked;
    std::string text =
        d.count == 0 ? fmt::format("equal: {} pixels{}", compared, where)
                     : fmt::format("{} of {} pixels{} differ, by up to {:.9g}{}; the first at x {}, y {}",
                                   d.count, compared, where, d.largest,
                                   d.scale == 1 ? "" : fmt::format(" of {}", d.scale), d.first_x, d.first_y);
    if (d.alpha_count > 0) text += fmt::format("; alpha differs in {} pixels", d.alpha_count);
    if (!o.mask.empty()) text += fmt::format("; {} of {} in the mask differ", d.masked_count, d.masked);
    print(text + "\n");
  }
  return d.count == 0 ? kDone : kDiffers;
}

constexpr const char* kDiffFooter = R"(Examples:
  edgewise diff a.png b.ppm
  edgewise diff a.pfm b.pfm -o where.png     (grey where equal, red where not)
  edgewise diff golden.png now.png --mask mask.png    (the mask of `edgewise portable`)
  edgewise render cube -o - | edgewise diff - golden.png

The kind of a file is that of its content. Pictures (PNG, PGM, PPM) are compared sample by sample,
as RGB: palettes are looked up, and grey is R = G = B. Pixels whose alpha differs are counted apart,
and don't change the exit status. Nothing converts colours: gAMA, iCCP, sRGB and cHRM are ignored.
An 8-bit sample v equals the 16-bit sample 257 v. If one of the pictures has 16 bits, the difference
is given of 65535, otherwise of 255. Samples of a PGM or PPM with another maximum are scaled to 255
or 65535 and rounded. PFMs are compared as floats, with one channel or three; a difference to NaN is
infinite. With --mask, pixels count as equal where the mask is not black.

One of A, B and --mask may be standard input: - or /dev/stdin. With -o -, messages go to stderr.

Exit status: 0 equal, 1 different, 2 cannot be compared.)";

}  // namespace

Action add_diff(CLI::App& command) {
  const auto o = std::make_shared<DiffOptions>();
  command.add_option("A", o->a, "Picture (.png, .pgm, .ppm) or depth file (.pfm)")->required();
  command.add_option("B", o->b, "Another file of the same kind and size")->required();
  add_text(command, "-o,--output", "FILE", o->output, "Picture of the difference (.png, .ppm; - for stdout)");
  add_text(command, "--mask", "FILE", o->mask, "Picture that is not black where A and B may differ");
  add_format(command, o->format, {Format::png, Format::ppm});
  command.add_flag("--json", o->json, "Print JSON");
  command.footer(kDiffFooter);
  return [o] { return diff(*o); };
}

}  // namespace edgewise::tools
