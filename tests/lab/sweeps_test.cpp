// Checks the sweeps against known points at which methods fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "cli/stability/report.h"
#include "lab/sweeps/sweeps.h"

namespace edgewise::lab {
namespace {

SweepResult swept(std::string_view name) {
  return run_sweep(find_sweep(name), kQuick, 2);
}

// A sweep's results for one method.
struct Found {
  Found(const SweepResult& result, std::string_view method) : result_(result) {
    const auto methods = swept_methods(result.sweep->family);
    const auto at = std::ranges::find_if(methods, [&](const auto& m) { return m.name == method; });
    if (at == methods.end()) throw std::invalid_argument("no method " + std::string(method));
    index_ = static_cast<std::size_t>(at - methods.begin());
  }
  std::optional<double> start() const { return result_.starts_to_fail(index_); }
  const Tally& at(double position) const {
    const auto& positions = result_.sweep->positions;
    const auto found = std::ranges::find(positions, position);
    if (found == positions.end()) throw std::invalid_argument("no position " + std::to_string(position));
    return result_.at[static_cast<std::size_t>(found - positions.begin())].methods[index_];
  }

 private:
  const SweepResult& result_;
  std::size_t index_;
};

std::vector<std::string_view> sweep_names() {
  std::vector<std::string_view> names;
  for (const Sweep& sweep : sweeps()) names.push_back(sweep.name);
  return names;
}

class EverySweep : public ::testing::TestWithParam<std::string_view> {};

TEST_P(EverySweep, HasACurveForEveryMethodAndOneThatFails) {
  const Sweep& sweep = find_sweep(GetParam());
  const SweepResult result = run_sweep(sweep, kQuick, 2);
  ASSERT_EQ(result.at.size(), sweep.positions.size());
  const bool up = sweep.positions.front() < sweep.positions.back();
  EXPECT_TRUE(up ? std::is_sorted(sweep.positions.begin(), sweep.positions.end())
                 : std::is_sorted(sweep.positions.rbegin(), sweep.positions.rend()));
  const auto methods = swept_methods(sweep.family);
  bool some_fail = false;
  for (std::size_t i = 0; i < methods.size(); ++i) some_fail = some_fail || result.starts_to_fail(i);
  EXPECT_TRUE(some_fail);
  for (const Measured& measured : result.at) EXPECT_GE(measured.fewest_trials(), kQuick.trials);
  const bool coverage = sweep.family == Family::coverage;
  for (std::size_t i = 0; coverage && i < sweep.positions.size(); ++i)
    EXPECT_EQ(Found(result, "ours_8").at(sweep.positions[i]), Found(result, "fixed_8").at(sweep.positions[i]))
        << "ours err otherwise than by snapping at " << sweep.positions[i];

  std::istringstream table(tools::stability_table(result));
  std::size_t rows = 0;
  for (std::string line; std::getline(table, line);) {
    EXPECT_LE(line.size(), 80u) << line;
    rows += std::any_of(methods.begin(), methods.end(),
                        [&](const auto& m) { return line.starts_with(std::string(m.name) + ' '); });
  }
  EXPECT_EQ(rows, methods.size());
}

INSTANTIATE_TEST_SUITE_P(Registry, EverySweep, ::testing::ValuesIn(sweep_names()),
                         [](const auto& param) { return std::string(param.param); });

TEST(CoverageSweeps, LegsOf182PixelsAreTheFirstThatWrap32Bits) {
  const SweepResult legs = swept("legs_on_our_grid");
  EXPECT_EQ(Found(legs, "fixed_8_int32").start(), 182);
  EXPECT_EQ(Found(legs, "fixed_8_int32").at(181).errors, 0u);
  EXPECT_EQ(Found(legs, "fixed_4_int32").at(2896), Found(legs, "fixed_4").at(2896));
  EXPECT_GT(Found(legs, "fixed_4_int32").at(2897).rate(), 1.0);
  EXPECT_EQ(Found(legs, "fixed_8").start(), std::nullopt);
  EXPECT_EQ(Found(legs, "double_top_left").start(), std::nullopt);
  EXPECT_EQ(Found(legs, "float_le").start(), 64) << "ties";
}

// The rates are those of another program, for 60 such meshes. With boxes wider by a pixel, it counts 538,000
// per 10^6 at 16384 px.
TEST(CoverageSweeps, EdgeEquationsFailFarFromTheOriginWhereEdgesRelativeToAVertexHold) {
  const Sweep& distance = find_sweep("distance_on_our_grid");
  for (const auto& [px, plain, fused] : {std::tuple{512.0, 380, 354}, {16384.0, 438'816, 343'379}}) {
    const SweepResult all{
        &distance, std::vector<Measured>(distance.positions.size(), measure(distance, px, {450'000, 64}))};
    EXPECT_NEAR(1e6 * Found(all, "float_equation").at(px).rate(), plain, 0.15 * plain);
    EXPECT_NEAR(1e6 * Found(all, "float_equation_fma").at(px).rate(), fused, 0.15 * fused);
    EXPECT_EQ(Found(all, "float_top_left").at(px).errors, 0u);
  }
}

// Rounding moves a vertex along each axis by up to h = 2^-(bits + 1) px, all moves equally likely.
TEST(CoverageSweeps, SnappingErrsOffItsGridOnlyAndAsOftenAsRoundingMovesEdgesAcrossSamples) {
  constexpr std::pair<std::string_view, double> kMethods[] = {{"fixed_4", 1.0 / 32}, {"ours_8", 1.0 / 512}};
  // A row, column or diagonal of samples errs if an edge within h on one side of it is rounded onto it.
  const Sweep& legs = find_sweep("legs");
  const SweepResult all_legs{&legs,
                             std::vector<Measured>(legs.positions.size(), measure(legs, 64, {300'000, 8}))};
  for (const auto& [method, h] : kMethods)
    EXPECT_NEAR(Found(all_legs, method).at(64).rate(), h, 0.2 * h) << method;
  // An edge in any direction moves along the rows or columns by h / 3 to 2 h / 3, in the mean over its
  // length.
  for (const std::string name : {"distance", "aspect", "height"}) {
    EXPECT_EQ(Found(swept(name + "_on_our_grid"), "ours_8").start(), std::nullopt) << name;
    const SweepResult anywhere = run_sweep(find_sweep(name), kFull, 2);
    const auto pooled = [&](std::string_view method) {
      Tally all;
      for (const double position : anywhere.sweep->positions) all += Found(anywhere, method).at(position);
      return all.rate();
    };
    for (const auto& [method, h] : kMethods) {
      EXPECT_GT(pooled(method), h / 3) << name << ", " << method;
      EXPECT_LT(pooled(method), 2 * h / 3) << name << ", " << method;
    }
    EXPECT_LT(pooled("ours_12"), pooled("ours_8") / 8) << name;
    EXPECT_LT(pooled("ours_15"), pooled("ours_8") / 32) << name;
  }
  EXPECT_TRUE(Found(swept("pan"), "ours_8").start());
}

TEST(VisibilitySweeps, FewerBitsFailAtLargerSeparations) {
  for (const auto name : {"separation_at_10", "separation_at_100"}) {
    const SweepResult separation = run_sweep(find_sweep(name), kFull, 2);
    const auto start = [&](std::string_view method) { return Found(separation, method).start().value(); };
    EXPECT_GT(start("unorm16"), 50 * start("unorm24")) << name;
    EXPECT_GT(start("unorm24"), 10 * start("reversed_z")) << name;
    EXPECT_GT(start("unorm24"), 2 * start("contract31")) << name;
    EXPECT_GE(start("float_z"), start("contract31")) << name;
    EXPECT_GT(start("contract31"), start("reversed_z")) << name << ": ours err by up to 34 units";
    EXPECT_EQ(start("submission_order"), separation.sweep->positions.front()) << name;
  }
  // The smallest separable distance z^2 / (near 2^bits) is 1.5 and 0.006.
  const SweepResult separation = swept("separation_at_100");
  EXPECT_NEAR(Found(separation, "unorm16").start().value(), 1.5, 1.0);
  EXPECT_NEAR(Found(separation, "unorm24").start().value(), 0.006, 0.004);
}

TEST(FacingSweeps, SnappingFlipsFacesOneSubUnitThinAndFloatsMuchThinnerOnes) {
  const SweepResult edge_on = swept("edge_on");
  const double snapped = Found(edge_on, "snapped_area").start().value();
  EXPECT_LE(snapped, 1.0 / 128);
  EXPECT_GE(snapped, 1.0 / 1024);
  const Found floats(edge_on, "float_area");
  EXPECT_EQ(floats.at(snapped).errors, 0u);
  EXPECT_EQ(floats.at(snapped / 16).errors, 0u);
  EXPECT_GT(floats.at(edge_on.sweep->positions.back()).errors, 0u);
  EXPECT_EQ(Found(edge_on, "snapped_area_15").at(snapped).errors, 0u);
  EXPECT_LT(Found(edge_on, "snapped_area_15").start().value(), snapped / 16);
}

}  // namespace
}  // namespace edgewise::lab
