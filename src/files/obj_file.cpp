// Statements that this reader does not know are skipped, as they are common. Everything in those that it
// knows is checked; faults are reported with their line number.
#include "edgewise/obj_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/float_state.h"
#include "core/input_file.h"
#include "core/numbers.h"
#include "edgewise/limits.h"
#include "scene/origin.h"
#include "scene/polygon.h"

namespace edgewise {

namespace {

constexpr std::uint32_t kGrey = rgb(200, 200, 200);
constexpr std::string_view kBlank = " \t\v\f";
constexpr std::uint64_t kFillSteps = 200'000'000, kFillStepsOfACorner = 16;
constexpr double kMostFloat = std::numeric_limits<float>::max();

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
std::string in_quotes(std::string_view word) {
  std::string text(word.substr(0, 32));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return "'" + text + (word.size() > 32 ? "...'" : "'");
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < ' ' || c == '\x7F';
}

double parse_finite(std::string_view word, std::size_t line, const char* what) {
  const double value = parse_number(word);
  if (!std::isfinite(static_cast<float>(value)))
    throw std::invalid_argument(at_line(line, in_quotes(word) + " is not a finite " + what));
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
    throw std::invalid_argument(at_line(line, in_quotes(word) + " is not a vertex index"));
  if (index == 0) throw std::invalid_argument(at_line(line, "vertex index 0 (indices start at 1)"));
  return index;
}

std::string_view without_trailing_blanks(std::string_view text) {
  return text.substr(0, text.find_last_not_of(kBlank) + 1);
}

std::string_view trimmed(std::string_view text) {
  return without_trailing_blanks(text.substr(std::min(text.find_first_not_of(kBlank), text.size())));
}

// True for statements of names. A '#' belongs to the name there: programs write "Paint #1" and "Paint #2".
bool takes_names(std::string_view line) {
  constexpr std::array<std::string_view, 5> kKeywords{"usemtl", "newmtl", "mtllib", "o", "g"};
  return std::find(kKeywords.begin(), kKeywords.end(), next_word(line)) != kKeywords.end();
}

// A comment starts at the beginning of a word.
std::string_view without_comment(std::string_view line) {
  for (std::size_t at = line.find('#'); at != line.npos; at = line.find('#', at + 1))
    if (at == 0 || kBlank.find(line[at - 1]) != kBlank.npos) return line.substr(0, at);
  return line;
}

// Calls handle(keyword, rest of the line, line number) for each statement of an .obj or .mtl file.
template <typename Handle>
void for_each_statement(std::string_view text, Handle&& handle) {
  // This also rejects UTF-16, which has a zero byte in every ASCII character.
  if (text.find('\0') != text.npos) throw std::invalid_argument("is not a text file");
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  while (text.ends_with('\x1A')) text.remove_suffix(1);  // Ctrl-Z, the end mark of DOS

  std::string joined;  // lines that end with a backslash, joined
  for (std::size_t number = 1, first = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view whole = without_trailing_blanks(text.substr(0, end));
    text.remove_prefix(end);
    if (!text.empty()) text.remove_prefix(text.starts_with("\r\n") ? 2 : 1);
    std::string_view line = without_comment(whole);
    const bool commented = line.size() < whole.size();
    const bool continues = line.ends_with('\\') && !commented;
    if (commented && takes_names(joined.empty() ? whole : std::string_view(joined))) line = whole;
    if (continues) line.remove_suffix(1);
    if (continues || !joined.empty()) line = joined.append(trimmed(line)).append(" ");
    if (continues && !text.empty()) continue;
    std::string_view rest = line;
    const std::string_view keyword = next_word(rest);
    if (std::any_of(keyword.begin(), keyword.end(), [](char c) { return c == '#' || is_control(c); }))
      throw std::invalid_argument(at_line(first, "# or control character in " + in_quotes(keyword)));
    handle(keyword, trimmed(rest), first);
    joined.clear();
    first = number + 1;
  }
}

std::string read_text(const std::filesystem::path& path) {
  InputFile file = open_input(path);
  if (file.size > kMaxObjBytes)
    throw FileError(path,
                    "has " + std::to_string(file.size) + " bytes, more than " + std::to_string(kMaxObjBytes));
  std::string text(file.size, '\0');
  if (!file.stream->read(text.data(), static_cast<std::streamsize>(text.size())))
    throw FileError(path, "cannot be read to its end");
  return text;
}

// Channels of 0 to 1; others are clamped.
std::uint32_t to_rgb(glm::dvec3 colour) {
  const glm::uvec3 c(glm::round(255.0 * glm::clamp(colour, 0.0, 1.0)));
  return rgb(c.x, c.y, c.z);
}

using Materials = std::map<std::string, std::uint32_t, std::less<>>;  // name → Kd

void read_materials(const std::filesystem::path& path, Materials& materials) {
  if (descriptor_of(path)) throw FileError(path, "is not a regular file");  // may wait, or be the OBJ itself
  const std::string text = read_text(path);
  std::uint32_t* colour = nullptr;
  const auto add = [&](std::string_view keyword, std::string_view rest, std::size_t line) {
    if (keyword == "newmtl") colour = &(materials[std::string(rest)] = kGrey);
    if (keyword != "Kd" || colour == nullptr || rest.starts_with("spectral") || rest.starts_with("xyz"))
      return;
    glm::dvec3 kd(0.0);
    for (int i = 0; i < 3; ++i) {
      const std::string_view word = next_word(rest);
      kd[i] = i > 0 && word.empty() ? kd[0] : parse_finite(word, line, "number");
    }
    *colour = to_rgb(kd);
  };
  try {
    for_each_statement(text, add);
  } catch (const std::invalid_argument& error) {
    throw FileError(path, error.what());
  }
}

// The file's vertices and faces, with all checks that need only one line.
class Reader {
 public:
  Reader(std::filesystem::path folder, std::vector<std::string>& warnings)
      : folder_(std::move(folder)), warnings_(warnings) {}

