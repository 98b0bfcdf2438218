// Lists are identical on every machine: all arithmetic is on integers, or on floats that every machine rounds
// alike. Two random numbers are drawn in two statements, because the evaluation order of function arguments
// is unspecified.
#include "lab/cases/hard_triangles.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/random.h"
#include "edgewise/contract.h"
#include "frontend/fixed.h"

namespace edgewise::lab {

namespace {

using namespace contract;

struct Point {
  std::int32_t x, y;  // sub-units
  std::uint32_t z;    // contract units
};

// The depth distribution of one list.
enum class Depths { floats, units, few, close, ends };

class ListMaker {
 public:
  ListMaker(int count, int width, int height, int subpixel_bits, const Numbers& numbers)
      : bits(subpixel_bits),
        pixel(1 << bits),
        guard(kMaxImageSide * pixel),
        numbers_(numbers),
        count_(static_cast<std::size_t>(count)),
        width_sub_(width * pixel),
        height_sub_(height * pixel) {}

  const int bits;                   // subpixel bits
  const std::int32_t pixel, guard;  // sub-units: a pixel, and the reach of the guard band
  std::int32_t sample(std::int32_t px) const { return px * pixel + pixel / 2; }
  std::int32_t into_guard_band(std::int64_t sub) const {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(sub, -guard, guard));
  }
  std::int32_t width_sub() const { return width_sub_; }
  std::int32_t height_sub() const { return height_sub_; }
  bool full() const { return list_.size() >= count_; }
  void set_depths(Depths depths) { depths_ = depths; }
  void set_any_depths() { depths_ = static_cast<Depths>(between(0, 4)); }

  std::int32_t between(std::int64_t low, std::int64_t high) {
    return static_cast<std::int32_t>(
        low + static_cast<std::int64_t>(numbers_(static_cast<std::uint64_t>(high - low + 1))));
  }
  bool one_in(int n) { return between(1, n) == 1; }
  // Sub-units with 8 bits; with more, as many or as long in pixels, or between the two.
  std::int32_t stretched(std::int32_t sub) { return bits > 8 ? sub * (1 << between(0, bits - 8)) : sub; }

  std::uint32_t depth() {
    switch (depths_) {
      case Depths::floats:
        return quantize_depth(0x1p-24f * static_cast<float>(between(0, (1 << 24) - 1)));
      case Depths::units:
        break;
      case Depths::few:
        return quantize_depth(0.25f * static_cast<float>(between(0, 4)));
      case Depths::close:
        return kDepthHead + static_cast<std::uint32_t>(between(0, 200));
      case Depths::ends:
        return one_in(2) ? kDepthHead : kDepthHead + kDepthRange;
    }
    return any_depth();
  }

  std::uint32_t any_depth() { return kDepthHead + static_cast<std::uint32_t>(numbers_(kDepthRange + 1ull)); }

  Point at(std::int64_t x, std::int64_t y) { return {into_guard_band(x), into_guard_band(y), depth()}; }
  // A point on the image or up to `beyond` sub-units outside it.
  Point over_image(std::int32_t beyond = 0) {
    const std::int32_t x = between(-beyond, width_sub_ + beyond);
    return at(x, between(-beyond, height_sub_ + beyond));
  }
  Point near(const Point& p, std::int32_t reach) {
    const std::int32_t dx = between(-reach, reach);
    return at(std::int64_t{p.x} + dx, std::int64_t{p.y} + between(-reach, reach));
  }

  void add(const Point& a, const Point& b, const Point& c) {
    const auto q15 = [&](std::int32_t sub) { return sub * (1 << (kFineBits - bits)); };
    list_.push_back({{q15(a.x), q15(b.x), q15(c.x)}, {q15(a.y), q15(b.y), q15(c.y)}, {a.z, b.z, c.z}, 0});
  }
  // Adds a triangle with its vertices in random order.
  void add_permuted(Point a, Point b, Point c) {
    const int order = between(0, 5);
    if (order % 2 == 1) std::swap(b, c);
    if (order / 2 >= 1) std::swap(a, b);
    if (order / 2 == 2) std::swap(a, c);
    add(a, b, c);
  }
  void shuffle() {
    for (std::size_t i = list_.size(); i > 1; --i)
      std::swap(list_[i - 1], list_[static_cast<std::size_t>(numbers_(i))]);
  }
  std::vector<ScreenTriangle> take() {
    list_.resize(count_);
    for (std::size_t i = 0; i < list_.size(); ++i) list_[i].payload = static_cast<std::uint32_t>(i);
    return std::move(list_);
  }

