// The conformance suite's own truth: the winding number of a polygon around a sample. It shares no arithmetic
// with the contract, a backend or the laboratory: it has no biased edge functions and no triangles.
//
// The top-left rule: move each sample right by an infinitesimal step, and down by an infinitely smaller one.
// The moved sample lies on no edge. A ray from it to the right crosses an edge if the edge spans the sample's
// height, upper end included and lower end excluded, strictly to the right of the sample.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace edgewise::conformance {

template <typename T>
struct Position {
  T x, y;
};

// 1/256 px, as snapped positions are; up to 2^30.
using SubPosition = Position<std::int64_t>;

// The winding number around a pixel's sample: positive is clockwise on the y-down screen, that is front.
// Triangles that fill the polygon with its orientation must draw the pixel this many times in total.
inline int winding(std::span<const SubPosition> polygon, int px, int py) {
  const std::int64_t sx = std::int64_t{px} * 256 + 128, sy = std::int64_t{py} * 256 + 128;
  int turns = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const SubPosition &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const bool down = p.y <= sy && sy < q.y, up = q.y <= sy && sy < p.y;
    if (!down && !up) continue;
    const std::int64_t side = (q.x - p.x) * (sy - p.y) - (q.y - p.y) * (sx - p.x);
    if (down && side > 0) ++turns;
    if (up && side < 0) --turns;
  }
  return turns;
}

inline std::vector<int> windings(std::span<const SubPosition> polygon, int width, int height) {
  std::vector<int> all;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) all.push_back(winding(polygon, x, y));
  return all;
}

// Twice the area; positive is clockwise.
inline std::int64_t area(std::span<const SubPosition> polygon) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const SubPosition &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    sum += p.x * q.y - p.y * q.x;
  }
  return sum;
}

// The samples exactly on the segment between two points, which only the tie rule decides.
inline int ties(const SubPosition& p, const SubPosition& q, int width, int height) {
  int count = 0;
  for (std::int64_t y = 0; y < height; ++y)
    for (std::int64_t x = 0; x < width; ++x) {
      const std::int64_t dx = x * 256 + 128 - p.x, dy = y * 256 + 128 - p.y, ex = q.x - p.x, ey = q.y - p.y;
      const std::int64_t along = dx * ex + dy * ey;
      count += dx * ey == dy * ex && along > 0 && along < ex * ex + ey * ey;
    }
  return count;
}

}  // namespace edgewise::conformance
