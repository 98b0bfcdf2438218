// `edgewise portable`: the pixels that conformant rasterizers may draw differently.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/commands.h"
#include "edgewise/draw.h"
#include "files/pictures.h"
#include "lab/portable/portable.h"
#include "support/console.h"
#include "support/json.h"
#include "support/options.h"
#include "support/output_path.h"
#include "support/progress.h"

namespace edgewise::tools {

namespace {

struct PortableOptions {
  std::vector<std::string> scenes;
  SceneOptions scene;
  ExecutionOptions execution;
  lab::Conformance model;
  bool ids = false, json = false;
  std::string mask, picture;
  std::optional<Format> format;
};

// By lab::Unstable.
constexpr std::array<std::uint32_t, lab::kUnstableKinds> kMaskColours{
    rgb(0, 0, 0), rgb(0, 114, 178), rgb(213, 94, 0), rgb(240, 228, 66), rgb(204, 121, 167)};

Image mask_of(const lab::PortablePixels& found) {
  Image mask{found.width, found.height, {}};
  mask.pixels.reserve(found.reasons.size());
  for (const lab::Unstable reason : found.reasons)
    mask.pixels.push_back(kMaskColours[static_cast<std::size_t>(reason)]);
  return mask;
}

class PortableCommand {
 public:
  explicit PortableCommand(const PortableOptions& options) : options_(options) {
    std::vector<std::string> names;
    for (const std::string& scene : options.scenes) {
      check_source(scene);
      names.push_back(source_name(scene));
    }
    const auto outputs = [&](const char* option, const std::string& path) {
      return OutputPaths(option, path, OutputKind::picture, names, 1, options.format);
    };
    if (!options.mask.empty()) masks_ = outputs("--output", options.mask);
    if (!options.picture.empty()) pictures_ = outputs("--picture", options.picture);
    std::vector<Output> files;
    if (masks_) masks_->append_to(files);
    if (pictures_) pictures_->append_to(files);
    check_files(files, options.scenes);
  }

  void run() {
    if (masks_) masks_->make_folder();
    if (pictures_) pictures_->make_folder();
    for (std::size_t i = 0; i < options_.scenes.size(); ++i) {
      progress_.show(static_cast<double>(i) / static_cast<double>(options_.scenes.size()),
                     source_name(options_.scenes[i]));
      judge(load_shot(options_.scenes[i], options_.scene, options_.scene.time.value_or(0.0)));
    }
  }

 private:
  void judge(const Shot& shot) {
    const FrontendOptions& frontend = shot.frontend;
    const auto found =
        lab::portable_pixels(lab::portable_triangles(shot.source.drawable, frontend), frontend.width,
                             frontend.height, options_.model, options_.execution.execution.threads);
    std::vector<std::string> files;
    const auto write = [&](const OutputPaths& paths, const Image& image) {
      const OutputFile file = paths.file(shot.source.name, 1);
      files.push_back(file.path.string());
      write_image(file.path, image, file.format);
    };
    if (masks_) write(*masks_, mask_of(found));
    if (pictures_) write(*pictures_, reference(shot));
    progress_.erase();
    report(shot, found, files);
  }

  Image reference(const Shot& shot) const {
    FrontendOptions frontend = shot.frontend;
    frontend.payload = options_.ids ? Payload::id : Payload::colour;
    Frontend run;
    Framebuffer frame(frontend.width, frontend.height);
    draw(shot.source.drawable, run, frontend, *find_backend("tiled").make(), frame.view(),
         {background_of(frontend.payload)}, options_.execution.execution);
    return picture_of(frame, frontend.payload);
  }

