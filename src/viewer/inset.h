// Drawing over a picture: tinted errors, outlines, the magnifier, the axes, labels in the scene.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/image.h"
#include "edgewise/scene.h"
#include "lab/error_marks.h"
#include "support/options.h"
#include "viewer/face_states.h"
#include "viewer/text.h"

namespace edgewise::viewer {

struct Pixel {
  int x, y;
};

// Paints the marked pixels in the colours of their marks.
void tint(Image& image, std::span<const lab::Mark> marks);

// Of a triangle drawn whole, and of the pieces into which clipping cut it.
inline constexpr std::uint32_t kOneOutline = rgb(0, 0, 0), kPiecesOutline = rgb(255, 255, 255);

// Draws the edges of triangles over a picture of them. A triangle's payload is the index of its source
// triangle plus one; `visible` holds the source visible at each pixel. An edge is drawn only where its source
// is visible at the pixel or next to it. kPiecesOutline marks sources of several pieces.
void add_outlines(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> visible,
                  Backend& wireframe, FrameView scratch, const Execution& execution, Image& image);

// Draws the magnifier, a framed enlargement of the pixels around `focus`, into the lower right corner.
void magnify(Image& image, Pixel focus);
int magnifier_side(tools::Size picture);  // px

// Pastes `from` with its upper left corner at (x, y), clipped to `into`.
void paste(const Image& from, int x, int y, Image& into);

// Draws the world's axes as the camera sees them into the lower left corner, with letters: x red, y green, z
// blue.
void draw_axes(const Camera& camera, Cell cell, Screen& screen);

std::size_t vertex_count(const Scene& scene);    // of all instances
inline constexpr std::size_t kMostLabels = 300;  // more would be unreadable
// A vertical strip of the screen, over its whole height, that shows one picture.
struct Panel {
  int left, width, height;  // px
  Cell cell;
};
// Adds the number of each vertex in view; none if the scene has more than kMostLabels vertices.
void add_vertex_labels(const Scene& scene, const Panel& panel, std::vector<Text>& texts);
// Adds the state letter of each face in view at its centre; none for more than kMostLabels faces.
void add_face_letters(const Camera& camera, std::span<const FaceState> faces, const Panel& panel,
                      std::vector<Text>& texts);

}  // namespace edgewise::viewer