 private:
  const Numbers& numbers_;
  std::size_t count_;
  std::int32_t width_sub_, height_sub_;
  Depths depths_ = Depths::units;
  std::vector<ScreenTriangle> list_;
};

void uniform(ListMaker& m) {
  const std::int32_t beyond = m.between(0, 20) * m.pixel;
  while (!m.full()) {
    const Point a = m.over_image(beyond), b = m.over_image(beyond);
    m.add(a, b, m.over_image(beyond));
  }
}

void slivers(ListMaker& m) {
  const std::int32_t thickness = m.stretched(m.between(1, 40)), beyond = m.between(0, 200) * m.pixel;
  while (!m.full()) {
    const Point a = m.over_image(beyond), b = m.over_image(beyond);
    m.add_permuted(a, b, m.near(b, thickness));
  }
}

void huge(ListMaker& m) {
  const auto anywhere = [&] {
    const std::int32_t x = m.between(-m.guard, m.guard);
    return m.at(x, m.between(-m.guard, m.guard));
  };
  while (!m.full()) {
    const Point a = anywhere(), b = anywhere();
    m.add(a, b, m.one_in(2) ? m.over_image() : anywhere());
  }
}

void guard_band(ListMaker& m) {
  const auto extreme = [&](std::int32_t side_sub) {
    const std::array<std::int32_t, 8> extremes{-m.guard, -m.guard + 1, m.guard,      m.guard - 1,
                                               0,        side_sub,     side_sub / 2, side_sub - 1};
    return extremes[static_cast<std::size_t>(m.between(0, 7))];
  };
  const auto corner = [&] {
    const std::int32_t x = extreme(m.width_sub());
    return m.at(x, extreme(m.height_sub()));
  };
  while (!m.full()) {
    const Point a = corner(), b = corner();
    m.add(a, b, corner());
  }
}

// Vertices on multiples of `step` sub-units, `phase` away from the image's corner.
void on_lattice(ListMaker& m, std::int32_t step, std::int32_t phase) {
  const auto coordinate = [&](std::int32_t side_sub) {
    return m.between(-2, side_sub / step + 2) * step + phase;
  };
  const auto point = [&] {
    const std::int32_t x = coordinate(m.width_sub());
    return m.at(x, coordinate(m.height_sub()));
  };
  while (!m.full()) {
    const Point a = point(), b = point();
    m.add(a, b, point());
  }
}

void lattice(ListMaker& m) {
  const std::int32_t step = m.pixel << m.between(0, 6) >> m.between(0, 2);
  on_lattice(m, step, 0);
}

void pixel_centres(ListMaker& m) {
  on_lattice(m, m.pixel << m.between(0, 3), m.pixel / 2);
}

// Neighbouring cells share vertices; with large jitter they fold over one another.
void grid(ListMaker& m) {
  const int columns = m.between(1, 24);
  const int rows = m.between(1, 24);
  const std::int32_t cell = std::max(m.width_sub() / columns, m.height_sub() / rows);
  const std::array<std::int32_t, 5> jitters{0, 1, 3, cell / 5, cell};
  const std::int32_t jitter = jitters[static_cast<std::size_t>(m.between(0, 4))];
  const bool on_samples = m.one_in(3);
  std::vector<Point> points;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      Point p = m.near(
          m.at(std::int64_t{m.width_sub()} * column / columns, std::int64_t{m.height_sub()} * row / rows),
          jitter);
      if (on_samples)
        for (std::int32_t* sub : {&p.x, &p.y}) *sub = m.into_guard_band(m.sample(*sub >> m.bits));
      points.push_back(p);
    }
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const auto corner = [&](int right, int down) -> const Point& {
        return points[static_cast<std::size_t>((row + down) * (columns + 1) + column + right)];
      };
      const bool falling = m.one_in(2);
      m.add_permuted(corner(0, 0), corner(1, 0), falling ? corner(1, 1) : corner(0, 1));
      m.add_permuted(corner(1, 1), corner(0, 1), falling ? corner(0, 0) : corner(1, 0));
    }
  if (m.one_in(2)) m.shuffle();
}

