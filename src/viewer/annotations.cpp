#include "viewer/annotations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "frontend/view.h"
#include "viewer/world.h"

namespace edgewise::viewer {

void add_outlines(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> visible,
                  Backend& wireframe, FrameView scratch, const Execution& execution, Image& image) {
  std::vector<std::uint32_t> pieces(1);  // by payload: number of triangles
  for (const ScreenTriangle& t : triangles) {
    pieces.resize(std::max<std::size_t>(pieces.size(), t.payload + std::size_t{1}));
    ++pieces[t.payload];
  }
  wireframe.draw(triangles, scratch, {0}, execution);
  const auto visible_near = [&](std::uint32_t source, int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u)
        if (visible[static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                    static_cast<std::size_t>(u)] == source)
          return true;
    return false;
  };
  for (int y = 0; y < image.height; ++y) {
    const std::uint32_t* const lines = scratch.payload + std::ptrdiff_t{y} * scratch.stride;
    std::uint32_t* const row = image.pixels.data() + std::ptrdiff_t{y} * image.width;
    for (int x = 0; x < image.width; ++x)
      if (lines[x] != 0 && visible_near(lines[x] - 1, x, y))
        row[x] = pieces[lines[x]] > 1 ? kPiecesOutline : kOneOutline;
  }
}

void paste(const Image& from, int left, Image& into) {
  for (std::ptrdiff_t y = 0; y < from.height; ++y)
    std::copy_n(from.pixels.begin() + y * from.width, from.width,
                into.pixels.begin() + y * into.width + left);
}

Image around(const Image& image, int left, int right, Pixel focus, int reach) {
  const int across = 2 * reach + 1;
  Image part{across, across,
             std::vector<std::uint32_t>(static_cast<std::size_t>(across * across), rgb(0, 0, 0))};
  for (int y = 0; y < across; ++y)
    for (int x = 0; x < across; ++x) {
      const int u = left + focus.x - reach + x, v = focus.y - reach + y;
      if (u >= left && u < right && v >= 0 && v < image.height)
        part.pixels[static_cast<std::size_t>(y * across + x)] |=
            image.pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(u)];
    }
  return part;
}

namespace {

struct Kind {
  TriangleState state;
  char letter;
  std::string_view name;
  std::uint32_t colour = rgb(150, 170, 190);
};
// The last kind stands for all rare states.
constexpr std::array kKinds{Kind{TriangleState::active, 'a', "active", rgb(255, 255, 255)},
                            Kind{TriangleState::clipped, 'c', "clipped", rgb(255, 210, 60)},
                            Kind{TriangleState::culled, 'b', "culled by facing"},
                            Kind{TriangleState::outside, 'o', "outside"},
                            Kind{TriangleState::outside_with_mesh, '-', "culled with their object or part"},
                            Kind{TriangleState::not_finite, 'x', "not drawable"}};

const Kind& kind_of(const FaceState& face) {
  const auto kind = std::ranges::find(kKinds, face.state, &Kind::state);
  return kind == kKinds.end() ? kKinds.back() : *kind;
}

// Adds a label centred on a point in the world, if the strip shows it.
void add_label(const View& view, glm::dvec3 world, const Strip& strip, std::string words,
               std::uint32_t colour, std::vector<Label>& labels) {
  const glm::dvec3 p = view.pixels * (world - view.origin);
  const double x = p.x / p.z, y = p.y / p.z;
  if (p.z >= view.volume.near_z && x >= 0.0 && x < strip.width && y >= 0.0 && y < strip.height)
    labels.push_back({strip.left + static_cast<int>(x), static_cast<int>(y), std::move(words), colour});
}

}  // namespace

std::vector<FaceState> face_states(const Scene& scene, std::span<const TriangleState> states) {
  std::vector<FaceState> faces;
  std::size_t id = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes.at(instance.mesh);
    const glm::dmat4 model = model_matrix(mesh, instance);
    for (std::size_t begin = 0, end = 0; begin < mesh.triangles.size(); begin = end) {
      TriangleState state = states[id];
      glm::dvec3 sum(0.0);  // of the corners
      do {
        for (int k = 0; k < 3; ++k) sum += glm::dvec3(mesh.positions[mesh.triangles[end][k]]);
        state = std::max(state, states[id++]);
      } while (++end < mesh.triangles.size() && mesh.has_flag(end, kSameFace));
      const glm::dvec3 centre(model * glm::dvec4(sum / static_cast<double>(3 * (end - begin)), 1.0));
      faces.push_back({centre, state, mesh.has_flag(begin, kTwoSided)});
    }
  }
  return faces;
}

std::string summary_of(std::span<const FaceState> faces) {
  std::string text;
  for (const Kind& kind : kKinds) {
    const auto count = std::ranges::count(faces, &kind, [](const FaceState& face) { return &kind_of(face); });
    if (count > 0) text += fmt::format("{}{} {} {}", text.empty() ? "" : ", ", kind.letter, count, kind.name);
  }
  return text + (std::ranges::any_of(faces, &FaceState::two_sided) ? "; capitals: two-sided" : "");
}

std::size_t vertex_count(const Scene& scene) {
  std::size_t vertices = 0;
  for (const Instance& instance : scene.instances)
    vertices += scene.meshes.at(instance.mesh).positions.size();
  return vertices;
}

void add_vertex_labels(const Scene& scene, const Strip& strip, std::vector<Label>& labels) {
  if (vertex_count(scene) > kMostLabels) return;
  const View view(scene.camera, strip.width, strip.height);
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::dmat4 model = model_matrix(mesh, instance);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      add_label(view, model * glm::dvec4(mesh.positions[i], 1.0), strip, std::to_string(i),
                rgb(255, 255, 255), labels);
  }
}

void add_face_letters(const Camera& camera, std::span<const FaceState> faces, const Strip& strip,
                      std::vector<Label>& labels) {
  if (faces.size() > kMostLabels) return;
  const View view(camera, strip.width, strip.height);
  for (const FaceState& face : faces) {
    const auto& [state, letter, name, colour] = kind_of(face);
    const bool capital = face.two_sided && letter != '-';
    add_label(view, face.centre, strip, {capital ? static_cast<char>(letter - 'a' + 'A') : letter}, colour,
              labels);
  }
}

}  // namespace edgewise::viewer
