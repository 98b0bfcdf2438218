// Every coverage method draws the same pixels and depths with every SIMD target.
#include <gtest/gtest.h>

#include "lab/coverage/coverage.h"
#include "lab/coverage_support.h"
#include "scene/streams.h"

namespace edgewise::lab {
namespace {

using testing::find_coverage_method;
using testing::hard_floats;

class EveryCoverageForm : public ::testing::TestWithParam<std::string_view> {
 protected:
  const CoverageMethod& method_ = find_coverage_method(GetParam());

  void expect_same(const std::vector<FloatTriangle>& floats, Size size, const std::string& what) {
    const std::vector<ScreenTriangle> grid =
        method_.contract_depth ? snapped(floats) : std::vector<ScreenTriangle>{};
    const CoverageInput input{floats, grid};
    Canvas plain(size.width, size.height), lanes(size.width, size.height);
    method_.draw(input, plain, {.target = SimdTarget::scalar});
    for (const SimdTarget target : supported_targets()) {
      method_.draw(input, lanes, {.target = target});
      EXPECT_TRUE(same_picture(method_, plain, lanes)) << what << ", " << name_of(target);
    }
  }
};

std::string text_of(Size size) {
  return " in " + std::to_string(size.width) + "x" + std::to_string(size.height);
}

// Widths below, at and above a vector's, and images narrower than one.
constexpr Size kSizes[] = {{1, 1}, {5, 40}, {16, 16}, {17, 9}, {90, 70}, {301, 200}};

TEST_P(EveryCoverageForm, DrawsHardTriangles) {
  for (const Size size : kSizes)
    for (const auto family : testing::kFloatFamilies)
      expect_same(hard_floats(family, 150, {size.width, size.height}, 11), size,
                  std::string(family) + text_of(size));
}

TEST_P(EveryCoverageForm, DrawsMeshesOfSmallAndLargeCells) {
  constexpr Size kSize{700, 300};
  for (const double cell_px : {3.0, 12.0, 33.0, 150.0, 600.0})
    expect_same(float_triangles(jittered_grid({.width = kSize.width, .height = kSize.height}, cell_px, 5)),
                kSize, std::to_string(cell_px) + " px");
}

// Boxes far larger than the image, in which the edge values of 32-bit methods wrap.
TEST_P(EveryCoverageForm, DrawsTrianglesThatReachFarOutOfTheImage) {
  constexpr Size kSize{640, 90};
  Random random(17);
  for (const float reach : {200.0f, 3000.0f, 15000.0f}) {
    std::vector<FloatTriangle> triangles(200);
    std::uint32_t id = 1;
    for (auto& [t, payload] : triangles) {
      payload = id++;
      for (int i = 0; i < 3; ++i) {
        t.x_px[i] = random.uniform(-reach, 640.0f + reach);
        t.y_px[i] = random.uniform(-reach, 90.0f + reach);
        t.z01[i] = random.uniform(0.0f, 1.0f);
      }
    }
    expect_same(triangles, kSize, std::to_string(reach) + " px outside");
  }
}

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for (const auto& method : coverage_methods()) names.push_back(method.info.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryCoverageForm, ::testing::ValuesIn(method_names()),
                         [](const auto& param) { return testing::test_name(param); });

TEST(CoverageForms, MethodsWithoutSimdFormSayWhy) {
  for (const CoverageMethod& method : coverage_methods())
    EXPECT_EQ(method.simd, method.simd_note.empty()) << method.info.name;
}

}  // namespace
}  // namespace edgewise::lab
