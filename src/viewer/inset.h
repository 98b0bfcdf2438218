// What is drawn over a picture: tinted errors, the magnifying glass, the axes, labels in the scene.
#pragma once

#include <span>
#include <string>
#include <vector>

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

// The glass shows the pixels around a place as squares, framed, in the lower right corner.
void magnify(Image& image, Pixel focus);
int glass_side(app::Size picture);  // px

// Pastes `from` with its upper left corner at (x, y); what lies outside is left out.
void paste(const Image& from, int x, int y, Image& into);

// The world's axes as the camera sees them: x red, y green, z blue, drawn by the library into the lower left
// corner of the picture; and their letters.
void draw_axes(const Camera& camera, Cell cell, Screen& screen);

std::size_t vertex_count(const Scene& scene);  // of all instances
// More would be too many to read.
inline constexpr std::size_t kMostLabels = 300;
// A part of the screen, over its whole height, that shows a picture.
struct Panel {
  int left, width, height;  // px
  Cell cell;
};
// The number of each vertex, where the camera sees it; none if there are more than kMostLabels.
void add_vertex_labels(const Scene& scene, const Panel& panel, std::vector<Text>& texts);
// The same of faces, at their centres: the letters of their states.
void add_face_letters(const Camera& camera, std::span<const FaceState> faces, const Panel& panel,
                      std::vector<Text>& texts);

}  // namespace edgewise::viewer
