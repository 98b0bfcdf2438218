// Shared by the tests of truths and coverage methods: float triangles that are hard to decide, and pictures
// together with their truths.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "core/nearest_name.h"
#include "lab/cases/to_stream.h"
#include "lab/coverage/coverage.h"
#include "lab/coverage/cracks.h"
#include "support.h"

namespace edgewise::testing {

inline const lab::CoverageMethod& find_coverage_method(std::string_view name) {
  return find_named("coverage method", name, lab::coverage_methods(),
                    [](const lab::CoverageMethod& m) { return m.info.name; });
}

inline constexpr std::string_view kFloatFamilies[] = {"anywhere", "near-centres", "near-lattice", "denormal",
                                                      "slivers",  "small",        "in-a-row"};

// Triangles in and around a window, with coordinates in 0 … limit_px.
inline std::vector<lab::FloatTriangle> hard_floats(std::string_view family, int count, lab::Window window,
                                                   std::uint64_t seed, float limit_px = 4096.0f) {
  Random random(seed);
  const auto one_ulp_off = [&](float v) {
    const float to = std::numeric_limits<float>::infinity();
    const auto choice = random.below(3);
    return choice == 0 ? v : std::nextafter(v, choice == 1 ? to : -to);
  };
  std::vector<lab::FloatTriangle> triangles(static_cast<std::size_t>(count));
  std::uint32_t id = 1;
  for (auto& [t, payload] : triangles) {
    payload = id++;
    const auto coordinate = [&](int start, int size) {
      const float margin = 0.2f * static_cast<float>(size);
      float v = random.uniform(static_cast<float>(start) - margin, static_cast<float>(start + size) + margin);
      if (family == "near-centres") v = one_ulp_off(std::floor(v) + 0.5f);
      if (family == "near-lattice") v = one_ulp_off(std::floor(v));
      if (family == "denormal") v = random.below(2) ? std::floor(v) : random.uniform(0.0f, 1.0f) * 1e-38f;
      return v;
    };
    const float cx = coordinate(window.x0, window.width), cy = coordinate(window.y0, window.height);
    for (int i = 0; i < 3; ++i) {
      float x = coordinate(window.x0, window.width), y = coordinate(window.y0, window.height);
      if (family == "small") x = cx + random.uniform(-2.0f, 2.0f), y = cy + random.uniform(-2.0f, 2.0f);
      if (family == "slivers" && i == 2) {
        x = t.x_px[0] + random.uniform(-0.02f, 0.02f);
        y = t.y_px[0] + random.uniform(-0.02f, 0.02f);
      }
      if (family == "in-a-row" && i == 2) {  // collinear vertices: only rounding gives an area
        const float along = random.uniform(-0.5f, 1.5f);
        x = t.x_px[0] + along * (t.x_px[1] - t.x_px[0]);
        y = t.y_px[0] + along * (t.y_px[1] - t.y_px[0]);
      }
      t.x_px[i] = std::clamp(x, 0.0f, limit_px);
      t.y_px[i] = std::clamp(y, 0.0f, limit_px);
      t.z01[i] = random.uniform(0.0f, 1.0f);
    }
  }
  return triangles;
}

using lab::as_floats;

// Triangles in both forms, and both truths.
struct Picture {
  Picture(std::vector<lab::FloatTriangle> triangles, lab::Window w)
      : floats(std::move(triangles)),
        grid(lab::snapped(floats)),
        input{floats, grid},
        window(w),
        by_grid(lab::snapped_coverage(input, w, 2)),
        by_floats(lab::float_coverage(input, w, 2)),
        cracks(floats, by_floats) {}
  Picture(const Picture&) = delete;

  std::vector<lab::FloatTriangle> floats;
  std::vector<ScreenTriangle> grid;
  lab::CoverageInput input;
  lab::Window window;
  lab::CoverageTruth by_grid, by_floats;
  lab::CrackJudge cracks;
};

inline const Picture& picture_of(std::string_view name) {
  static std::map<std::string_view, std::unique_ptr<Picture>> pictures;
  auto& slot = pictures[name];
  if (!slot) {
    const lab::CoverageCase& c =
        find_named("coverage case", name, lab::coverage_cases(), &lab::CoverageCase::name);
    slot = std::make_unique<Picture>(c.make(), lab::Window{c.size.width, c.size.height});
  }
  return *slot;
}

inline lab::DrawnRuns drawn_by(const lab::CoverageMethod& method, const Picture& picture) {
  return {method, picture.input, picture.window};
}
inline lab::Cracks cracks_of(const lab::CoverageMethod& method, const Picture& picture) {
  return picture.cracks.find(drawn_by(method, picture), method.promise.snap_bits);
}
inline lab::Cracks cracks_of(std::string_view method, const Picture& picture) {
  return cracks_of(find_coverage_method(method), picture);
}

}  // namespace edgewise::testing