  void read(std::string_view text) {
    for_each_statement(text, [this](std::string_view keyword, std::string_view rest, std::size_t line) {
      if (keyword == "v")
        add_vertex(rest, line);
      else if (keyword == "f")
        add_face(rest, line);
      else if (keyword == "usemtl")
        use_material(rest, line);
      else if (keyword == "mtllib")
        add_library(rest, line);
      else if (keyword == "o")
        name_faces(open_object_, rest.empty() ? Names{} : Names{rest});
      else if (keyword == "g")
        name_faces(open_groups_, words_of(rest));
    });
    name_faces(open_object_, {});
    name_faces(open_groups_, {});
    if (skipped_ > 0)
      warn(first_skipped_, std::to_string(skipped_) + (skipped_ == 1 ? " face" : " faces, from here on,") +
                               " of fewer than three corners skipped");
    if (colour_outside_ > 0)
      warn(colour_outside_, colour_scale_ > 1.0
                                ? "vertex colours are whole numbers of 0 to 255: they are divided by 255"
                                : "vertex colours outside 0 to 1 are clamped");
    find_materials();
    if (face_lines_.empty()) throw std::invalid_argument("has no faces");
    check_indices();
  }

  // Sets `offset` to what it subtracts from the positions.
  Mesh make_mesh(bool recentre, glm::dvec3& offset) {
    offset = choose_offset(recentre);
    Mesh mesh;
    if (!recentre) mesh.origin = offset;
    mesh.positions.reserve(positions_.size());
    // A vertex that no face names may lie out of float's range then.
    for (const glm::dvec3& p : positions_)
      mesh.positions.emplace_back(glm::clamp(p - offset, -kMostFloat, kMostFloat));
    std::vector<std::uint32_t> polygon;
    std::vector<glm::vec3> vertices;
    std::vector<std::size_t> face_triangles;  // by face, its first one
    std::uint64_t steps_left = kFillSteps;
    for (std::size_t face = 0; face < face_lines_.size(); ++face) {
      polygon.assign(corners_.begin() + at(face), corners_.begin() + at(face + 1));
      const std::size_t first = mesh.triangles.size();
      if (!parts_.empty()) face_triangles.push_back(first);
      try {
        steps_left += kFillStepsOfACorner * polygon.size();
        triangulate(mesh.positions, polygon, mesh.triangles, steps_left);
      } catch (const std::invalid_argument& error) {
        mesh.triangles.resize(first);
        warn(face_lines_[face], std::string("a face is skipped: ") + error.what() +
                                    "; a file's faces may take " + std::to_string(kFillSteps));
        continue;
      }
      std::for_each(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first), mesh.triangles.end(),
                    [](glm::uvec3& t) { std::swap(t.y, t.z); });
      mesh.colours.resize(mesh.triangles.size(), colour_of(face, polygon));
      if (polygon.size() == 3) continue;
      vertices.clear();
      for (const std::uint32_t i : polygon) vertices.push_back(mesh.positions[i]);
      mesh.fill_normals(first);
      mesh.normals.resize(mesh.triangles.size(), -face_normal(vertices));
      mesh.flags.resize(first + 1);
      mesh.flags.resize(mesh.triangles.size(), kSameFace);
    }
    if (mesh.triangles.empty()) throw std::invalid_argument("has no face that can be filled");
    if (!mesh.flags.empty()) {
      mesh.fill_normals(mesh.triangles.size());
      mesh.flags.resize(mesh.triangles.size());
    }
    face_triangles.push_back(mesh.triangles.size());
    for (const auto& [name, face, count] : parts_) {
      const std::size_t first = face_triangles[face], triangles = face_triangles[face + count] - first;
      if (triangles > 0) mesh.parts.push_back({name, first, triangles});
    }
    mesh.clusters = clusters_of(mesh);
    return mesh;
  }

