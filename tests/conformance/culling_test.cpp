// Culling: every mode with every winding, for triangle lists, and for one tiny triangle per pixel with
// alternating windings. Exact areas decide which triangles remain, winding numbers what they cover.
#include <array>
#include <glm/glm.hpp>

#include "conformance/pipeline.h"
#include "conformance/streams.h"
#include "core/random.h"

namespace edgewise::conformance {
namespace {

class ConformanceCulling : public Conformance {
 protected:
  static bool is_kept(Cull cull, std::int64_t twice_area) {
    return twice_area > 0 ? cull == Cull::none || cull == Cull::back
                          : twice_area < 0 && (cull == Cull::none || cull == Cull::front);
  }

  // Checks every mode. All depths are equal, so the first of overlapping triangles is visible.
  void expect_culled(const TriangleStream& stream, View view, const std::string& what) {
    for (const Cull cull : cull_modes()) {
      view.cull = cull;
      std::vector<std::uint32_t> visible(
          static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height), kNoTriangle);
      for (std::uint32_t id = 0; id < stream.triangles.size(); ++id) {
        const auto positions = snapped(stream.triangles[id].vertex);
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
    expect_culled(stream, {}, what);
    expect_culled(reversed(stream), {}, what + " reversed");
  }
};

TEST_F(ConformanceCulling, ListsKeepTheFacesThatTheModeSelects) {
  Random random(1);
  for (int trial = 0; trial < 4; ++trial) expect_culled_both_ways(scattered(random), "list");
}

// The same through a camera: the front end culls meshes. The snapped positions without culling give the
// expected facing.
TEST_F(ConformanceCulling, MeshesKeepTheFacesThatTheModeSelects) {
  Random random(4);
  for (const float mirror : {1.0f, -1.0f}) {
    Scene scene;
    Mesh mesh;
    for (unsigned i = 0; i < 90; ++i) {
      mesh.positions.emplace_back(random.uniform(-3.0f, 3.0f), random.uniform(-3.0f, 3.0f),
                                  -random.uniform(3.0f, 9.0f));
      if (i % 3 == 2) mesh.triangles.emplace_back(i - 2, i - 1, i);
    }
    mesh.colours.assign(mesh.triangles.size(), 0);
    scene.meshes.push_back(mesh);
    scene.instances.push_back({.scale = {mirror, 1, 1}});
    with_each("mesh", [&](Pipeline& pipeline) {
      const auto span = pipeline.triangles(scene, {});
      const std::vector<ScreenTriangle> all(span.begin(), span.end());
      ASSERT_GT(all.size(), 20u);
      for (const Cull cull : cull_modes()) {
        std::vector<std::uint32_t> expected, ids;
        for (const ScreenTriangle& t : all) {
          const std::array positions{SubPosition{t.x_q15[0] / 128, t.y_q15[0] / 128},
                                     SubPosition{t.x_q15[1] / 128, t.y_q15[1] / 128},
                                     SubPosition{t.x_q15[2] / 128, t.y_q15[2] / 128}};
          if (is_kept(cull, area(positions))) expected.push_back(t.payload);
        }
        for (const ScreenTriangle& t : pipeline.triangles(scene, {.cull = cull})) ids.push_back(t.payload);
        ASSERT_EQ(ids, expected) << name_of(cull);
      }
    });
  }
}

TEST_F(ConformanceCulling, TinyTrianglesOfAlternatingWindingsFollowTheMode) {
  for (const TinyShape& shape : kTinyShapes) {
    const TriangleStream stream = tiny_triangles(shape);
    const View view{stream.width, stream.height};
    for (const Cull cull : cull_modes()) {
      std::vector<std::uint32_t> visible;
      for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
          visible.push_back(is_kept(cull, (x + y) % 2 == 0 ? 1 : -1)
                                ? static_cast<std::uint32_t>(y * view.width + x)
                                : kNoTriangle);
      expect_visible_triangles(stream, {view.width, view.height, cull}, visible, std::string(name_of(cull)));
    }
  }
}

}  // namespace
}  // namespace edgewise::conformance
