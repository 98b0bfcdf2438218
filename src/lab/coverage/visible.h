// Scores a coverage method's whole picture: the visible triangle of each pixel. Coverage alone does not
// determine it: a lost pixel of an occluded triangle is invisible, and a depth plane evaluated in
// floats may show the wrong triangle.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/coverage/coverage.h"
#include "lab/coverage/cracks.h"

namespace edgewise::lab {

struct VisibleTriangleScore {
  // Pixels that show another triangle than the truth does, or only one of both shows none; against the
  // snapped positions, and against the source (CoverageScene::truth).
  std::uint64_t wrong_snapped = 0, wrong_source = 0;
  // Pixels of wrong_source where something shows through: neither triangle of the two is a neighbour of the
  // other, which shares a vertex with it (see touch()), or only one of both is none.
  std::uint64_t wrong_surface = 0;
  // Background pixels between two pixels, left and right or above and below, that both show a triangle which
  // shares an edge. The exact picture has some, too: silhouettes that nearly meet, and seams whose sides lie
  // too far apart to be one edge (cracks.h).
  std::uint64_t slits = 0;
  // For exact methods that write contract depths: wrong_snapped pixels that the depth error of rule 6 does
  // not explain. The drawn triangle does not cover them, or lies farther behind the visible one than both
  // errors together.
  std::uint64_t unexplained = 0;

  bool operator==(const VisibleTriangleScore&) const = default;
};

// Holds a picture's exact visible triangles by both truths, and scores methods against them.
class VisibleTriangleJudge {
 public:
  VisibleTriangleJudge(CoverageScene scene, const Surface& surface, int threads);
  VisibleTriangleJudge(const VisibleTriangleJudge&) = delete;
  VisibleTriangleScore score(const CoverageMethod& method) const;
  std::uint64_t slits() const;  // of the source

 private:
  // Whether the depth error of rule 6 may show this triangle of the scene instead of the visible one.
  bool explains(std::uint32_t drawn, int x, int y) const;

  // The triangle of the source that triangle `i` of the scene comes from.
  std::uint32_t source(std::uint32_t i) const { return scene_.truth ? scene_.sources[i] : i; }

  CoverageScene scene_;            // payloads number the triangles from 1
  std::vector<bool> shares_edge_;  // by triangle of the scene
  VisibleTriangles by_grid_;
  FloatSource floats_;
  const SourceTruth& source_;
  VisibleTriangles by_source_;
};

}  // namespace edgewise::lab
