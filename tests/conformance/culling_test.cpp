// Culling: every mode with every winding, for triangle lists, and for one tiny triangle per pixel with
// alternating windings. Exact areas decide which triangles remain, winding numbers what they cover.
#include <glm/glm.hpp>

#include "conformance/pipeline.h"
#include "core/random.h"

namespace edgewise::conformance {
namespace {

class ConformanceCulling : public Conformance {
 protected:
  static bool is_kept(Cull cull, Product twice_area) {
    return twice_area > 0 ? cull == Cull::none || cull == Cull::back
                          : twice_area < 0 && (cull == Cull::none || cull == Cull::front);
  }

  // Checks every mode. All depths are equal, so the first of overlapping triangles is visible.
  void expect_culled(const TriangleStream& stream, View view, const std::string& what) {
    for (const Cull cull : cull_modes()) {
      view.cull = cull;
      std::vector visible(view.pixels(), kNoTriangle);
      for (std::uint32_t id = 0; id < stream.triangles.size(); ++id) {
        const auto positions = snapped(stream.triangles[id].vertex, view.subpixel_bits);
        if (!is_kept(cull, area(positions))) continue;
        auto visible_it = visible.begin();
        for (int y = 0; y < view.height; ++y)
          for (int x = 0; x < view.width; ++x, ++visible_it)
            if (*visible_it == kNoTriangle && winding(positions, x, y) != 0) *visible_it = id;
      }
      expect_visible_triangles(stream, view, visible, what + ", cull " + std::string(name_of(cull)));
    }
  }

  // Checks the list, and the list with every triangle reversed.
  void expect_culled_both_ways(const TriangleStream& stream, const std::string& what) {
    for (const int bits : kBits) {
      expect_culled(stream, {.subpixel_bits = bits}, what + ", bits " + std::to_string(bits));
      expect_culled(reversed(stream), {.subpixel_bits = bits},
                    what + " reversed, bits " + std::to_string(bits));
    }
  }
};

TEST_F(ConformanceCulling, ListsKeepTheFacesThatTheModeSelects) {
  Random random(1);
  for (int trial = 0; trial < 4; ++trial) expect_culled_both_ways(scattered(random), "list");
}

TEST_F(ConformanceCulling, TinyTrianglesOfAlternatingWindingsFollowTheMode) {
  for (const int bits : {8, 12, kMaxSubpixelBits})
    for (const TinyShape& shape : kTinyShapes) {
      const TriangleStream stream = tiny_triangles(shape, bits);
      const View view{stream.width, stream.height};
      for (const Cull cull : cull_modes()) {
        std::vector<std::uint32_t> visible;
        for (int y = 0; y < view.height; ++y)
          for (int x = 0; x < view.width; ++x)
            visible.push_back(is_kept(cull, (x + y) % 2 == 0 ? 1 : -1)
                                  ? static_cast<std::uint32_t>(y * view.width + x)
                                  : kNoTriangle);
        expect_visible_triangles(stream, {view.width, view.height, cull, bits}, visible,
                                 std::string(name_of(cull)) + ", bits " + std::to_string(bits));
      }
    }
}

}  // namespace
}  // namespace edgewise::conformance
