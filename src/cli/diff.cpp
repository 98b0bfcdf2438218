// `edgewise diff`: compares two pictures, or two depth files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "cli/commands.h"
#include "core/file_extension.h"
#include "edgewise/image.h"
#include "support/console.h"
#include "support/json_text.h"
#include "support/output_path.h"

namespace edgewise::tools {

namespace {

struct DiffOptions {
  std::string a, b, output;
  bool json = false;
};

bool is_depth_path(const std::string& path) {
  return extension_of(path) == ".pfm";
}

void check_kind(const std::string& path) {
  if (!is_depth_path(path) && !is_image_path(path))
    throw std::invalid_argument(path + ": unknown kind of file; .png, .ppm and .pfm can be compared");
}

template <typename T>
Difference checked_difference(const DiffOptions& o, const T& a, const T& b) {
  if (a.width != b.width || a.height != b.height)
    throw std::invalid_argument(fmt::format("different sizes: {} is {}x{} pixels, {} is {}x{}", o.a, a.width,
                                            a.height, o.b, b.width, b.height));
  return difference(a, b);
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
  for (const std::string& input : {o.a, o.b}) check_output_is_not_input(o.output, input);

  const Difference d = depth ? checked_difference(o, read_pfm(o.a), read_pfm(o.b))
                             : checked_difference(o, read_image(o.a), read_image(o.b));
  if (!o.output.empty()) write_image(o.output, d.picture);
  const auto pixels = std::uint64_t(d.picture.width) * std::uint64_t(d.picture.height);
  if (o.json) {
    nlohmann::json result{
        {"pixels", pixels}, {"differing", d.count}, {"largest", d.largest}, {"first", nullptr}};
    if (d.count > 0) result["first"] = {d.first_x, d.first_y};
    print(json_text(result) + "\n");
  } else if (d.count == 0) {
    print(fmt::format("equal: {} pixels\n", pixels));
  } else {
    print(fmt::format("{} of {} pixels differ, by up to {:.9g}{}; the first at x {}, y {}\n", d.count, pixels,
                      d.largest, depth ? "" : " of 255", d.first_x, d.first_y));
  }
  return d.count == 0 ? kDone : kDiffers;
}

constexpr const char* kDiffFooter = R"(Examples:
  edgewise diff a.png b.ppm
  edgewise diff a.pfm b.pfm -o where.png     (grey where equal, red where not)

Pictures are compared as 8-bit RGB: 16-bit PNGs are reduced to 8 bits, and alpha is ignored.

Exit status: 0 equal, 1 different, 2 cannot be compared.)";

}  // namespace

void add_diff(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("diff", "Compare two pictures, or two depth files");
  const auto o = std::make_shared<DiffOptions>();
  command.add_option("A", o->a, "Picture (.png, .ppm) or depth file (.pfm)")->required();
  command.add_option("B", o->b, "Another file of the same kind and size")->required();
  command.add_option("-o,--output", o->output, "Picture of the difference, .png or .ppm")->type_name("FILE");
  command.add_flag("--json", o->json, "Print JSON");
  command.footer(kDiffFooter);
  command.callback([o, &action] { action = [o] { return diff(*o); }; });
}

}  // namespace edgewise::tools