// A fan from one point to a square around it: many edges share one vertex.
void fan(ListMaker& m) {
  const Point centre = m.over_image();
  const std::int64_t reach = std::int64_t{1} << m.between(2, 13 + m.bits);
  std::vector<std::int32_t> perimeter;  // positions along the square's outline
  for (int i = m.between(3, 62); i > 0; --i) perimeter.push_back(m.between(0, 8 * reach - 1));
  std::sort(perimeter.begin(), perimeter.end());
  std::vector<Point> ring;
  for (const std::int64_t position : perimeter) {
    const std::int64_t side = position / (2 * reach), along = position % (2 * reach) - reach;
    const std::int64_t dx = side == 0 ? along : side == 1 ? reach : side == 2 ? -along : -reach;
    const std::int64_t dy = side == 0 ? -reach : side == 1 ? along : side == 2 ? reach : -along;
    ring.push_back(m.at(centre.x + dx, centre.y + dy));
  }
  for (std::size_t i = 0; i < ring.size(); ++i) m.add_permuted(centre, ring[i], ring[(i + 1) % ring.size()]);
}

// Repeated triangles, and others at equal depths.
void ties(ListMaker& m) {
  m.set_depths(m.one_in(2) ? Depths::few : Depths::ends);
  const std::uint32_t level = m.depth();
  while (!m.full()) {
    Point a = m.over_image(10 * m.pixel), b = m.over_image(10 * m.pixel), c = m.over_image(10 * m.pixel);
    if (m.one_in(2)) a.z = b.z = c.z = level;
    for (int copies = m.between(1, 6); copies > 0; --copies) m.add_permuted(a, b, c);
  }
  m.shuffle();
}

// The full depth range within a few pixels, and within less than one.
void steep(ListMaker& m) {
  m.set_depths(Depths::ends);
  const std::int32_t reach = m.pixel << m.between(0, 6) >> m.between(0, 6);
  while (!m.full()) {
    const Point a = m.over_image(m.pixel), b = m.near(a, reach);
    m.add(a, b, m.near(a, reach));
  }
}

// Few of these triangles cover a sample.
void cloud(ListMaker& m) {
  const std::int32_t reach = m.stretched(m.between(1, 700));
  while (!m.full()) {
    const Point a = m.over_image(m.pixel), b = m.near(a, reach);
    m.add(a, b, m.near(a, reach));
  }
}

void mixed(ListMaker& m) {
  while (!m.full()) {
    const std::int32_t reach = 1 << m.between(0, 14 + m.bits);
    const Point a = m.over_image(m.pixel), b = m.near(a, reach);
    m.add_permuted(a, b, m.near(a, m.one_in(2) ? reach : 2 * m.pixel));
  }
}

// Points, doubled vertices, three collinear vertices, some of them moved by one sub-unit to get an area.
// Triangles with area are mixed in: in a vector, a degenerate one must not displace them.
void degenerate(ListMaker& m) {
  while (!m.full()) {
    const Point a = m.over_image(5 * m.pixel);
    Point b = m.near(a, m.pixel << m.between(0, 7));
    Point c = m.at(2 * std::int64_t{b.x} - a.x, 2 * std::int64_t{b.y} - a.y);
    const int kind = m.between(0, 5);
    if (kind == 0) b = c = a;
    if (kind == 1) c = b;
    if (kind == 2) c = m.near(c, 1);
    if (kind == 3) c = m.near(c, 20 * m.pixel);
    m.add_permuted(a, b, c);
  }
}

