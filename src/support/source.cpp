#include "support/source.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "core/file_extension.h"
#include "core/input_file.h"
#include "edgewise/obj_file.h"
#include "edgewise/tri_file.h"
#include "support/console.h"

namespace edgewise::tools {

namespace {

Source load_built_in(const std::string& name, const SceneRequest& request, bool fit_mesh) {
  const SceneInfo& info = find_scene(name);
  Source source{std::string(info.name), info.make(request), info.stream, &info};
  if (auto* scene = std::get_if<Scene>(&source.drawable); scene != nullptr && fit_mesh) fit(*scene);
  return source;
}

}  // namespace

bool is_file_path(const std::string& name_or_path) {
  return name_or_path.find('/') != std::string::npos || std::filesystem::path(name_or_path).has_extension();
}

std::string source_name(const std::string& name_or_path) {
  return is_file_path(name_or_path) ? std::filesystem::path(name_or_path).stem().string() : name_or_path;
}

void check_source(const std::string& name_or_path) {
  if (!is_file_path(name_or_path)) {
    find_scene(name_or_path);
    return;
  }
  std::error_code ignored;
  if (!std::filesystem::exists(name_or_path, ignored))
    throw std::invalid_argument(name_or_path + ": no such file");
  const std::string extension = extension_of(name_or_path);
  if (extension != ".tri" && extension != ".obj")
    throw std::invalid_argument(name_or_path + ": unknown kind of file; .obj and .tri can be read");
}

Source load_source(const std::string& name_or_path, const SceneRequest& request, bool fit_mesh,
                   bool recentre) {
  check_source(name_or_path);
  if (!is_file_path(name_or_path)) return load_built_in(name_or_path, request, fit_mesh);
  if (extension_of(name_or_path) == ".tri") return {source_name(name_or_path), read_tri(name_or_path), true};
  ObjReport report;
  Scene scene = read_obj(name_or_path, {.recentre = recentre}, &report);
  for (const std::string& warning : report.warnings) print_note("warning: " + warning);
  if (const glm::dvec3 p = report.offset; recentre)
    print_note(fmt::format("{}: recentred by {},{},{}, which is subtracted from all positions", name_or_path,
                           p.x, p.y, p.z));
  if (fit_mesh) {
    try {
      fit(scene);
    } catch (const std::invalid_argument& error) {
      throw file_error(name_or_path, error.what());
    }
    frame_camera(scene);
  }
  return {source_name(name_or_path), std::move(scene), false};
}

}  // namespace edgewise::tools
