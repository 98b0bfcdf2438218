// Lists are identical on every machine: all arithmetic is on integers, or on floats that every machine rounds
// alike. Two random numbers are drawn in two statements, because the evaluation order of function arguments
// is unspecified.
#include "cli/soak/triangles.h"

#include <algorithm>
#include <array>
#include <utility>

#include "edgewise/contract.h"
#include "frontend/fixed.h"

namespace edgewise::soak {

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
  ListMaker(Random& random, int width, int height)
      : random_(random),
        width_sub_(width * kSub),
        height_sub_(height * kSub),
        depths_(static_cast<Depths>(random.below(5))) {}

  std::int32_t width_sub() const { return width_sub_; }
  std::int32_t height_sub() const { return height_sub_; }
  Depths& depths() { return depths_; }

  std::int32_t between(std::int64_t low, std::int64_t high) {
    return static_cast<std::int32_t>(
        low + static_cast<std::int64_t>(random_.below(static_cast<std::uint64_t>(high - low + 1))));
  }
  bool one_in(int n) { return between(1, n) == 1; }
  int count(int most) { return between(1, most); }

  std::uint32_t depth() {
    switch (depths_) {
      case Depths::floats:
        return quantize_depth(random_.uniform(0.0f, 1.0f));
      case Depths::units:
        break;
      case Depths::few:
        return quantize_depth(0.25f * static_cast<float>(between(0, 4)));
      case Depths::close:
        return kDepthHead + static_cast<std::uint32_t>(between(0, 200));
      case Depths::ends:
        return one_in(2) ? kDepthHead : kDepthHead + kDepthRange;
    }
    return kDepthHead + static_cast<std::uint32_t>(random_.below(kDepthRange + 1ull));
  }

  Point at(std::int64_t x, std::int64_t y) {
    const auto within = [](std::int64_t v) {
      return static_cast<std::int32_t>(std::clamp<std::int64_t>(v, -kGuardSub, kGuardSub));
    };
    return {within(x), within(y), depth()};
  }
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
    list_.push_back({{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}, 0});
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
    for (std::size_t i = list_.size(); i > 1; --i) std::swap(list_[i - 1], list_[random_.below(i)]);
  }
  std::vector<ScreenTriangle> take() {
    for (std::size_t i = 0; i < list_.size(); ++i) list_[i].payload = static_cast<std::uint32_t>(i);
    return std::move(list_);
  }

 private:
  Random& random_;
  std::int32_t width_sub_, height_sub_;
  Depths depths_;
  std::vector<ScreenTriangle> list_;
};

void uniform(ListMaker& m) {
  const std::int32_t beyond = m.between(0, 20) * kSub;
  for (int i = m.count(200); i > 0; --i) {
    const Point a = m.over_image(beyond), b = m.over_image(beyond);
    m.add(a, b, m.over_image(beyond));
  }
}

void slivers(ListMaker& m) {
  const std::int32_t thickness = m.between(1, 40), beyond = m.between(0, 200) * kSub;
  for (int i = m.count(200); i > 0; --i) {
    const Point a = m.over_image(beyond), b = m.over_image(beyond);
    m.add_permuted(a, b, m.near(b, thickness));
  }
}

void huge(ListMaker& m) {
  const auto anywhere = [&] {
    const std::int32_t x = m.between(-kGuardSub, kGuardSub);
    return m.at(x, m.between(-kGuardSub, kGuardSub));
  };
  for (int i = m.count(40); i > 0; --i) {
    const Point a = anywhere(), b = anywhere();
    m.add(a, b, m.one_in(2) ? m.over_image() : anywhere());
  }
}

