#include "viewer/inset.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "edgewise/builtin.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "frontend/view.h"
#include "lab/view_space.h"
#include "viewer/world.h"

namespace edgewise::viewer {

namespace {

constexpr std::uint32_t kOutline = rgb(255, 255, 255), kFocus = rgb(255, 255, 0);
constexpr std::array kAxisColours{rgb(235, 70, 60), rgb(80, 200, 80), rgb(90, 130, 255)};
constexpr std::array<const char*, 3> kAxisLetters{"x", "y", "z"};

std::uint32_t* pixel(Image& image, int x, int y) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return nullptr;
  return &image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x)];
}

void outline(Image& image, int x0, int y0, int size, std::uint32_t colour) {
  for (int i = 0; i < size; ++i)
    for (const Pixel p : {Pixel{x0 + i, y0}, {x0 + i, y0 + size - 1}, {x0, y0 + i}, {x0 + size - 1, y0 + i}})
      if (std::uint32_t* const at = pixel(image, p.x, p.y)) *at = colour;
}

// Three thin boxes along the axes, seen by a camera with the given one's orientation.
Scene axes_scene(const Camera& camera) {
  constexpr float kHalfLength = 0.5f, kHalfWidth = 0.04f;
  const Drawable cube = find_scene("cube").make({});
  Scene scene;
  for (int axis = 0; axis < 3; ++axis) {
    Mesh box = std::get<Scene>(cube).meshes.front();
    std::fill(box.colours.begin(), box.colours.end(), kAxisColours[static_cast<std::size_t>(axis)]);
    scene.meshes.push_back(std::move(box));
    Instance instance{.mesh = static_cast<std::size_t>(axis), .scale = glm::vec3(kHalfWidth)};
    instance.scale[axis] = kHalfLength;
    instance.translation[axis] = kHalfLength;
    scene.instances.push_back(instance);
  }
  scene.camera.yaw = camera.yaw;
  scene.camera.pitch = camera.pitch;
  scene.camera.position = -4.0f * lab::line_of_sight(camera);
  scene.camera.fov_y = 0.65f;
  return scene;
}

// The magnifier's reach around its focus, and its size of a pixel.
struct Magnifier {
  explicit Magnifier(tools::Size picture) {
    const int room = std::min(picture.width, picture.height) * 2 / 5;
    zoom = std::clamp(room / 15, 2, 24);
    reach = std::max(room / zoom / 2, 1);
  }
  int across() const { return 2 * reach + 1; }
  int zoom, reach;  // px
};

struct Projected {
  float x_px, y_px;
  bool in_front;
};
Projected project(const glm::dmat4& to_screen, glm::dvec3 world) {
  const glm::dvec4 p = to_screen * glm::dvec4(world, 1.0);
  if (!(p.w > 0.0) || !(p.z >= 0.0)) return {0.0f, 0.0f, false};
  return {static_cast<float>(p.x / p.w), static_cast<float>(p.y / p.w), true};
}

}  // namespace

void tint(Image& image, std::span<const lab::Mark> marks) {
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i] != lab::Mark::none) image.pixels[i] = lab::colour_of(marks[i]);
}

void add_outlines(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> visible,
                  Backend& wireframe, FrameView scratch, const Execution& execution, Image& image) {
  std::vector<std::uint32_t> pieces(1);  // by payload: number of triangles
  for (const ScreenTriangle& t : triangles) {
    pieces.resize(std::max<std::size_t>(pieces.size(), t.payload + std::size_t{1}));
    ++pieces[t.payload];
  }
  wireframe.draw(triangles, scratch, 0, execution);
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

void paste(const Image& from, int left, int top, Image& into) {
  for (int y = std::max(0, -top); y < std::min(from.height, into.height - top); ++y)
    for (int x = std::max(0, -left); x < std::min(from.width, into.width - left); ++x)
      *pixel(into, left + x, top + y) =
          from.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(from.width) +
                      static_cast<std::size_t>(x)];
}

int magnifier_side(tools::Size picture) {
  const Magnifier magnifier(picture);
  return magnifier.across() * magnifier.zoom;
}

