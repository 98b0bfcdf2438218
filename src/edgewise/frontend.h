// Scene → screen triangles: transform, cull, clip, project, snap, shade. The only place where floats become
// fixed point.
#pragma once

#include "edgewise/cxx20.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "edgewise/scene.h"
#include "edgewise/screen_triangle.h"
#include "edgewise/simd_target.h"

namespace edgewise {

enum class Cull { none, back, front, both };
std::span<const Cull> cull_modes();
std::string_view name_of(Cull cull);  // "none", "back", "front", "both"

enum class Payload {
  colour,  // 0xAABBGGRR
  // Index of the source triangle in submission order; the pieces of a clipped triangle share one. A face of
  // four vertices is two triangles (Mesh::face_of).
  id
};

// What became of a submitted triangle; of one that was cut, of all its pieces together. The later in this
// list, the further it came.
enum class TriangleState : std::uint8_t {
  outside_with_mesh,  // its mesh lies beyond one side of the view volume as a whole
  not_finite,         // a vertex is NaN or infinite, or became so
  outside,            // beyond one side of the view volume, or nothing is left after clipping
  not_in_front,       // w ≤ 0 is left after clipping
  zero_area,          // no area after snapping
  culled,             // for its facing
  active,             // handed on whole
  clipped             // handed on, cut
};

struct FrontendOptions {
  int width = 1920, height = 1080;  // px, 1 … contract::kMaxImageSide
  Cull cull = Cull::back;           // front is clockwise on the y-down screen
  bool shade = true;                // scenes only: colour times max(n·l, 0.15)
  Payload payload = Payload::colour;
  int threads = 1;  // 1 … kMaxThreads
  // For judging: remember where each triangle lay before it was snapped, and keep those that lost their area
  // by it.
  bool keep_unsnapped = false;
  bool keep_states = false;  // remember what became of each triangle; slower, and the same triangles
  SimdTarget target = SimdTarget::best;
};

// A screen triangle's vertices as they were before snapping: pixels, and depth in [0, 1].
struct UnsnappedTriangle {
  float x_px[3], y_px[3], z01[3];
};

// Where each triangle went. `triangles` = whole_mesh + not_finite + outside + not_in_front + (those that went
// on); those that went on become `pieces`, and pieces = culled + zero_area + emitted.
struct FrontendStats {
  std::uint64_t meshes = 0;         // instances submitted
  std::uint64_t meshes_culled = 0;  // instances outside the frustum as a whole
  std::uint64_t triangles = 0;      // submitted
  std::uint64_t whole_mesh = 0;     // dropped with their mesh
  std::uint64_t not_finite = 0;     // dropped: a vertex is NaN or infinite, or became so
  std::uint64_t outside = 0;        // dropped: beyond a side of the view volume, or nothing left by clipping
  std::uint64_t not_in_front = 0;   // dropped: w ≤ 0 is left after clipping
  std::uint64_t clipped = 0;        // reached beyond one or more of the following; some of them end above
  std::uint64_t clipped_near = 0;   // the near plane
  std::uint64_t clipped_far = 0;    // the far plane
  std::uint64_t clipped_guard = 0;  // the guard band
  std::uint64_t pieces = 0;         // triangles after clipping
  std::uint64_t culled = 0;         // dropped for their facing
  std::uint64_t zero_area = 0;      // dropped: no area after snapping
  std::uint64_t emitted = 0;

  FrontendStats& operator+=(const FrontendStats& other);
};

// Keeps its memory between frames, and allocates none after the first of a kind: 16 bytes a vertex of the
// largest mesh, 3 MB at most for a group of small ones; 40 a visible triangle, and less than 1 MB a thread;
// with keep_unsnapped 36 a visible triangle more, and as much a thread again; with keep_states 1 a submitted
// triangle. One object must not work on two threads at once.
class Frontend {
 public:
  Frontend();
  ~Frontend();
  Frontend(Frontend&&) noexcept;
  Frontend& operator=(Frontend&&) noexcept;

  // The visible triangles in submission order, in this object's memory: valid until the next call, or until
  // the object goes. Backend::draw() refuses them for a frame of another size than options.width x
  // options.height. Neither argument is kept, and a drawable may be run by several front ends at once.
  // Throws std::invalid_argument for a camera, a size or a thread count out of range, an instance that names
  // a mesh the scene lacks, a mesh without a colour for each triangle, more than kMaxTriangles (before any
  // memory is taken for them), a triangle of a mesh in view that names a vertex its mesh lacks, or a SIMD
  // target that this machine cannot run; std::bad_alloc for lack of memory. It may be called again after
  // either.
  ScreenTriangles run(const Drawable& drawable, const FrontendOptions& options);
  // Of the last call of run().
  const FrontendStats& stats() const;
  // One for each triangle that run() returned, if keep_unsnapped was set; else none, as when it threw.
  std::span<const UnsnappedTriangle> unsnapped() const;
  // One for each triangle that was submitted, in order, if keep_states was set; else none, as when it threw.
  std::span<const TriangleState> states() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace edgewise
