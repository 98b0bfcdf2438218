// A test of each backend and of wireframe(): what it draws, under every execution, against a brute-force
// oracle.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <string_view>

#include "lab/cases/backend_comparison.h"
#include "lab/truth/oracle.h"
#include "support.h"

namespace edgewise::testing {

class EveryBackend : public ::testing::TestWithParam<std::string_view> {
 protected:
  const BackendInfo& info_ = find_drawer(GetParam());
  const bool fills_ = &info_ != &wireframe();
  lab::BackendCache backends_;
  Backend* const backend_ = &backends_.get(info_, {});

  Framebuffer oracle(std::span<const ScreenTriangle> triangles, int width, int height) const {
    Framebuffer expected(width, height);
    (fills_ ? lab::draw_oracle : lab::draw_edge_oracle)(triangles, expected, kBackground);
    return expected;
  }
  void expect_oracle(std::span<const ScreenTriangle> triangles, int width, int height,
                     const std::string& what) {
    const Framebuffer expected = oracle(triangles, width, height);
    Framebuffer actual(width, height);
    for (const auto& how : executions()) {
      lab::poison(
          actual);  // otherwise pixels that a draw omits would still be correct from the previous draw
      backends_.get(info_, how.tiles).draw(triangles, actual.view(), {kBackground}, how.execution);
      expect_same(expected, actual, what + ", " + describe(how));
    }
  }
};

}  // namespace edgewise::testing
