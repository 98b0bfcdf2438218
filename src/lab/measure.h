// What is counted about a frame: differences, hits, covered pixels.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/contract.h"
#include "lab/guarded_frame.h"

namespace edgewise::lab {

// Fills both planes with what no backend draws. To be done before a draw that is judged: a pixel that the
// backend forgets to write then shows, and no earlier picture passes for its own.
void poison(Framebuffer& frame);

struct FrameDifference {
  std::uint64_t pixels = 0;  // pixels whose depth or payload differ
  int first_x = -1, first_y = -1;
  std::uint64_t outside = 0;  // words written beside the image; known of guarded frames only

  bool any() const { return pixels != 0 || outside != 0; }
};
// Both frames must have the same size.
FrameDifference compare(const Framebuffer& a, const Framebuffer& b);
FrameDifference compare(const Framebuffer& expected, const GuardedFrame& found);

// Puts triangles into groups whose members' bounding boxes don't meet, so that every pixel drawn for each of
// them shows when a group is drawn alone; indices, without those that touch no sample. Few groups for grids,
// many for scenes of deep overlap.
std::vector<std::vector<std::uint32_t>> disjoint_groups(std::span<const ScreenTriangle> triangles, int width,
                                                        int height);

// How many triangles a backend draws at each pixel, row by row, found group by group. Each group is a draw of
// the whole frame, so deep overlap takes long; `on_progress` is called with the fraction done.
std::vector<std::uint32_t> count_hits(Backend& backend, std::span<const ScreenTriangle> triangles, int width,
                                      int height, const Execution& execution,
                                      const std::function<void(double)>& on_progress = {});

// Pixels covered, each as often as triangles cover it (the sum of the hit counts), by one exact division a
// row and edge. Divided by the image's pixels this is the overdraw.
std::uint64_t covered_pixels(std::span<const ScreenTriangle> triangles, int width, int height);

}  // namespace edgewise::lab
