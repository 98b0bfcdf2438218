// No function of libm decides a pixel or a fact: with one whose results are wrong (tests/wrong_libm.cpp), the
// program writes the same bytes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "edgewise/builtin.h"
#include "run_program.h"

namespace edgewise::tools {
namespace {

void expect_same(const std::string& arguments) {
  const auto right = testing::run_program(EDGEWISE_PROGRAM, arguments);
  ASSERT_EQ(right.status, 0) << right.err;
  setenv("LD_PRELOAD", EDGEWISE_WRONG_LIBM, 1);
  const auto wrong = testing::run_program(EDGEWISE_PROGRAM, arguments);
  unsetenv("LD_PRELOAD");
  EXPECT_EQ(wrong.status, 0) << wrong.err;
  EXPECT_EQ(wrong.err.find("cannot be preloaded"), std::string::npos);
  EXPECT_TRUE(wrong.out == right.out) << arguments;
}

TEST(Libm, DecidesNoPixel) {
  for (const SceneInfo& scene : builtin_scenes()) {
    const std::string render = "render " + std::string(scene.name) + " -o - --size 320x180 ";
    expect_same(render + "--format pfm");
    if (!scene.stream) expect_same(render + "--format ppm --time 0.7");
  }
  expect_same("render cubes -o - --format pfm --size 320x180 --yaw 20 --pitch -11 --fov 77");
  expect_same("demo p5js-clipping -o - --format ppm --size 320x180");
  expect_same("view cubes -o - --format ppm --size 320x180 --keys 'bbb<right><up>'");
}

TEST(Libm, DecidesNoFact) {
  expect_same("needs cubes --orbit 3 --size 160x90 --json");
  expect_same("portable cubes --size 320x180 --json");
  expect_same("stability cycle vertex_w tilt_perspective --quick --json -");
  expect_same("accuracy --family coverage drtk_quad cube --quick --json -");
  expect_same("accuracy --family visibility bars_in_a_cycle slivers cubes --quick --json -");
  expect_same("accuracy --family facing polygons tilted_faces --quick --json -");
  expect_same("accuracy --family clipping --quick --json -");
}

}  // namespace
}  // namespace edgewise::tools
