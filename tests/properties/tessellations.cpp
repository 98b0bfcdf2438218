// Triangulations: starts with a rectangle of two triangles, inserts points one by one, and finally flips
// edges. All arithmetic is on exact integers, so neighbours share whole edges and no triangles overlap.
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "properties/streams.h"

namespace edgewise::testing {

namespace {

constexpr std::int32_t kSub = Coarse::kSub, kGuardSub = Coarse::kGuardSub;

struct Point {
  std::int32_t x, y;  // sub-units
  bool operator==(const Point&) const = default;
};

struct Recipe {
  int width, height;          // px
  Point low, high;            // of the rectangle
  std::vector<Point> points;  // ones outside are not put in
  std::vector<std::uint32_t> flips;
};

using Triangle = std::array<Point, 3>;

std::int64_t doubled_area(const Point& a, const Point& b, const Point& c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

// Inserts a point: splits its triangle into three, or both neighbours of its edge into two.
void insert(std::vector<Triangle>& mesh, const Point& p) {
  std::vector<Triangle> result;
  for (const Triangle& t : mesh) {
    const std::array<std::int64_t, 3> opposite{doubled_area(p, t[1], t[2]), doubled_area(p, t[2], t[0]),
                                               doubled_area(p, t[0], t[1])};
    const bool inside = std::all_of(opposite.begin(), opposite.end(), [](auto area) { return area >= 0; });
    if (!inside || std::count(t.begin(), t.end(), p) > 0) {
      result.push_back(t);
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (opposite[i] > 0) result.push_back({p, t[(i + 1) % 3], t[(i + 2) % 3]});
  }
  mesh = std::move(result);
}

// Exchanges the diagonal of the quadrilateral at one edge, if it has two neighbours and stays convex.
void flip(std::vector<Triangle>& mesh, std::uint32_t edge) {
  const std::size_t first = edge / 3 % mesh.size(), corner = edge % 3;
  const Point a = mesh[first][corner], b = mesh[first][(corner + 1) % 3], c = mesh[first][(corner + 2) % 3];
  for (Triangle& neighbour : mesh)
    for (std::size_t i = 0; i < 3; ++i) {
      if (neighbour[i] != b || neighbour[(i + 1) % 3] != a) continue;
      const Point d = neighbour[(i + 2) % 3];
      if (doubled_area(c, a, d) <= 0 || doubled_area(d, b, c) <= 0) return;
      neighbour = {d, b, c};
      mesh[first] = {c, a, d};
      return;
    }
}

// Coverage ignores depths and colours. They only make triangles distinguishable in a picture.
TriangleStream build(const Recipe& recipe) {
  const auto [left, top] = recipe.low;
  const auto [right, bottom] = recipe.high;
  std::vector<Triangle> mesh{{Point{left, top}, {right, top}, {right, bottom}},
                             {Point{left, top}, {right, bottom}, {left, bottom}}};
  for (const Point& p : recipe.points) insert(mesh, p);
  for (const std::uint32_t edge : recipe.flips) flip(mesh, edge);
  TriangleStream stream{recipe.width, recipe.height, {}};
  for (const Triangle& t : mesh) {
    const auto vertex = [&](std::size_t i) {
      return glm::vec3(glm::vec2(t[i].x, t[i].y) / float{kSub}, 0.5f);
    };
    const auto n = static_cast<std::uint32_t>(stream.triangles.size() + 1);
    stream.triangles.push_back({{vertex(0), vertex(1), vertex(2)}, 0xFF000000u | n * 0x9E3779u});
  }
  return stream;
}

Recipe make_recipe(Random& random, int size) {
  const int width = between(random, 1, 90), height = between(random, 1, 90);
  Recipe recipe{width, height, {}, {}, {}, {}};
  // The rectangle's corners lie on pixel corners, on samples (the lower right ones on samples of the next
  // pixels), at random points around the image, or on the guard band.
  const std::int32_t out = between(random, 0, 3);
  const auto below = [&] {
    return out == 0 ? 0 : out == 1 ? 128 : out == 2 ? -between(random, 0, 999) : -kGuardSub;
  };
  const auto above = [&](int side) {
    return out == 3 ? kGuardSub : side * kSub + (out == 1 ? 128 : out == 2 ? between(random, 0, 999) : 0);
  };
  recipe.low = {below(), below()};
  recipe.high = {above(width), above(height)};
  for (int n = between(random, 0, 2 + size / 4); n > 0; --n) {
    Point p{between(random, 0, width * kSub), between(random, 0, height * kSub)};
    switch (random.below(6)) {
      case 0:
        p = {p.x / kSub * kSub, p.y / kSub * kSub};
        break;
      case 1:
        p = {Coarse::sample(p.x / kSub), Coarse::sample(p.y / kSub)};
        break;
      case 2:  // slivers
        if (!recipe.points.empty())
          p = {recipe.points.back().x + between(random, -3, 3),
               recipe.points.back().y + between(random, -3, 3)};
        break;
      case 3:  // fans: many in a row
        if (!recipe.points.empty()) p.x = recipe.points.front().x;
        break;
      default:
        break;
    }
    recipe.points.push_back(p);
  }
  for (int n = between(random, 0, size / 4); n > 0; --n)
    recipe.flips.push_back(static_cast<std::uint32_t>(random.below(1000)));
  return recipe;
}

rc::Seq<Point> simpler_points(const Point& p) {
  return rc::seq::concat(rc::seq::map(rc::shrink::towards(p.x, 0),
                                      [=](std::int32_t x) {
                                        return Point{x, p.y};
                                      }),
                         rc::seq::map(rc::shrink::towards(p.y, 0), [=](std::int32_t y) {
                           return Point{p.x, y};
                         }));
}

rc::Seq<Recipe> simpler_recipes(const Recipe& recipe) {
  const auto with_points = [=](const std::vector<Point>& points) {
    Recipe changed = recipe;
    changed.points = points;
    return changed;
  };
  const auto with_flips = [=](const std::vector<std::uint32_t>& flips) {
    Recipe changed = recipe;
    changed.flips = flips;
    return changed;
  };
  return rc::seq::concat(rc::seq::map(rc::shrink::removeChunks(recipe.points), with_points),
                         rc::seq::map(rc::shrink::removeChunks(recipe.flips), with_flips),
                         rc::seq::map(rc::shrink::eachElement(recipe.points, simpler_points), with_points));
}

}  // namespace

rc::Gen<TriangleStream> tessellations() {
  return rc::gen::map(generator<Recipe>(make_recipe, simpler_recipes), build);
}

}  // namespace edgewise::testing
