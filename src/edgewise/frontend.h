// The front end turns a scene into screen triangles: it transforms, culls, clips, projects, snaps and shades.
// It is the only part that converts floats to fixed point. backend.h says what it does to the process.
//
// Pixel (0, 0) is top left, its centre lies at (0.5, 0.5), and y points down. The smaller depth is nearer.
// The front of a triangle is the side whose vertices appear clockwise (camera.h).
#pragma once

#include "edgewise/cxx20.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "edgewise/execution.h"
#include "edgewise/scene.h"
#include "edgewise/screen_triangle.h"

namespace edgewise {
class TriangleSource;  // internal
}

#pragma GCC visibility push(default)
namespace edgewise {

// Which triangles to drop for their facing.
enum class Cull { none, back, front, both };
std::span<const Cull> cull_modes();   // all four
std::string_view name_of(Cull cull);  // "none", "back", "front", "both"

enum class Payload {
  colour,  // 0xAABBGGRR
  // FrontendOptions::first_id plus the index of the source triangle in submission order. All pieces of a
  // clipped triangle have the same id. The triangles of a face have different ids.
  id
};

// The outcome of a submitted triangle, in the order of the steps. The state of a clipped triangle is that of
// its piece that got furthest.
enum class TriangleState : std::uint8_t {
  outside_with_mesh,  // dropped: its mesh or cluster lies beyond one side of the view volume
  not_finite,         // dropped: a vertex is NaN or infinite, before or after the transform
  outside,            // dropped: beyond one side of the view volume, or nothing left after clipping
  not_in_front,       // dropped: a vertex still has w ≤ 0 after clipping
  zero_area,          // dropped: no area after snapping
  culled,             // dropped for its facing
  active,             // returned unclipped
  clipped             // returned clipped
};

inline constexpr int kMinSubpixelBits = 4, kMaxSubpixelBits = 15;

struct FrontendOptions {
  int width = 1920, height = 1080;  // px, 1 … contract::kMaxImageSide
  Cull cull = Cull::back;           // the front is clockwise on the y-down screen
  bool shade = true;                // scenes only: multiplies each colour by max(n·l, 0.15)
  Payload payload = Payload::colour;
  // The id of the first triangle. A draw over others sets it to the number of triangles that they submitted:
  // then two draws equal one of both, ids included.
  std::uint32_t first_id = 0;
  // x and y of vertices are rounded to 2^-subpixel_bits px (rule 2): kMinSubpixelBits … kMaxSubpixelBits.
  int subpixel_bits = 8;
  // For measurements: keeps each triangle's vertices as they were before snapping, and does not drop
  // triangles that snapping leaves without area. Slower.
  bool keep_unsnapped = false;
  bool keep_states = false;  // records the TriangleState of each triangle; slower, same triangles
};

// The vertices of a screen triangle before snapping: x and y in pixels, depth in [0, 1]. With more than 8
// subpixel bits, and for new vertices, they are doubles rounded to float. A scene's z01 is the float z / w
// that most renderers use. ScreenTriangle::z is finer: it does not come from z01 (rule 6).
struct UnsnappedTriangle {
  float x_px[3], y_px[3], z01[3];
};

// Counts of one call of Frontend::run() or draw().
//   triangles = whole_mesh + not_finite + outside + not_in_front + (triangles that are split into pieces)
//   pieces    = culled + zero_area + emitted
// An unclipped triangle is one piece.
struct FrontendStats {
  std::uint64_t meshes = 0;         // instances submitted
  std::uint64_t meshes_culled = 0;  // instances out of view: as a whole, or cluster by cluster
  std::uint64_t triangles = 0;      // submitted
  std::uint64_t whole_mesh = 0;     // dropped with their instance or cluster
  std::uint64_t not_finite = 0;     // dropped: a vertex is NaN or infinite, before or after the transform
  std::uint64_t outside = 0;        // dropped: beyond a side of the view volume, or nothing left by clipping
  std::uint64_t not_in_front = 0;   // dropped: a vertex still has w ≤ 0 after clipping
  std::uint64_t clipped = 0;        // sent to the clipper; it may still drop them (outside, not_in_front)
  std::uint64_t clipped_near = 0;   // of those: crossed the near plane
  std::uint64_t clipped_far = 0;    // of those: crossed the far plane
  std::uint64_t clipped_guard = 0;  // of those: crossed a side of the guard band
  std::uint64_t pieces = 0;         // triangles after clipping
  std::uint64_t culled = 0;         // pieces dropped for their facing
  std::uint64_t zero_area = 0;      // pieces dropped: no area after snapping
  std::uint64_t emitted = 0;        // pieces returned

  FrontendStats& operator+=(const FrontendStats& other);
  bool operator==(const FrontendStats&) const = default;
};

// A front end keeps its memory between frames and allocates only in the first frame of a kind. It keeps
// - 9 bytes per instance,
// - after run(), 40 bytes per visible triangle, and address space for as many per submitted one,
// - less than 8 MB per thread,
// - with keep_unsnapped, 36 bytes more per visible triangle and less than 6 MB more per thread,
// - with keep_states, 1 byte per submitted triangle.
// Two threads must not use one object at once.
class Frontend {
 public:
  Frontend();
  ~Frontend();
  Frontend(Frontend&&) noexcept;
  Frontend& operator=(Frontend&&) noexcept;

  // Returns the visible triangles in submission order. They lie in this object's memory and are valid until
  // the next run() or draw() with this object, or its destruction. Backend::draw() throws if the frame is not
  // options.width x options.height pixels. Keeps no reference to its arguments. Several front ends may run
  // one drawable at once.
  //
  // Throws std::bad_alloc if memory runs out, and std::invalid_argument for
  // - a camera, image size or number of subpixel bits out of range, or matrices that camera.h excludes,
  // - a stream with triangles in float and in double,
  // - an instance whose mesh index the scene lacks, or whose matrix is not finite and affine,
  // - a mesh without one colour per triangle, or whose flags are neither empty nor one per triangle, or whose
  //   first triangle has kSameFace, or whose normals are neither empty nor one per triangle,
  // - a vertex index that the mesh lacks, in a triangle whose instance and cluster are in view,
  // - a mesh whose clusters are not one per kClusterTriangles triangles, or whose origin is not finite,
  // - more than kMaxTriangles triangles (before memory is allocated for them), or ids that reach it,
  // - an invalid execution.
  // The object may be used again after an exception. Boxes of clusters are not checked: if positions or
  // triangles have changed since clusters_of(), triangles may be missing.
  ScreenTriangles run(const Drawable& drawable, const FrontendOptions& options,
                      const Execution& execution = {});
  // Counts of the last call of run(), or of draw().
  const FrontendStats& stats() const;
  // One entry per triangle that run() returned, if keep_unsnapped was set. Empty otherwise and after an
  // exception. Valid until the next call of run() or draw().
  std::span<const UnsnappedTriangle> unsnapped() const;
  // One entry per submitted triangle, in order, if keep_states was set. Empty otherwise and after an
  // exception. Valid until the next call of run() or draw().
  std::span<const TriangleState> states() const;

 private:
  friend struct DrawAccess;  // internal
  // Returns a source for up to execution.threads workers, or null if run() must be called. Throws what that
  // throws. The source refers to `drawable`, and is valid until end_source(), which completes stats().
  TriangleSource* start_source(const Drawable& drawable, const FrontendOptions& options,
                               const Execution& execution);
  void end_source();

  struct [[gnu::visibility("hidden")]] State;
  std::unique_ptr<State> state_;
};

}  // namespace edgewise
#pragma GCC visibility pop