 private:
  std::filesystem::path folder_;
  std::vector<std::string>& warnings_;
  std::vector<glm::dvec3> positions_;
  std::vector<glm::vec3> vertex_colours_;  // NaN: none; shorter than positions_ if the last ones have none
  std::vector<std::int64_t> corners_;      // vertex indices from 0
  std::vector<std::size_t> face_ends_{0};  // face i has corners face_ends_[i] … face_ends_[i + 1] - 1
  std::vector<std::size_t> face_lines_;
  std::vector<std::uint32_t> face_materials_;  // numbers
  struct Use {
    std::uint32_t number;  // from 1, in the order of first use; 0 stands for no material
    std::size_t line;      // of the first use
  };
  std::map<std::string, Use, std::less<>> used_;
  std::vector<std::uint32_t> colours_{kGrey};  // by number
  std::uint32_t material_ = 0;
  Materials materials_;
  std::set<std::filesystem::path> libraries_;
  bool library_failed_ = false;
  std::size_t skipped_ = 0, first_skipped_ = 0;
  double colour_scale_ = 255.0;     // vertex colours are divided by it; 1 once one is no byte's value
  std::size_t colour_outside_ = 0;  // line of the first one outside 0 to 1; 0: none
  bool odd_vertices_ = false;
  std::vector<MeshPart> parts_, open_object_, open_groups_;  // of faces, not of triangles

  void warn(std::size_t line, const std::string& reason) { warnings_.push_back(at_line(line, reason)); }
  std::ptrdiff_t at(std::size_t face) const { return static_cast<std::ptrdiff_t>(face_ends_[face]); }

  // x y z, x y z weight, x y z red green blue, or x y z weight red green blue.
  void add_vertex(std::string_view rest, std::size_t line) {
    std::array<double, 7> numbers;
    std::size_t count = 0;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++count) {
      const double number = parse_finite(word, line, count < 3 ? "coordinate" : "number");
      if (count < numbers.size()) numbers[count] = number;
    }
    if (count < 3) throw std::invalid_argument(at_line(line, "a vertex needs three coordinates"));
    if (count == 6 || count == 7) {
      vertex_colours_.resize(positions_.size(), glm::vec3(std::numeric_limits<float>::quiet_NaN()));
      vertex_colours_.emplace_back(numbers[count - 3], numbers[count - 2], numbers[count - 1]);
      for (std::size_t i = count - 3; i < count; ++i) {
        if (!(numbers[i] >= 0.0 && numbers[i] <= 255.0 && numbers[i] == std::floor(numbers[i])))
          colour_scale_ = 1.0;
        if (!(numbers[i] >= 0.0 && numbers[i] <= 1.0) && colour_outside_ == 0) colour_outside_ = line;
      }
    } else if (count > 4 && !std::exchange(odd_vertices_, true)) {
      warn(line, "a vertex of " + std::to_string(count) + " numbers: those after the third are not used");
    }
    positions_.emplace_back(numbers[0], numbers[1], numbers[2]);
  }

