// The chart for choosing a method: wrong pixels and holes of whole frames.
#include "lab/choice/choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/random.h"

namespace edgewise::lab {
namespace {

constexpr Size kSize{48, 40};

std::vector<ChoiceMethod> methods() {
  std::vector<const CoverageMethod*> list;
  for (const CoverageMethod& method : coverage_methods()) list.push_back(&method);
  return choice_methods(list);
}

std::map<std::string, ChoiceCounts> counts_of(const Drawable& drawable, Size size) {
  const ChoiceJudge judge(drawable, size, 1);
  FrameDrawer drawer(size);
  std::map<std::string, ChoiceCounts> counts;
  for (const ChoiceMethod& method : methods()) {
    drawer.draw(drawable, method, Payload::id);
    counts[method.name] = judge.count(drawer.canvas().frame);
  }
  for (const ChoiceMethod& method : methods()) {
    drawer.redraw(drawable, method, Payload::id);
    EXPECT_EQ(judge.count(drawer.canvas().frame).wrong, counts[method.name].wrong) << method.name;
  }
  return counts;
}

Drawable square(float from_px, float to_px) {
  const float a = from_px, b = to_px;
  TriangleStream stream{kSize.width, kSize.height, {}};
  stream.triangles.push_back({{{a, a, 0.5f}, {b, a, 0.5f}, {b, b, 0.5f}}, 1});
  stream.triangles.push_back({{{a, a, 0.5f}, {b, b, 0.5f}, {a, b, 0.5f}}, 2});
  return stream;
}

// 8 x 8 samples: the top and the left edge count, the right and the bottom one do not.
TEST(Choice, CountsASquareWithCornersOnPixelCentresAsPredicted) {
  const auto counts = counts_of(square(2.5f, 10.5f), kSize);
  // The strict test draws the 7 x 7 samples inside, without the 7 of the diagonal. Of these one lies next to
  // the background.
  EXPECT_EQ(counts.at("float_lt").wrong, 64u - 42);
  EXPECT_EQ(counts.at("float_lt").holes, 6u);
  EXPECT_GE(counts.at("float_le").wrong, 81u - 64) << "the right and the bottom edge";
  EXPECT_EQ(counts.at("float_le").holes, 0u);
  for (const std::string method : {"float_top_left", "double_top_left", "fixed_4", "tiled_8", "tiled_15"})
    EXPECT_EQ(counts.at(method).wrong, 0u) << method;
}

// By doubles, at positions where these decide every sample.
std::uint32_t seen(const TriangleStream& stream, int x, int y) {
  std::uint32_t visible = 0;
  double nearest = 2.0;
  for (std::uint32_t i = 0; i < stream.triangles.size(); ++i) {
    const auto& v = stream.triangles[i].vertex;
    const auto side = [&](int from, int to) {
      return (double{v[to].x} - v[from].x) * (y + 0.5 - v[from].y) -
             (double{v[to].y} - v[from].y) * (x + 0.5 - v[from].x);
    };
    const double a = side(1, 2), b = side(2, 0), c = side(0, 1), area = a + b + c;
    if (std::min({a * area, b * area, c * area}) <= 0) continue;
    const double z = (a * v[0].z + b * v[1].z + c * v[2].z) / area;
    if (z < nearest) nearest = z, visible = i + 1;
  }
  return visible;
}

TEST(Choice, CountsTheSameAsBruteForceByDoubles) {
  Random random(5);
  TriangleStream stream{kSize.width, kSize.height, {}};
  for (int i = 0; i < 60; ++i) {
    StreamTriangle& t = stream.triangles.emplace_back();
    for (glm::vec3& v : t.vertex)
      v = {random.uniform(-9.0f, 57.0f), random.uniform(-9.0f, 49.0f), random.uniform(0.0f, 1.0f)};
  }
  const Drawable drawable = stream;
  const ChoiceJudge judge(drawable, kSize, 1);
  FrameDrawer drawer(kSize);
  std::uint64_t most = 0;
  for (const ChoiceMethod& method : methods()) {
    drawer.draw(drawable, method, Payload::id);
    std::uint64_t wrong = 0;
    for (int y = 0; y < kSize.height; ++y)
      for (int x = 0; x < kSize.width; ++x)
        wrong += drawer.canvas().frame.payload_row(y)[x] != seen(stream, x, y);
    EXPECT_EQ(judge.count(drawer.canvas().frame).wrong, wrong) << method.name;
    EXPECT_EQ(judge.count(drawer.canvas().frame).holes, 0u) << method.name << ": no edge is shared";
    most = std::max(most, wrong);
  }
  EXPECT_GT(most, 0u);
  EXPECT_FALSE(judge.of_float_projection(1)) << "a stream's floats are not projected";
}

}  // namespace
}  // namespace edgewise::lab
