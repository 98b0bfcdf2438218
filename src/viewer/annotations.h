// Additions to a picture: outlines, labels in the scene, and the pixels around one for the magnifier.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/frontend.h"
#include "edgewise/image.h"
#include "edgewise/scene.h"
#include "edgewise/screen_triangle.h"
#include "support/options.h"

namespace edgewise::viewer {

struct Pixel {
  int x, y;
};

// Text in the scene.
struct Label {
  int x, y;           // px, its centre in the picture
  std::string words;  // ASCII
  std::uint32_t colour;
};

struct Screen {
  Image picture;
  std::vector<Label> labels;
};

// Of a triangle drawn whole, and of the pieces into which clipping cut it.
inline constexpr std::uint32_t kOneOutline = rgb(0, 0, 0), kPiecesOutline = rgb(255, 255, 255);

// Draws the edges of triangles over a picture of them. A triangle's payload is the index of its source
// triangle plus one; `visible` holds the source visible at each pixel. An edge is drawn only where its source
// is visible at the pixel or next to it. kPiecesOutline marks sources of several pieces.
void add_outlines(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> visible,
                  Backend& wireframe, FrameView scratch, const Execution& execution, Image& image);

// The pixels around `focus`, `reach` to each side; black outside the picture's columns left … right - 1. All
// have the alpha 255.
Image around(const Image& image, int left, int right, Pixel focus, int reach);

// Copies `from` to the columns of `into` from `left` on. They must have room for it.
void paste(const Image& from, int left, Image& into);

// The state of a face (active, clipped, culled, …), shown as a letter.
struct FaceState {
  glm::dvec3 centre;  // in the world
  TriangleState state;
  bool two_sided;
};

// The faces of all instances, in the order of their triangles. A face gets the latest state of its
// triangles. `states` holds one state per triangle of the scene.
std::vector<FaceState> face_states(const Scene& scene, std::span<const TriangleState> states);

// The number of faces of each kind, with its letter.
std::string summary_of(std::span<const FaceState> faces);

std::size_t vertex_count(const Scene& scene);    // of all instances
inline constexpr std::size_t kMostLabels = 300;  // more would be unreadable
// A vertical strip of the screen, over its whole height, that shows one picture.
struct Strip {
  int left, width, height;  // px
};
// Adds the number of each vertex in view; none if the scene has more than kMostLabels vertices.
void add_vertex_labels(const Scene& scene, const Strip& strip, std::vector<Label>& labels);
// Adds the state letter of each face in view at its centre; none for more than kMostLabels faces.
void add_face_letters(const Camera& camera, std::span<const FaceState> faces, const Strip& strip,
                      std::vector<Label>& labels);

}  // namespace edgewise::viewer