  void report(const Shot& shot, const lab::PortablePixels& found,
              const std::vector<std::string>& files) const {
    const auto counts = found.counts();
    const auto pixels = static_cast<std::uint64_t>(found.reasons.size()), unstable = pixels - counts[0];
    if (options_.json) {
      nlohmann::json json{{"scene", shot.source.name},
                          {"width", found.width},
                          {"height", found.height},
                          {"subpixel_bits", options_.model.subpixel_bits},
                          {"transform_ulps", options_.model.transform_ulps},
                          {"guard_band_px", options_.model.guard_band_px},
                          {"depth", options_.model.depth.name},
                          {"pixels", pixels},
                          {"unstable", unstable},
                          {"files", files}};
      for (int i = 1; i < lab::kUnstableKinds; ++i)
        json["reasons"][std::string(name_of(static_cast<lab::Unstable>(i)))] =
            counts[static_cast<std::size_t>(i)];
      print(json_text(json) + "\n");
      return;
    }
    std::string reasons;
    for (int i = lab::kUnstableKinds - 1; i > 0; --i)
      if (const std::uint64_t n = counts[static_cast<std::size_t>(i)]; n != 0)
        reasons +=
            fmt::format("{}{} {}", reasons.empty() ? ": " : ", ", name_of(static_cast<lab::Unstable>(i)), n);
    print(fmt::format("{} ({}x{}): {:.3g} % of the pixels may differ, {} of {}{}\n",
                      printable(shot.source.name), found.width, found.height,
                      100.0 * static_cast<double>(unstable) / static_cast<double>(pixels), unstable, pixels,
                      reasons));
    if (!files.empty()) print(fmt::format("  -> {}\n", listed(files)));
  }

  const PortableOptions& options_;
  std::optional<OutputPaths> masks_, pictures_;
  Progress progress_;
};

constexpr const char* kPortableFooter = R"(Examples:
  edgewise portable cube -o mask.png --picture golden.png
  edgewise diff golden.png yours.png --mask mask.png    (fails only where all must agree)
  edgewise portable terrain --bits 4          (whatever Vulkan allows)
  edgewise portable bunny.obj --fit --ids -o mask.png --picture ids.png

Two rasterizers that follow Direct3D, Vulkan or WebGPU may draw some pixels differently: positions
are rounded, and so are depths. Outside the mask all of them show the same triangle, whatever their
rounding. The mask is conservative: some of its pixels are the same everywhere, too. It
compares triangles, not colours: where two triangles of one colour meet, pictures may be equal.
The reference picture has as many subpixel bits as --bits says, or 8 if that is more.

--depth d32_sfloat also holds for reversed Z: a float depth buffer that is cleared to 0.

The mask is black where all must agree. Its other colours name the reason:
  orange  edge   rounding decides whether a triangle covers the sample
  yellow  tie    the same, and the sample lies exactly on the edge
  purple  clip   the same, of a triangle that the near or far plane cuts; and all samples of a
                 triangle that reaches beyond the guard band, where rasterizers may clip
  blue    depth  rounding decides which of two triangles is nearer

Exit status: 0 done, 2 bad input.)";

}  // namespace

Action add_portable(CLI::App& command) {
  const auto o = std::make_shared<PortableOptions>();
  command.add_option("SCENE", o->scenes, "Scenes of `edgewise list`, or .obj or .tri files")->required();
  add_text(command, "-o,--output", "FILE", o->mask,
           "Mask (.png, .ppm), folder (may be new), name with {scene}, or -");
  add_text(command, "--picture", "FILE", o->picture, "Reference picture, named like the mask");
  add_format(command, o->format, {Format::png, Format::ppm});
  command.add_flag("--ids", o->ids, "The reference picture shows triangle ids, as `render --payload id`");
  add_integer(command, "--bits", o->model.subpixel_bits, 1, kMaxSubpixelBits,
              "The fewest subpixel bits that the rasterizers have (8)");
  add_integer(command, "--ulps", o->model.transform_ulps, 0, 1000,
              "Error of the viewport transform, in units in the last place (2)");
  add_integer(command, "--guard-band", o->model.guard_band_px, 0, 1 << 20,
              "How far triangles may reach beyond the picture, in px (3000)");
  add_parsed(command, "--depth", "FORMAT", "Depth format: d16_unorm, d24_unorm or d32_sfloat (d24_unorm)",
             [o](const std::string& text) { o->model.depth = lab::find_depth_format(text); });
  o->scene.add_to(command);
  o->execution.add_to(command);
  command.add_flag("--json", o->json, "Print one JSON object per scene, one per line");
  command.footer(kPortableFooter);
  return [o] {
    o->scene.subpixel_bits = std::max(o->scene.subpixel_bits, o->model.subpixel_bits);
    PortableCommand(*o).run();
    return kDone;
  };
}

}  // namespace edgewise::tools
