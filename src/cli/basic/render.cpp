// `edgewise render`: draws scenes into pictures and depth files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/basic/describe.h"
#include "cli/commands.h"
#include "core/nearest_name.h"
#include "edgewise/contract.h"
#include "files/pictures.h"
#include "lab/cases/backend_comparison.h"
#include "support/console.h"
#include "support/json.h"
#include "support/milliseconds.h"
#include "support/options.h"
#include "support/output_path.h"
#include "support/progress.h"

namespace edgewise::tools {

namespace {

enum class PixelKind { colour, id, hits };

struct RenderOptions {
  std::vector<std::string> scenes;
  SceneOptions scene;
  ExecutionOptions execution;
  std::string backend = "tiled";
  bool wireframe = false;
  PixelKind pixel_kind = PixelKind::colour;
  std::string output, depth;
  std::optional<Format> format;
  MotionOptions motion;
  bool json = false;
};

struct Picture {
  std::string scene;
  double time;
  FrontendOptions frontend;
  FrontendStats stats;
  double frontend_ms, draw_ms;
  std::array<std::uint64_t, 4> hits{};  // pixels hit 0, 1, 2, 3 or more times
  std::vector<std::string> files;
};

PixelKind parse_pixel_kind(const std::string& text) {
  static constexpr std::string_view kNames[] = {"colour", "id", "hits"};
  const auto& found = find_named("payload", text, std::span<const std::string_view>(kNames), std::identity());
  return static_cast<PixelKind>(&found - kNames);
}

// Renders pictures in sequence and reuses its buffers.
class Renderer {
 public:
  explicit Renderer(const RenderOptions& options)
      : options_(options),
        info_(options.wireframe ? wireframe() : find_backend(options.backend)),
        backend_(info_.make()) {
    if (options.pixel_kind == PixelKind::hits && options.wireframe)
      throw std::invalid_argument(
          "--payload hits counts covered pixels, but --wireframe does not fill triangles");
    std::vector<std::string> names;
    for (const auto& scene : options.scenes) {
      check_source(scene);
      names.push_back(source_name(scene));
    }
    const auto outputs = [&](const char* option, const std::string& path, OutputKind kind,
                             std::optional<Format> format) {
      return OutputPaths(option, path, kind, names, options.motion.frames, format);
    };
    const bool output_is_depth = options.format == Format::pfm;
    if (output_is_depth && !options.depth.empty())
      throw std::invalid_argument("--format pfm and --depth exclude each other");
    if (options.format && options.output.empty())
      throw std::invalid_argument("--format needs --output: --depth always writes PFM");
    if (!options.depth.empty()) depths_ = outputs("--depth", options.depth, OutputKind::depth, {});
    if (!options.output.empty())
      (output_is_depth ? depths_ : images_) =
          outputs("--output", options.output, output_is_depth ? OutputKind::depth : OutputKind::picture,
                  options.format);
    if (!images_ && !depths_)
      throw std::invalid_argument("nothing to write: give --output FILE or --depth FILE");
    std::vector<Output> files;
    if (images_) images_->append_to(files);
    if (depths_) depths_->append_to(files);
    check_files(files, options.scenes);
  }

  void run() {
    if (options_.scenes.size() > 1) check_scenes();
    if (images_) images_->make_folder();
    if (depths_) depths_->make_folder();
    for (const std::string& scene : options_.scenes) render_frames(scene);
  }

 private:
  // Runs the front end on every scene first, so that an invalid one is reported before any picture is
  // written.
  void check_scenes() {
    for (const std::string& scene : options_.scenes) {
      const Shot shot = load_shot(scene, options_.scene, options_.scene.time.value_or(0.0));
      frontend_.run(shot.source.drawable, shot.frontend);
    }
  }

  void render_frames(const std::string& scene) {
    options_.motion.for_each_frame(scene, options_.scene, [&](Shot& shot, double time, int frame) {
      if (options_.motion.frames > 1) show_progress(source_name(scene), frame, 0.0);
      shot.frontend.payload = options_.pixel_kind == PixelKind::id ? Payload::id : Payload::colour;
      report(render(shot, time, frame));
    });
  }

  void show_progress(const std::string& scene, int frame, double frame_fraction) {
    progress_.show((frame - 1 + frame_fraction) / options_.motion.frames, scene);
  }

  Picture render(const Shot& shot, double time, int frame) {
    const int width = shot.frontend.width, height = shot.frontend.height;
    if (!frame_ || frame_->width() != width || frame_->height() != height) frame_.emplace(width, height);
    Picture picture{shot.source.name, time, shot.frontend, {}, 0, 0, {}, {}};

    std::span<const ScreenTriangle> triangles;
    const Execution& execution = options_.execution.execution;
    picture.frontend_ms =
        milliseconds([&] { triangles = frontend_.run(shot.source.drawable, shot.frontend, execution); });
    picture.stats = frontend_.stats();
    picture.draw_ms = milliseconds([&] {
      backend_->draw(triangles, frame_->view(), {background_of(shot.frontend.payload)}, execution);
    });

    if (depths_) {
      picture.files.push_back(depths_->file(shot.source.name, frame).path.string());
      write_pfm(picture.files.back(), to_depth_map(*frame_));
    }
    if (options_.pixel_kind == PixelKind::hits) {
      const auto hits = lab::count_hits(*backend_, triangles, width, height, execution, [&](double fraction) {
        show_progress(shot.source.name, frame, fraction);
      });
      for (const std::uint32_t n : hits) ++picture.hits[std::min(n, 3u)];
      if (images_) write_picture(picture, frame, picture_of_hits(hits, width, height));
    } else if (images_) {
      write_picture(picture, frame, picture_of(*frame_, shot.frontend.payload));
    }
    return picture;
  }