// Edges almost parallel to a row or a column. Half of them have a slope around 4096 px per row, the limit
// from which edges take another path (src/raster/README.md).
void flat(ListMaker& m) {
  const bool upright = m.one_in(2);
  while (!m.full()) {
    const Point a = m.over_image(10 * m.pixel);
    const std::int64_t rise = m.stretched(m.between(-600, 600));
    const std::int64_t run = rise * (m.one_in(2) ? m.between(4090, 4102) : m.between(1, 20'000));
    const Point b = upright ? m.at(a.x + rise, a.y + run) : m.at(a.x + run, a.y + rise);
    m.add_permuted(a, b, m.near(a, m.between(1, 60) * m.pixel));
  }
}

// Each vertex and each depth is made in another way, so that all combinations occur, and most bytes of a
// fuzzer change one vertex.
void vertices(ListMaker& m) {
  const auto coordinate = [&](int way) {
    if (way == 0) return m.between(-m.guard, m.guard);
    if (way == 1) return m.between(-128 * m.pixel, 128 * m.pixel - 1);
    const std::int32_t n = m.between(-128, 127);
    if (way == 2) return m.sample(n);
    if (way == 3) return n * m.pixel;  // a pixel's corner
    return n < 0 ? n + 128 - m.guard : m.guard - n;
  };
  std::vector<Point> before;
  std::uint32_t z = kDepthHead;
  const auto vertex = [&] {
    const int ways = m.between(0, 31), way = ways % 8, depth_way = ways / 8;
    Point p{};
    if (way < 5) {
      p.x = coordinate(way);
      p.y = coordinate(way);
    } else if (!before.empty()) {
      const auto most = std::min<std::int64_t>(static_cast<std::int64_t>(before.size()), 256);
      p = before[static_cast<std::size_t>(m.between(0, most - 1))];
      if (way == 6) {
        p.x = m.into_guard_band(std::int64_t{p.x} + m.between(-128, 127));
        p.y = m.into_guard_band(std::int64_t{p.y} + m.between(-128, 127));
      } else if (way == 7) {  // an edge along an axis
        std::int32_t& moved = m.one_in(2) ? p.x : p.y;
        moved = coordinate(1);
      }
    }
    if (depth_way == 0) z = m.any_depth();
    if (depth_way == 1) z = kDepthHead + static_cast<std::uint32_t>(m.between(0, 1)) * kDepthRange;
    if (depth_way == 2) z = kDepthHead + kDepthRange / 2 + static_cast<std::uint32_t>(m.between(0, 255));
    p.z = z;
    before.push_back(p);
    return p;
  };
  while (!m.full()) {
    const Point a = vertex(), b = vertex();
    m.add(a, b, vertex());
  }
}

struct TriangleFamily {
  std::string_view name;
  void (*add)(ListMaker& maker);  // adds at least one triangle; take() drops those beyond the count
};

constexpr std::array kFamilies = {
    TriangleFamily{"vertices", vertices},            // each vertex in another way
    TriangleFamily{"uniform", uniform},              // vertices anywhere on the image and a little outside it
    TriangleFamily{"slivers", slivers},              // long, and up to 40 sub-units thick
    TriangleFamily{"huge", huge},                    // vertices anywhere in the guard band
    TriangleFamily{"guard-band", guard_band},        // in the corners of the guard band and of the image
    TriangleFamily{"lattice", lattice},              // vertices on corners, halves and quarters of pixels
    TriangleFamily{"pixel-centres", pixel_centres},  // vertices on samples
    TriangleFamily{"grid", grid},                    // shared edges: a grid, jittered or folded
    TriangleFamily{"fan", fan},                      // shared edges: many through one vertex
    TriangleFamily{"ties", ties},                    // equal depths, and triangles drawn again
    TriangleFamily{"steep", steep},                  // the full depth range within a few pixels
    TriangleFamily{"cloud", cloud},                  // smaller than a pixel, or little larger
    TriangleFamily{"mixed", mixed},                  // all sizes from a sub-unit to the guard band
    TriangleFamily{"degenerate", degenerate},        // no area, or a minimal one
    TriangleFamily{"flat", flat},                    // edges almost parallel to a row or a column
};

constexpr auto kNames = [] {
  std::array<std::string_view, kFamilies.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kFamilies[i].name;
  return names;
}();

}  // namespace

std::span<const std::string_view> triangle_families() {
  return kNames;
}

std::vector<ScreenTriangle> adversarial(std::string_view family, int count, int width, int height,
                                        const Numbers& numbers, int subpixel_bits) {
  const auto found = std::ranges::find(kFamilies, family, &TriangleFamily::name);
  if (found == kFamilies.end())
    throw std::invalid_argument("unknown family of triangles: " + std::string(family));
  ListMaker maker(count, width, height, subpixel_bits, numbers);
  while (!maker.full()) {
    maker.set_any_depths();
    found->add(maker);
  }
  return maker.take();
}

std::vector<ScreenTriangle> adversarial(std::string_view family, int count, int width, int height,
                                        std::uint64_t seed, int subpixel_bits) {
  Random random(seed);
  return adversarial(
      family, count, width, height, [&](std::uint64_t end) { return random.below(end); }, subpixel_bits);
}

}  // namespace edgewise::lab
