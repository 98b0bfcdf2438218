// Streams as screen triangles, pictures of them by every backend, and counts of hits.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "edgewise/frontend.h"
#include "edgewise/scene.h"
#include "lab/cases/backend_comparison.h"
#include "properties/property.h"

namespace edgewise::testing {

// Pixels → sub-units, half to even; computed in double, independently of the front end.
std::int32_t snapped_to_grid(float px);

// Positions by snapped_to_grid(). Unlike the front end's, triangles stay that lie outside the image or have
// no area. Nothing is clipped: coordinates may exceed the guard band.
std::vector<ScreenTriangle> snapped(const TriangleStream& stream, Payload payload);

// A backend that keeps its memory from one case to the next.
struct Painter {
  std::string_view name;
  BackendInfo info;
  std::unique_ptr<lab::BackendCache> made = std::make_unique<lab::BackendCache>();

  Backend& with(const TileOptions& options) const { return made->get(info, options); }
};
std::vector<Painter> painters(std::span<const BackendInfo> infos);

// On one thread: the scalar target, and the best SIMD target.
std::span<const lab::DrawOptions> two_executions();

Framebuffer drawn(const Painter& painter, std::span<const ScreenTriangle> triangles, int width, int height,
                  const lab::DrawOptions& how);

// Compares each painter's picture in each execution with `expected`.
void compare_pictures(Verdict& verdict, const Framebuffer& expected, std::span<const Painter> painters,
                      std::span<const ScreenTriangle> triangles, std::span<const lab::DrawOptions> ways,
                      const std::string& what);

// Every painter draws the oracle's picture, with ids and with colours, in every execution. `painters` must
// outlive the property.
Property like_the_oracles(const std::vector<Painter>& painters, std::vector<lab::DrawOptions> ways);

}  // namespace edgewise::testing