  void write_picture(Picture& picture, int frame, const Image& image) {
    const OutputFile file = images_->file(picture.scene, frame);
    picture.files.push_back(file.path.string());
    write_image(file.path, image, file.format);
  }

  // A drawn pixel is nearer than the cleared depth.
  bool is_empty() const {
    for (int y = 0; y < frame_->height(); ++y) {
      const auto* const row = frame_->depth_row(y);
      if (std::any_of(row, row + frame_->width(), [](auto z) { return z != contract::kDepthClear; }))
        return false;
    }
    return true;
  }

  void report(const Picture& picture) {
    progress_.erase();
    if (is_empty())
      print_error(fmt::format("the picture of '{}' is empty: {}", picture.scene, why_empty(picture.stats)));
    print(options_.json ? json_text(as_json(picture)) + "\n" : as_text(picture));
  }

  nlohmann::json as_json(const Picture& p) const {
    nlohmann::json json{{"scene", p.scene},
                        {"backend", info_.name},
                        {"width", p.frontend.width},
                        {"height", p.frontend.height},
                        {"cull", name_of(p.frontend.cull)},
                        {"shade", p.frontend.shade},
                        {"subpixel_bits", p.frontend.subpixel_bits},
                        {"threads", options_.execution.execution.threads},
                        {"simd_target", name_of(resolve(options_.execution.execution.target))},
                        {"time_s", p.time},
                        {"frontend", stats_json(p.stats)},
                        {"frontend_ms", p.frontend_ms},
                        {"draw_ms", p.draw_ms},
                        {"files", p.files}};
    if (options_.pixel_kind == PixelKind::hits)
      json["hits"] = {{"0", p.hits[0]}, {"1", p.hits[1]}, {"2", p.hits[2]}, {"3+", p.hits[3]}};
    return json;
  }

  std::string as_text(const Picture& p) const {
    std::string text = fmt::format("{} ({}x{}, {}): {}\n", printable(p.scene), p.frontend.width,
                                   p.frontend.height, info_.name, stats_text(p.stats));
    if (options_.pixel_kind == PixelKind::hits)
      text += fmt::format("  pixels hit: 0 times {}, once {}, twice {}, 3 times or more {}\n", p.hits[0],
                          p.hits[1], p.hits[2], p.hits[3]);
    return text + fmt::format("  front end {:.2f} ms, draw {:.2f} ms -> {}\n", p.frontend_ms, p.draw_ms,
                              listed(p.files));
  }

  const RenderOptions& options_;
  const BackendInfo& info_;
  std::unique_ptr<Backend> backend_;
  Frontend frontend_;
  std::optional<Framebuffer> frame_;
  std::optional<OutputPaths> images_, depths_;
  Progress progress_;
};

constexpr const char* kRenderFooter = R"(Examples:
  edgewise render cube -o cube.png
  edgewise render terrain --size 1920x1080 --backend scanline -o a.png --depth a.pfm
  edgewise render bunny.obj --fit --yaw 0 --cull none --no-shade -o bunny.png
  edgewise render cube sphere torus-knot -o pictures/        (pictures/cube.png, ...)
  edgewise render cube --frames 90 --fps 30 -o turn.png      (turn-0001.png, ...)
  edgewise render grid4 --payload hits -o hits.png           (is every pixel hit once?)
  edgewise render - --fit -o - --format ppm <bunny.obj | display

The background is black in pictures, and 1 in depth files (PFM, floats in [0, 1]).
If a picture came out empty, a line on standard error says why.
--payload id writes (id + 1) * 0x9E3779 modulo 2^24 as a colour, R in the lowest byte. Each triangle
  has its own colour, and ids below 16,777,215 can be recovered exactly.
--payload hits shows how often each pixel is drawn: black never, grey once, yellow twice, red more.
The printed times are of a single cold run. To measure, use edgewise_bench.

SCENE may be standard input (- or /dev/stdin), as an .obj or .tri file. -o - writes to standard
output; messages then go to stderr. With --format pfm, -o is the depth file. --depth always writes
PFM. Several pictures on standard output follow each other.)";

}  // namespace

Action add_render(CLI::App& command) {
  const auto o = std::make_shared<RenderOptions>();
  command.add_option("SCENE", o->scenes, "Scenes of `edgewise list`, or .obj or .tri files")->required();
  add_text(command, "-o,--output", "FILE", o->output,
           "Picture (.png, .ppm), folder (may be new), name with {scene}, or -");
  add_text(command, "--depth", "FILE", o->depth,
           "Depth file (.pfm, floats), folder, name with {scene}, or -");
  add_format(command, o->format, {Format::png, Format::ppm, Format::pfm});
  add_text(command, "--backend", "NAME", o->backend, "Backend of `edgewise list --all` (tiled)");
  command.add_flag("--wireframe", o->wireframe, "Draw only the edges of triangles, one pixel wide");
  add_parsed(command, "--payload", "KIND", "Pixel values: colour, id or hits (colour)",
             [o](const std::string& text) { o->pixel_kind = parse_pixel_kind(text); });
  o->scene.add_to(command);
  add_subpixel_bits(command, o->scene.subpixel_bits);
  o->execution.add_to(command);
  o->motion.add_to(command);
  command.add_flag("--json", o->json, "Print one JSON object per picture, one per line");
  command.footer(kRenderFooter);
  return [o] {
    Renderer(*o).run();
    return kDone;
  };
}

}  // namespace edgewise::tools
