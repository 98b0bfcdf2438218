// tinyobjloader reports no errors: it reads a malformed number as 0, drops lines that it cannot use, and
// accepts any index. So read_geometry() checks each `v` and `f` line, and reports faults with their line
// number. It passes on only checked positions and vertex indices, in plain notation.
// This file uses the callback interface of tinyobjloader. The other interface cuts polygons at 255 corners
// and triangulates them wrongly (see polygon.cpp).
#include "edgewise/obj_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/input_file.h"
#include "edgewise/limits.h"
#include "scene/polygon.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
#pragma GCC diagnostic pop

namespace edgewise {

namespace {

constexpr std::uint32_t kGrey = rgb(200, 200, 200);
constexpr std::string_view kBlank = " \t";

std::string at_line(std::size_t line, const std::string& reason) {
  return "line " + std::to_string(line) + ": " + reason;
}

// Removes the next word from the front of a line and returns it; empty at the line's end.
std::string_view next_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlank));
  line.remove_prefix(word.size());
  return word;
}

// A word of the file for a message: shortened, and without control characters.
std::string quoted(std::string_view word) {
  std::string text(word.substr(0, 32));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return "'" + text + (word.size() > 32 ? "...'" : "'");
}

// std::from_chars does not accept a leading plus.
std::string_view without_plus(std::string_view word) {
  return word.starts_with('+') && !word.starts_with("+-") ? word.substr(1) : word;
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < ' ' || c == '\x7F';
}

// NaN if the word is not a number.
double parse_number(std::string_view word) {
  word = without_plus(word);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument)
    return std::numeric_limits<double>::quiet_NaN();
  // from_chars does not say whether the value is too small or too large.
  if (error == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);
  return value;
}

float parse_coordinate(std::string_view word, std::size_t line) {
  const auto value = static_cast<float>(parse_number(word));
  if (!std::isfinite(value))
    throw std::invalid_argument(at_line(line, quoted(word) + " is not a finite coordinate"));
  return value;
}

// A corner is V, V/T, V//N or V/T/N. Returns V; the others are not used.
int parse_corner(std::string_view word, std::size_t line) {
  const std::string_view text = without_plus(word);
  int index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  const std::string_view rest = text.substr(static_cast<std::size_t>(end - text.data()));
  if (error != std::errc() || !(rest.empty() || rest[0] == '/') ||
      rest.find_first_not_of("/+-0123456789") != rest.npos || std::count(rest.begin(), rest.end(), '/') > 2)
    throw std::invalid_argument(at_line(line, quoted(word) + " is not a vertex index"));
  if (index == 0) throw std::invalid_argument(at_line(line, "vertex index 0 (indices start at 1)"));
  return index;
}

// The file's vertices and faces, with all checks that need only one line.
struct Geometry {
  std::string text;                     // one line per vertex or face
  std::vector<std::size_t> face_lines;  // each face's line number in the file

  void add(std::string_view line, std::size_t number) {
    line = line.substr(0, line.find('#'));
    const std::string_view keyword = next_word(line);
    if (std::any_of(keyword.begin(), keyword.end(), is_control))
      throw std::invalid_argument(at_line(number, "control character in " + quoted(keyword)));
    if (keyword == "v")
      add_vertex(line, number);
    else if (keyword == "f")
      add_face(line, number);
  }

 private:
  std::int64_t vertices_ = 0;

  void add_vertex(std::string_view rest, std::size_t line) {
    text += 'v';
    ++vertices_;
    for (int i = 0; i < 3; ++i) {
      const std::string_view word = next_word(rest);
      if (word.empty()) throw std::invalid_argument(at_line(line, "a vertex needs three coordinates"));
      append(parse_coordinate(word, line));
    }
    text += '\n';
  }

  void add_face(std::string_view rest, std::size_t line) {
    int corners = 0;
    text += 'f';
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++corners)
      append(checked(parse_corner(word, line), line));
    if (corners < 3) throw std::invalid_argument(at_line(line, "a face needs three corners or more"));
    text += '\n';
    face_lines.push_back(line);
  }

  // A negative index counts back from the last vertex before the face. A positive one may name a later
  // vertex.
  int checked(int index, std::size_t line) const {
    if (-std::int64_t{index} > vertices_)
      throw std::invalid_argument(at_line(line, "a face names vertex " + std::to_string(index) + " of the " +
                                                    std::to_string(vertices_) + " before it"));
    return index;
  }

  template <typename Number>
  void append(Number number) {
    std::array<char, 32> digits;
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    text.append(1, ' ').append(digits.data(), result.ptr);
  }
};