void guard_band(ListMaker& m) {
  const auto extreme = [&](std::int32_t side_sub) {
    const std::array<std::int32_t, 8> extremes{-kGuardSub, -kGuardSub + 1, kGuardSub,    kGuardSub - 1,
                                               0,          side_sub,       side_sub / 2, side_sub - 1};
    return extremes[static_cast<std::size_t>(m.between(0, 7))];
  };
  const auto corner = [&] {
    const std::int32_t x = extreme(m.width_sub());
    return m.at(x, extreme(m.height_sub()));
  };
  for (int i = m.count(40); i > 0; --i) {
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
  for (int i = m.count(200); i > 0; --i) {
    const Point a = point(), b = point();
    m.add(a, b, point());
  }
}

void lattice(ListMaker& m) {
  const std::int32_t step = kSub << m.between(0, 6) >> m.between(0, 2);
  on_lattice(m, step, 0);
}

void pixel_centres(ListMaker& m) {
  on_lattice(m, kSub << m.between(0, 3), kHalf);
}

// Neighbouring cells share vertices; with large jitter they fold over one another.
void grid(ListMaker& m) {
  const int columns = m.count(24), rows = m.count(24);
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
      if (on_samples) p.x = sample_sub(p.x >> kSubBits), p.y = sample_sub(p.y >> kSubBits);
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
  const std::int64_t reach = std::int64_t{1} << m.between(2, 21);
  std::vector<std::int32_t> perimeter;  // positions along the square's outline
  for (int i = 2 + m.count(60); i > 0; --i) perimeter.push_back(m.between(0, 8 * reach - 1));
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
  m.depths() = m.one_in(2) ? Depths::few : Depths::ends;
  const std::uint32_t level = m.depth();
  for (int i = m.count(20); i > 0; --i) {
    Point a = m.over_image(10 * kSub), b = m.over_image(10 * kSub), c = m.over_image(10 * kSub);
    if (m.one_in(2)) a.z = b.z = c.z = level;
    for (int copies = m.count(6); copies > 0; --copies) m.add_permuted(a, b, c);
  }
  m.shuffle();
}

// The full depth range within a few pixels, and within less than one.
void steep(ListMaker& m) {
  m.depths() = Depths::ends;
  const std::int32_t reach = kSub << m.between(0, 6) >> m.between(0, 6);
  for (int i = m.count(300); i > 0; --i) {
    const Point a = m.over_image(kSub), b = m.near(a, reach);
    m.add(a, b, m.near(a, reach));
  }
}

// Few of these triangles cover a sample. One list in eight fills several chunks of the tiled backend.
void cloud(ListMaker& m) {
  const std::int32_t reach = m.between(1, 700);
  for (int i = m.one_in(8) ? 8000 + m.count(12'000) : m.count(2000); i > 0; --i) {
    const Point a = m.over_image(kSub), b = m.near(a, reach);
    m.add(a, b, m.near(a, reach));
  }
}

void mixed(ListMaker& m) {
  for (int i = m.count(200); i > 0; --i) {
    const std::int32_t reach = 1 << m.between(0, 22);
    const Point a = m.over_image(kSub), b = m.near(a, reach);
    m.add_permuted(a, b, m.near(a, m.one_in(2) ? reach : 2 * kSub));
  }
}

// Points, doubled vertices, three collinear vertices, some of them moved by one sub-unit to get an area.
// Triangles with area are mixed in: in a SIMD batch, a degenerate one must not displace them.
void degenerate(ListMaker& m) {
  for (int i = m.count(300); i > 0; --i) {
    const Point a = m.over_image(5 * kSub);
    Point b = m.near(a, kSub << m.between(0, 7));
    Point c = m.at(2 * std::int64_t{b.x} - a.x, 2 * std::int64_t{b.y} - a.y);
    const int kind = m.between(0, 5);
    if (kind == 0) b = c = a;
    if (kind == 1) c = b;
    if (kind == 2) c = m.near(c, 1);
    if (kind == 3) c = m.near(c, 20 * kSub);
    m.add_permuted(a, b, c);
  }
}

// Edges almost parallel to a row or a column. Half of them have a slope around 4096 px per row, the limit
// from which edges take another path (src/raster/README.md).
void flat(ListMaker& m) {
  const bool upright = m.one_in(2);
  for (int i = m.count(150); i > 0; --i) {
    const Point a = m.over_image(10 * kSub);
    const std::int64_t rise = m.between(-600, 600);
    const std::int64_t run = rise * (m.one_in(2) ? m.between(4090, 4102) : m.between(1, 20'000));
    const Point b = upright ? m.at(a.x + rise, a.y + run) : m.at(a.x + run, a.y + rise);
    m.add_permuted(a, b, m.near(a, m.between(1, 60) * kSub));
  }
}

template <void (*fill)(ListMaker&)>
std::vector<ScreenTriangle> make(Random& random, int width, int height) {
  ListMaker maker(random, width, height);
  fill(maker);
  return maker.take();
}

}  // namespace

std::span<const TriangleFamily> triangle_families() {
  static constexpr std::array kFamilies = {
      TriangleFamily{"uniform", make<uniform>},  // vertices anywhere on the image and a little outside it
      TriangleFamily{"slivers", make<slivers>},  // long, and up to 40 sub-units thick
      TriangleFamily{"huge", make<huge>},        // vertices anywhere in the guard band
      TriangleFamily{"guard-band",
                     make<guard_band>},          // vertices in the corners of the guard band and of the image
      TriangleFamily{"lattice", make<lattice>},  // vertices on corners, halves and quarters of pixels
      TriangleFamily{"pixel-centres", make<pixel_centres>},  // vertices on samples
      TriangleFamily{"grid", make<grid>},                    // shared edges: a grid, jittered or folded
      TriangleFamily{"fan", make<fan>},                      // shared edges: many through one vertex
      TriangleFamily{"ties", make<ties>},                    // equal depths, and triangles drawn again
      TriangleFamily{"steep", make<steep>},                  // the full depth range within a few pixels
      TriangleFamily{"cloud", make<cloud>},  // very many that are smaller than a pixel, or little larger
      TriangleFamily{"mixed", make<mixed>},  // all sizes from a sub-unit to the guard band
      TriangleFamily{"degenerate", make<degenerate>},  // no area, or a minimal one
      TriangleFamily{"flat", make<flat>},              // edges almost parallel to a row or a column
  };
  return kFamilies;
}

}  // namespace edgewise::soak
