// What the ranges of a scene's vertices prove about every pixel, without drawing one.
#pragma once

#include <array>
#include <limits>
#include <string>

#include "frontend/clip.h"
#include "lab/needs/question.h"

namespace edgewise::lab {

inline constexpr int kMostSubpixelBits = 16;

enum class ViewPlane { near, far, guard };
inline constexpr int kViewPlanes = 3;

// How many triangles a plane of the view volume, or the guard band, concerns.
struct Reach {
  std::uint64_t beyond = 0;    // triangles with a vertex beyond it
  std::uint64_t crossing = 0;  // of these, triangles that do not lie beyond one side of the view as a whole
};

// The largest area in px² of a box in which no triangle's edge values overflow integers of so many bits.
double largest_box_px2(int integer_bits, int subpixel_bits);

class Ranges {
 public:
  // Returns the reach of this frame's vertices by ViewPlane, in the front end's arithmetic. All 0 for
  // streams, whose triangles are on the screen already.
  std::array<Reach, kViewPlanes> add(const StudiedFrame& frame);
  // The same of all frames.
  const Reach& reach(ViewPlane plane) const { return reach_[static_cast<std::size_t>(plane)]; }
  // The planes of the last frame; 0 for streams.
  double near_z() const { return near_z_; }
  double far_z() const { return far_z_; }
  std::string describe(ViewPlane plane) const;  // "the nearest vertex is at 3.2, the plane at 0.1"

  // The bits, with the sign, of the largest edge value at a sample in a triangle's box and the picture, and
  // of twice a triangle's area. In units of 2^(-2 max(subpixel_bits, 1)) px², since samples lie at half a
  // pixel.
  int edge_value_bits(int subpixel_bits) const { return width_[static_cast<std::size_t>(subpixel_bits)]; }
  Question edge_values(int subpixel_bits) const;

 private:
  void add_vertex(const ClipVertex& v);
  void add_edge_values(const StudiedFrame& frame);

  std::array<Reach, kViewPlanes> reach_{};
  double nearest_ = std::numeric_limits<double>::infinity(), farthest_ = -nearest_, largest_px_ = 0.0;
  double near_z_ = 0.0, far_z_ = 0.0;
  std::array<double, kMostSubpixelBits + 1> largest_{};  // rounded
  std::array<int, kMostSubpixelBits + 1> width_{};
};

}  // namespace edgewise::lab