Geometry read_geometry(std::string_view text) {
  // This also rejects UTF-16, which has a zero byte in every ASCII character.
  if (text.find('\0') != text.npos) throw std::invalid_argument("is not a text file");
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);

  Geometry geometry;
  geometry.text.reserve(text.size());
  std::string joined;  // lines that end with a backslash, joined
  for (std::size_t number = 1, first = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    if (!text.empty()) text.remove_prefix(text.starts_with("\r\n") ? 2 : 1);
    const bool continues = line.ends_with('\\') && line.find('#') == line.npos;
    if (continues) line.remove_suffix(1);
    if (continues || !joined.empty()) line = joined.append(line).append(" ");
    if (continues && !text.empty()) continue;
    geometry.add(line, first);
    joined.clear();
    first = number + 1;
  }
  return geometry;
}

// Filled by tinyobjloader's callbacks.
struct Builder {
  std::vector<glm::vec3> positions;
  std::vector<std::int64_t> corners;      // vertex indices from 0; not yet checked against the vertex count
  std::vector<std::size_t> face_ends{0};  // face i has corners face_ends[i] … face_ends[i + 1] - 1

  static void vertex(void* self, float x, float y, float z, float) {
    static_cast<Builder*>(self)->positions.emplace_back(x, y, z);
  }
  static void face(void* self, tinyobj::index_t* indices, int count) {
    auto& builder = *static_cast<Builder*>(self);
    const auto vertices_so_far = static_cast<std::int64_t>(builder.positions.size());
    for (int i = 0; i < count; ++i) {
      const std::int64_t index = indices[i].vertex_index;
      builder.corners.push_back(index > 0 ? index - 1 : vertices_so_far + index);
    }
    builder.face_ends.push_back(builder.corners.size());
  }
};

Mesh make_mesh(Builder built, const std::vector<std::size_t>& face_lines) {
  Mesh mesh;
  std::vector<std::uint32_t> polygon;
  std::vector<std::size_t> second_halves;
  for (std::size_t face = 0; face < face_lines.size(); ++face) {
    polygon.clear();
    for (std::size_t i = built.face_ends[face]; i < built.face_ends[face + 1]; ++i) {
      const std::int64_t corner = built.corners[i];
      if (corner >= static_cast<std::int64_t>(built.positions.size()))
        throw std::invalid_argument(at_line(face_lines[face], "a face names vertex " +
                                                                  std::to_string(corner + 1) + " of " +
                                                                  std::to_string(built.positions.size())));
      polygon.push_back(static_cast<std::uint32_t>(corner));
    }
    try {
      const std::size_t before = mesh.triangles.size();
      triangulate(built.positions, polygon, mesh.triangles);
      if (polygon.size() == 4 && mesh.triangles.size() == before + 2) second_halves.push_back(before + 1);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(at_line(face_lines[face], error.what()));
    }
  }
  for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  mesh.positions = std::move(built.positions);
  mesh.colours.assign(mesh.triangles.size(), kGrey);
  if (!second_halves.empty()) mesh.flags.resize(mesh.triangles.size());
  for (const std::size_t triangle : second_halves) mesh.flags[triangle] = kSecondHalf;
  mesh.clusters = clusters_of(mesh);
  return mesh;
}

Mesh parse_obj(std::string_view text) {
  Geometry geometry = read_geometry(text);
  if (geometry.face_lines.empty()) throw std::invalid_argument("has no faces");

  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = Builder::vertex;
  callbacks.index_cb = Builder::face;
  Builder built;
  std::istringstream lines(std::move(geometry.text));
  tinyobj::LoadObjWithCallback(lines, callbacks, &built);
  return make_mesh(std::move(built), geometry.face_lines);
}

}  // namespace

Scene read_obj(const std::filesystem::path& path) {
  InputFile file = open_input(path);
  if (file.size > kMaxObjBytes)
    throw file_error(
        path, "has " + std::to_string(file.size) + " bytes, more than " + std::to_string(kMaxObjBytes));
  std::string text(file.size, '\0');
  if (!file.stream.read(text.data(), static_cast<std::streamsize>(text.size())))
    throw file_error(path, "cannot be read to its end");

  Scene scene;
  try {
    scene.meshes.push_back(parse_obj(text));
  } catch (const std::invalid_argument& error) {
    throw file_error(path, error.what());
  }
  scene.instances.emplace_back();
  frame_camera(scene);
  return scene;
}

}  // namespace edgewise
