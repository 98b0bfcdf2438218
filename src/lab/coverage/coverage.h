// Which pixels belong to a triangle: the methods people use, and our backends under the same measure.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/framebuffer.h"
#include "lab/method.h"
#include "lab/truth.h"

namespace edgewise::lab {

// One picture's triangles, twice: as floats, for the methods of this family, which snap for themselves if
// they do; and snapped, for the backends. Coordinates are finite and below 2^22 px; snapped ones, counted
// from the window's corner, keep to the guard band (rule 3).
struct CoverageInput {
  std::span<const FloatTriangle> floats;
  std::span<const ScreenTriangle> snapped;
};

// What is drawn into, and what a method keeps between draws. Use one a thread.
class Canvas {
 public:
  Canvas(int width, int height);
  Window window() const { return {frame.width(), frame.height()}; }
  Backend& backend(const BackendInfo& info);

  Framebuffer frame;         // payloads are written by all; depth by the backends only
  std::vector<float> depth;  // of all other methods; rows lie frame.stride() apart

 private:
  std::map<std::string_view, std::unique_ptr<Backend>> backends_;
};

// The promise of a method in numbers, against the float truth.
struct CoveragePromise {
  // The sample of every wrong pixel is this close to the line of one of the triangle's edges, and to its
  // bounding box, as long as coordinates stay in 0 … 4096 px and boxes are no larger than max_side_px.
  double reach_px;
  int max_side_px = 4096;
  // On a mesh that fills the image, whose neighbours share bit-identical vertices, and whose triangles are
  // neither slivers nor flipped by snapping:
  bool no_gaps = false, no_double_hits = false;
  bool if_on_grid = false;  // … provided that all vertices lie on the 1/256 px grid
};

struct CoverageMethod {
  MethodInfo info;
  CoveragePromise promise;
  // What is timed: clear, coverage, depth test, colour. All methods but the backends share a float depth
  // plane.
  std::function<void(const CoverageInput&, Canvas&, int threads)> draw;
  // The pixels that draw() visits, of each triangle, before the depth test; appended in any order. The same
  // code finds them.
  std::function<void(const CoverageInput&, Window, std::vector<Run>&)> runs;
  bool threaded = false;        // draw looks at `threads`
  bool contract_depth = false;  // draw leaves depths in the frame, in units of rule 6
  bool fills = true;            // else there is another picture, which nothing here judges
};

// The backends first.
std::span<const CoverageMethod> coverage_methods();
// Throws std::invalid_argument, with the nearest known name, for an unknown one.
const CoverageMethod& find_coverage_method(std::string_view name);

// All that can be looked at: the coverage methods, then wireframe().
std::span<const CoverageMethod> drawing_methods();
const CoverageMethod& find_drawing_method(std::string_view name);

// Snaps as the front end does (rule 2), for triangles that were made without it. Does not clamp to the guard
// band, since a window far off has a band of its own; |x|, |y| < 2^22 px.
std::vector<ScreenTriangle> snapped(std::span<const FloatTriangle> triangles);
// What a front end returned, put together; needs keep_unsnapped.
std::vector<FloatTriangle> unsnapped(std::span<const ScreenTriangle> triangles,
                                     std::span<const UnsnappedTriangle> at);

}  // namespace edgewise::lab