  void add_face(std::string_view rest, std::size_t line) {
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest))
      corners_.push_back(from_zero(parse_corner(word, line), line));
    const std::size_t corners = corners_.size() - face_ends_.back();
    if (corners == 0) throw std::invalid_argument(at_line(line, "a face without corners"));
    if (corners < 3) {
      if (skipped_++ == 0) first_skipped_ = line;
      corners_.resize(face_ends_.back());
      return;
    }
    face_ends_.push_back(corners_.size());
    face_lines_.push_back(line);
    face_materials_.push_back(material_);
  }

  // A negative index counts back from the last vertex before the face. A positive one may name a later
  // vertex.
  std::int64_t from_zero(std::int64_t index, std::size_t line) const {
    const auto vertices = static_cast<std::int64_t>(positions_.size());
    if (-index > vertices)
      throw std::invalid_argument(at_line(line, "a face names vertex " + std::to_string(index) + " of the " +
                                                    std::to_string(vertices) + " before it"));
    return index > 0 ? index - 1 : vertices + index;
  }

  void use_material(std::string_view name, std::size_t line) {
    auto found = used_.find(name);
    if (found == used_.end())
      found = used_.emplace(name, Use{static_cast<std::uint32_t>(used_.size() + 1), line}).first;
    material_ = found->second.number;
  }

  using Names = std::vector<std::string_view>;
  // Of names, those before a '#' that stands alone: that begins a comment.
  static Names words_of(std::string_view text) {
    Names words;
    for (std::string_view word = next_word(text); !word.empty() && word != "#"; word = next_word(text))
      words.push_back(word);
    return words;
  }

  // Ends the open parts, and opens one for each name.
  void name_faces(std::vector<MeshPart>& open, const Names& names) {
    for (MeshPart& part : open) {
      part.count = face_lines_.size() - part.first;
      if (part.count > 0) parts_.push_back(std::move(part));
    }
    open.clear();
    for (const std::string_view name : names) open.push_back({std::string(name), face_lines_.size(), 0});
  }

  // A library may follow the use of its materials.
  void find_materials() {
    colours_.resize(used_.size() + 1, kGrey);
    auto first = used_.end();
    std::size_t unknown = 0;
    for (auto use = used_.begin(); use != used_.end(); ++use) {
      const auto found = materials_.find(use->first);
      if (found != materials_.end())
        colours_[use->second.number] = found->second;
      else if (unknown++ == 0 || use->second.number < first->second.number)
        first = use;
    }
    if (unknown > 0 && !library_failed_)
      warn(first->second.line, "no .mtl file defines material " + in_quotes(first->first) +
                                   (unknown == 1 ? "" : ", nor " + std::to_string(unknown - 1) + " more"));
  }

  bool exists(std::string_view library) const {
    std::error_code ignored;
    return std::filesystem::exists(folder_ / library, ignored);
  }

  // Programs on Windows write paths with backslashes, which a name may have elsewhere.
  std::string library_named(std::string_view name) const {
    std::string with_slashes(name);
    if (!exists(name)) std::replace(with_slashes.begin(), with_slashes.end(), '\\', '/');
    return with_slashes;
  }

  // One name, with blanks and '#' in it, if there is such a file; or else words up to a comment.
  void add_library(std::string_view names, std::size_t line) {
    Names found = words_of(without_comment(names));
    if (!names.empty() && exists(library_named(names))) found = {names};
    for (const std::string_view name : found) {
      const std::filesystem::path library = folder_ / library_named(name);
      if (!libraries_.insert(library.lexically_normal()).second) continue;
      try {
        read_materials(library, materials_);
      } catch (const std::runtime_error& error) {
        library_failed_ = true;
        warn(line, error.what());
      }
    }
  }

  void check_indices() const {
    const auto vertices = static_cast<std::int64_t>(positions_.size());
    for (std::size_t face = 0, i = 0; face < face_lines_.size(); ++face)
      for (; i < face_ends_[face + 1]; ++i)
        if (corners_[i] >= vertices)
          throw std::invalid_argument(at_line(
              face_lines_[face],
              "a face names vertex " + std::to_string(corners_[i] + 1) + " of " + std::to_string(vertices)));
  }

  // Of all vertices of faces.
  glm::dvec3 choose_offset(bool recentre) const {
    Bounds box = no_box();
    for (const std::int64_t i : corners_) extend(box, positions_[static_cast<std::size_t>(i)]);
    return recentre || is_far(box) ? rounded_centre(box) : glm::dvec3(0.0);
  }

  std::uint32_t colour_of(std::size_t face, const std::vector<std::uint32_t>& polygon) const {
    const double scale = colour_outside_ > 0 ? colour_scale_ : 1.0;
    glm::dvec3 sum(0.0);
    for (const std::uint32_t i : polygon) {
      if (i >= vertex_colours_.size() || std::isnan(vertex_colours_[i].x))
        return colours_[face_materials_[face]];
      sum += glm::clamp(glm::dvec3(vertex_colours_[i]) / scale, 0.0, 1.0);
    }
    return to_rgb(sum / static_cast<double>(polygon.size()));
  }
};

}  // namespace

Scene read_obj(const std::filesystem::path& path, const ObjOptions& options, ObjReport* report) {
  const DefaultFloatState state;
  ObjReport ignored;
  ObjReport& out = report == nullptr ? ignored : *report;
  out = {};
  Scene scene;
  try {
    Reader reader(descriptor_of(path) ? std::filesystem::path() : path.parent_path(), out.warnings);
    reader.read(read_text(path));
    scene.meshes.push_back(reader.make_mesh(options.recentre, out.offset));
  } catch (const std::invalid_argument& error) {
    throw FileError(path, error.what());
  }
  for (std::string& warning : out.warnings) warning = FileError(path, warning).what();
  scene.instances.emplace_back();
  frame_camera(scene);
  return scene;
}

}  // namespace edgewise
