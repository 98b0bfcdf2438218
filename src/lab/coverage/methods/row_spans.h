// Row by row between the edges on a triangle's left and those on its right, which is all that a row needs
// where each edge accepts the samples on one side of some place. The places move little from row to row, so
// each is looked for from where it was in the row before: as many tests as the box has rows and columns, not
// pixels. The tests are the method's own, and so are the pixels.
#pragma once

namespace edgewise::lab {

struct PixelRows {
  int x0, y0, x1, y1;
};

// An Edge knows on which side the triangle lies, faces_right(); and by row(y) a test, accepts(x), which must
// not go back from true to false along the row for edges that face right, and from false to true for others.
template <class Edge, class Plot>
void fill_between(const Edge (&edges)[3], const PixelRows& box, Plot& plot) {
  // Some edge faces right and some other one left, or there is no area.
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
