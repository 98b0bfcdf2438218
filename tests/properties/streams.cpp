#include "properties/streams.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "lab/cases/to_stream.h"
#include "properties/pictures.h"
#include "support.h"

namespace edgewise::testing {

namespace {

// How streams shrink: fewer triangles, a smaller image, nearer to the origin, rounder numbers.

// Snapped to the grid first, then towards 0.
rc::Seq<float> simpler_positions(float px) {
  const std::int32_t q15 = snapped_to_grid(px);
  if (pixels(q15) != px) return rc::seq::just(pixels(q15));
  return rc::seq::map(rc::shrink::towards(q15 >> Coarse::kSpareBits, 0),
                      [](std::int32_t sub) { return pixels(sub << Coarse::kSpareBits); });
}

rc::Seq<float> simpler_depths(float z) {
  std::vector<float> simpler;
  if (z != 0.0f) simpler.push_back(0.0f);
  if (z != 0.0f && z != 0.5f) simpler.push_back(0.5f);
  if (const float rounder = std::nearbyint(z * 256.0f) / 256.0f; rounder != z) simpler.push_back(rounder);
  return rc::seq::fromContainer(simpler);
}

rc::Seq<StreamTriangle> simpler_triangles(const StreamTriangle& triangle) {
  const auto one = [&](int vertex, int axis) {
    const float value = triangle.vertex[vertex][axis];
    return rc::seq::map(axis == 2 ? simpler_depths(value) : simpler_positions(value), [=](float simpler) {
      StreamTriangle changed = triangle;
      changed.vertex[vertex][axis] = simpler;
      return changed;
    });
  };
  return rc::seq::concat(one(0, 0), one(0, 1), one(1, 0), one(1, 1), one(2, 0), one(2, 1), one(0, 2),
                         one(1, 2), one(2, 2));
}

// The stream moved by whole pixels so that its least coordinate, if it is beyond a pixel, is below one.
rc::Seq<TriangleStream> nearer_the_origin(const TriangleStream& stream, int axis) {
  float least = contract::kMaxImageSide;
  for (const StreamTriangle& t : stream.triangles)
    for (const glm::vec3& v : t.vertex) least = std::min(least, v[axis]);
  if (stream.triangles.empty() || least < 1.0f) return {};
  TriangleStream moved = stream;
  for (StreamTriangle& t : moved.triangles)
    for (glm::vec3& v : t.vertex) v[axis] -= std::floor(least);
  return rc::seq::just(moved);
}

// The image without its first columns (axis 0) or rows (axis 1); the triangles move with the rest.
rc::Seq<TriangleStream> cropped(const TriangleStream& stream, int axis) {
  const int side = axis == 0 ? stream.width : stream.height;
  return rc::seq::map(rc::shrink::towards(side, 1), [=](int smaller) {
    TriangleStream changed = stream;
    (axis == 0 ? changed.width : changed.height) = smaller;
    for (StreamTriangle& t : changed.triangles)
      for (glm::vec3& v : t.vertex)
        v[axis] = std::max(v[axis] - static_cast<float>(side - smaller), -float{contract::kMaxImageSide});
    return changed;
  });
}

// Changes one coordinate everywhere it occurs, so that shared vertices and copies stay equal.
rc::Seq<TriangleStream> simpler_shared_coordinates(const TriangleStream& stream, int axis) {
  std::vector<float> values;
  for (const StreamTriangle& t : stream.triangles)
    for (const glm::vec3& v : t.vertex) values.push_back(v[axis]);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  const auto with_values = [=](const std::vector<float>& simpler) {
    TriangleStream changed = stream;
    for (StreamTriangle& t : changed.triangles)
      for (glm::vec3& v : t.vertex) {
        const auto at = std::lower_bound(values.begin(), values.end(), v[axis]) - values.begin();
        v[axis] = simpler[static_cast<std::size_t>(at)];
      }
    return changed;
  };
  return rc::seq::map(rc::shrink::eachElement(values, axis == 2 ? simpler_depths : simpler_positions),
                      with_values);
}

rc::Seq<TriangleStream> simpler_streams(const TriangleStream& stream) {
  const auto with_triangles = [=](const std::vector<StreamTriangle>& triangles) {
    return TriangleStream{stream.width, stream.height, triangles};
  };
  const auto with_width = [=](int width) { return TriangleStream{width, stream.height, stream.triangles}; };
  const auto with_height = [=](int height) { return TriangleStream{stream.width, height, stream.triangles}; };
  return rc::seq::concat(
      rc::seq::map(rc::shrink::removeChunks(stream.triangles), with_triangles), nearer_the_origin(stream, 0),
      nearer_the_origin(stream, 1), rc::seq::map(rc::shrink::towards(stream.width, 1), with_width),
      rc::seq::map(rc::shrink::towards(stream.height, 1), with_height), cropped(stream, 0),
      cropped(stream, 1), simpler_shared_coordinates(stream, 0), simpler_shared_coordinates(stream, 1),
      simpler_shared_coordinates(stream, 2),
      rc::seq::map(rc::shrink::eachElement(stream.triangles, simpler_triangles), with_triangles));
}

TriangleStream make_grid_stream(Random& random, int size) {
  const int width = between(random, 1, 130), height = between(random, 1, 130);
  std::vector<ScreenTriangle> triangles;
  for (int part = between(random, 1, 3); part > 0; --part) {
    const auto family = kFamilies[random.below(kFamilies.size())];
    const int count = between(random, 1, 2 + size / 8);
    const auto more = adversarial(family, count, width, height, random.next());
    triangles.insert(triangles.end(), more.begin(), more.end());
  }
  TriangleStream stream = lab::to_stream(triangles, width, height);
  for (StreamTriangle& t : stream.triangles) t.colour = static_cast<std::uint32_t>(random.next());
  return stream;
}

TriangleStream make_float_stream(Random& random, int size) {
  constexpr int kStepsPerSubUnit = 8;
  constexpr float kFinePositions_px = 4'096.0f;  // beyond, floats are coarser than such a step
  TriangleStream stream = make_grid_stream(random, size);
  for (StreamTriangle& t : stream.triangles)
    for (glm::vec3& v : t.vertex) {
      for (const int axis : {0, 1})
        if (std::abs(v[axis]) < kFinePositions_px)
          v[axis] += static_cast<float>(between(random, -kStepsPerSubUnit, kStepsPerSubUnit)) /
                     (kStepsPerSubUnit * Coarse::kSub);
      if (random.below(8) == 0) v.z = random.below(2) == 0 ? 1.0f : 1e-40f;
    }
  return stream;
}

// Half of the triangles get one distant vertex, half an edge with two distant ends that crosses the image.
TriangleStream make_far_stream(Random& random, int size) {
  TriangleStream stream = make_float_stream(random, size);
  // Up to about twice the guard band: differences of positions must fit 32 bits.
  const auto far = [&](glm::vec3& v, glm::vec2 direction) {
    const glm::vec2 at = glm::vec2(v) + direction * random.uniform(100.0f, 30'000.0f);
    v.x = at.x, v.y = at.y;
  };
  for (StreamTriangle& t : stream.triangles) {
    const glm::vec2 direction = random.direction();
    if (random.below(2) == 0) {
      t.vertex[1] = t.vertex[0];
      far(t.vertex[1], -direction);
    }
    far(t.vertex[0], direction);
  }
  return stream;
}

}  // namespace

rc::Shrinkable<TriangleStream> shrinkable(const TriangleStream& stream) {
  return rc::shrinkable::shrinkRecur(stream, &simpler_streams);
}

rc::Gen<TriangleStream> grid_streams() {
  return generator<TriangleStream>(make_grid_stream, simpler_streams);
}

rc::Gen<TriangleStream> float_streams() {
  return generator<TriangleStream>(make_float_stream, simpler_streams);
}

rc::Gen<TriangleStream> far_streams() {
  return generator<TriangleStream>(make_far_stream, simpler_streams);
}

}  // namespace edgewise::testing
