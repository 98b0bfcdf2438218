#include "support/source.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

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

// A pipe can be read only once, but commands load a scene several times: puts what the descriptor gives into
// a file in memory, under the same number.
void keep_content(const std::string& path) {
  if (std::filesystem::is_regular_file(path)) return;
  const InputFile input = open_input(path);
  const int kept = memfd_create("edgewise", MFD_CLOEXEC);
  std::ofstream out("/proc/self/fd/" + std::to_string(kept), std::ios::binary);
  if (input.size > 0) out << input.stream->rdbuf();
  out.close();
  if (kept < 0 || !out || dup2(kept, *descriptor_of(path)) < 0) throw system_error(path, errno);
  close(kept);
}

}  // namespace

std::string input_path(const std::string& text) {
  return text == "-" ? "/dev/stdin" : text;
}

bool is_file_path(const std::string& name_or_path) {
  return name_or_path == "-" || name_or_path.find('/') != std::string::npos ||
         std::filesystem::path(name_or_path).has_extension();
}

bool is_stream_file(const std::string& path) {
  const std::string file = input_path(path);
  if (!descriptor_of(file)) return extension_of(file) == ".tri";
  keep_content(file);
  return starts_with(open_input(file), "TRI");  // TRI1 or TRI2
}

std::string source_name(const std::string& name_or_path) {
  return is_file_path(name_or_path) ? std::filesystem::path(input_path(name_or_path)).stem().string()
                                    : name_or_path;
}

void check_source(const std::string& name_or_path) {
  if (!is_file_path(name_or_path)) {
    find_scene(name_or_path);
    return;
  }
  const std::string path = input_path(name_or_path);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw std::invalid_argument(path + ": no such file");
  if (!descriptor_of(path) && extension_of(path) != ".obj" && !is_stream_file(path))
    throw std::invalid_argument(path + ": unknown kind of file; .obj and .tri can be read");
}

Source load_source(const std::string& name_or_path, const SceneRequest& request, bool fit_mesh,
                   bool recentre) {
  check_source(name_or_path);
  if (!is_file_path(name_or_path)) return load_built_in(name_or_path, request, fit_mesh);
  const std::string path = input_path(name_or_path);
  if (is_stream_file(path)) return {source_name(path), read_tri(path), true};
  ObjReport report;
  Scene scene = read_obj(path, {.recentre = recentre}, &report);
  for (const std::string& warning : report.warnings) print_note("warning: " + warning);
  if (const glm::dvec3 p = report.offset; recentre)
    print_note(fmt::format("{}: recentred by {},{},{}, which is subtracted from all positions", path, p.x,
                           p.y, p.z));
  if (fit_mesh) {
    try {
      fit(scene);
    } catch (const std::invalid_argument& error) {
      throw FileError(path, error.what());
    }
  }
  frame_camera(scene, static_cast<double>(request.width) / request.height);
  return {source_name(path), std::move(scene), false};
}

}  // namespace edgewise::tools
