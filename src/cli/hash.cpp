// `edgewise hash`: prints one number per picture.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "edgewise/draw.h"
#include "edgewise/hash.h"
#include "files/pictures.h"
#include "support/console.h"
#include "support/json.h"
#include "support/options.h"
#include "support/progress.h"

namespace edgewise::tools {

namespace {

struct HashOptions {
  std::vector<std::string> scenes;
  SceneOptions scene;
  ExecutionOptions execution;
  MotionOptions motion;
  std::string backend = "tiled";
  bool json = false;
};

struct SceneHash {
  std::string scene;
  int width, height;
  std::vector<std::uint64_t> frames;

  std::uint64_t hash() const { return frames.size() == 1 ? frames.front() : hash_of_all(frames); }
};

std::string hex(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

SceneHash hash_of_scene(const HashOptions& o, const std::string& scene, Backend& backend, Frontend& frontend,
                        Progress& progress) {
  SceneHash result{source_name(scene), 0, 0, {}};
  std::optional<Framebuffer> frame;
  o.motion.for_each_frame(scene, o.scene, [&](Shot& shot, double, int number) {
    progress.show(static_cast<double>(number - 1) / o.motion.frames, result.scene);
    const FrontendOptions& options = shot.frontend;
    if (!frame) frame.emplace(result.width = options.width, result.height = options.height);
    draw(shot.source.drawable, frontend, options, backend, frame->view(), {background_of(options.payload)},
         o.execution.execution);
    result.frames.push_back(hash_of(*frame));
  });
  return result;
}

int hash(HashOptions& o) {
  if (o.scenes.empty())
    for (const SceneInfo& scene : builtin_scenes()) o.scenes.emplace_back(scene.name);
  for (const std::string& scene : o.scenes) check_source(scene);
  const auto backend = find_backend(o.backend).make();
  Frontend frontend;
  Progress progress;
  std::vector<std::uint64_t> hashes;
  nlohmann::json scenes;
  for (const std::string& scene : o.scenes) {
    const SceneHash found = hash_of_scene(o, scene, *backend, frontend, progress);
    progress.erase();
    hashes.push_back(found.hash());
    nlohmann::json& json = scenes.emplace_back(nlohmann::json{{"scene", found.scene},
                                                              {"width", found.width},
                                                              {"height", found.height},
                                                              {"hash", hex(found.hash())}});
    for (const std::uint64_t frame : found.frames) json["frames"].push_back(hex(frame));
    if (!o.json)
      print(fmt::format("{}  {} ({}x{})\n", hex(found.hash()), printable(found.scene), found.width,
                        found.height));
  }
  const std::string all = hex(hash_of_all(hashes));
  if (o.json)
    print(json_text(nlohmann::json{{"scenes", scenes}, {"hash", all}}, 2) + "\n");
  else
    print(all + "  all\n");
  return kDone;
}

constexpr const char* kHashFooter = R"(Examples:
  edgewise hash                                      all built-in scenes
  edgewise hash cube bunny.obj --size 640x360 --frames 90
  edgewise hash capture.tri --backend naive --target scalar --threads 1 --json

A picture's hash is XXH3-64 of its width, its height, and row by row its depths and then its
colours, as little-endian 32-bit words (src/edgewise/hash.h). It is the same on every machine, and
for every backend, SIMD target, thread count and tile size. A scene's hash is its picture's, or with
--frames the hash of its frames' hashes. The last line is the hash of all scenes' hashes. --json
also lists the hash of each frame.)";

}  // namespace

Action add_hash(CLI::App& command) {
  const auto o = std::make_shared<HashOptions>();
  command.add_option("SCENE", o->scenes, "Scenes of `edgewise list`, or .obj or .tri files (all built-in)");
  add_text(command, "--backend", "NAME", o->backend, "Backend of `edgewise list --all` (tiled)");
  o->scene.add_to(command);
  add_subpixel_bits(command, o->scene.subpixel_bits);
  o->execution.add_to(command);
  o->motion.add_to(command);
  command.add_flag("--json", o->json, "Print JSON");
  command.footer(kHashFooter);
  return [o] { return hash(*o); };
}

}  // namespace edgewise::tools
