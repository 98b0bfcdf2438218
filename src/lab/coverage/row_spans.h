// Fills each row between the left and the right edges of a triangle. This is correct if each edge accepts
// exactly the samples on one side of a crossing. A crossing moves little from row to row, so the search
// starts at the previous row's: the number of tests is proportional to the box's rows plus columns, not to
// its pixels. The tests are the method's own, so the pixels do not change.
#pragma once

namespace edgewise::lab {

struct PixelRows {
  int x0, y0, x1, y1;
};

// Edge: faces_right() is true if the triangle lies to its right; row(y).accepts(x) tests a sample. Along a
// row accepts(x) must change at most once, from false to true for edges that face right, else from true to
// false.
template <class Edge, class Plot>
void fill_between(const Edge (&edges)[3], const PixelRows& box, Plot& plot) {
  // A triangle with area has at least one edge that faces right and one that faces left.
  const Edge *left[3], *right[3];
  int lefts = 0, rights = 0;
  for (const Edge& edge : edges)
    if (edge.faces_right())
      left[lefts++] = &edge;
    else
      right[rights++] = &edge;
  const Edge l0 = *left[0], l1 = *left[lefts - 1], r0 = *right[0], r1 = *right[rights - 1];
  int begin = box.x0, end = box.x1;
  for (int y = box.y0; y < box.y1; ++y) {
    const auto from0 = l0.row(y), from1 = l1.row(y), to0 = r0.row(y), to1 = r1.row(y);
    const auto after = [&](int x) { return from0.accepts(x) & from1.accepts(x); };
    const auto before = [&](int x) { return to0.accepts(x) & to1.accepts(x); };
    while (begin > box.x0 && after(begin - 1)) --begin;
    while (begin < box.x1 && !after(begin)) ++begin;
    while (end < box.x1 && before(end)) ++end;
    while (end > box.x0 && !before(end - 1)) --end;
    if (begin < end) plot.span(y, begin, end);
  }
}

}  // namespace edgewise::lab