void magnify(Image& image, Pixel focus) {
  const auto [zoom, reach] = Magnifier({image.width, image.height});
  const int across = 2 * reach + 1;
  Image part{across, across, std::vector<std::uint32_t>(static_cast<std::size_t>(across * across))};
  for (int y = 0; y < across; ++y)
    for (int x = 0; x < across; ++x)
      if (const std::uint32_t* const at = pixel(image, focus.x - reach + x, focus.y - reach + y))
        *pixel(part, x, y) = *at;
  Image large = enlarge(part, zoom);
  constexpr int kLeastForGrid = 6;  // px per pixel
  if (zoom >= kLeastForGrid)
    for (int y = 0; y < large.height; ++y)
      for (int x = 0; x < large.width; ++x)
        if (x % zoom == 0 || y % zoom == 0) *pixel(large, x, y) = darkened(*pixel(large, x, y));
  outline(large, reach * zoom, reach * zoom, zoom + 1, kFocus);
  outline(large, 0, 0, large.width, kOutline);
  outline(image, focus.x - reach - 1, focus.y - reach - 1, across + 2, kOutline);
  paste(large, image.width - large.width, image.height - large.height, image);
}

void draw_axes(const Camera& camera, Cell cell, Screen& screen) {
  const int side = std::min({screen.picture.width, screen.picture.height / 3, 12 * cell.height});
  if (side < 6 * cell.height) return;
  Drawable scene = axes_scene(camera);
  FrontendOptions options;
  options.width = options.height = side;
  options.shade = false;
  Frontend frontend;
  Framebuffer frame(side, side);
  find_backend("scanline").make()->draw(frontend.run(scene, options), frame.view(), 0, {});
  const int top = screen.picture.height - side;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      if (frame.depth_row(y)[x] != contract::kDepthClear)
        *pixel(screen.picture, x, top + y) = frame.payload_row(y)[x];
  const glm::dmat4 to_screen = screen_matrix(std::get<Scene>(scene).camera, side, side);
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 tip(0.0f);
    tip[axis] = 1.2f;
    const Projected at = project(to_screen, tip);
    screen.texts.push_back(
        {static_cast<int>(at.x_px) - cell.width / 2, top + static_cast<int>(at.y_px) - cell.height / 2,
         kAxisLetters[static_cast<std::size_t>(axis)], kAxisColours[static_cast<std::size_t>(axis)]});
  }
}

std::size_t vertex_count(const Scene& scene) {
  std::size_t vertices = 0;
  for (const Instance& instance : scene.instances)
    vertices += scene.meshes.at(instance.mesh).positions.size();
  return vertices;
}

namespace {

// Adds a label centred on a point, if the point is in front of the camera and on the panel.
void add_label(Projected at, const Panel& panel, std::string words, std::uint32_t colour,
               std::vector<Text>& texts) {
  const bool seen = at.in_front && at.x_px >= 0.0f && at.x_px < static_cast<float>(panel.width) &&
                    at.y_px >= 0.0f && at.y_px < static_cast<float>(panel.height);
  if (!seen) return;
  const int half_width = panel.cell.width * static_cast<int>(words.size()) / 2;
  texts.push_back({panel.left + static_cast<int>(at.x_px) - half_width,
                   static_cast<int>(at.y_px) - panel.cell.height / 2, std::move(words), colour});
}

std::uint32_t colour_of(TriangleState state) {
  if (state == TriangleState::active) return rgb(255, 255, 255);
  return state == TriangleState::clipped ? rgb(255, 210, 60) : rgb(150, 170, 190);
}

}  // namespace

void add_vertex_labels(const Scene& scene, const Panel& panel, std::vector<Text>& texts) {
  if (vertex_count(scene) > kMostLabels) return;
  const glm::dmat4 to_screen = screen_matrix(scene.camera, panel.width, panel.height);
  for (const Instance& instance : scene.instances) {
    const glm::dmat4 to_pixels = to_screen * model_matrix(instance);
    const auto& positions = scene.meshes[instance.mesh].positions;
    for (std::size_t i = 0; i < positions.size(); ++i)
      add_label(project(to_pixels, positions[i]), panel, std::to_string(i), rgb(255, 255, 255), texts);
  }
}

void add_face_letters(const Camera& camera, std::span<const FaceState> faces, const Panel& panel,
                      std::vector<Text>& texts) {
  if (faces.size() > kMostLabels) return;
  const glm::dmat4 to_screen = screen_matrix(camera, panel.width, panel.height);
  for (const FaceState& face : faces)
    add_label(project(to_screen, face.centre), panel, {letter_of(face)}, colour_of(face.state), texts);
}

}  // namespace edgewise::viewer
