// Coverage methods: which pixels a triangle covers. Our backends are scored like the methods of other
// programs.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/framebuffer.h"
#include "lab/method.h"
#include "lab/truth/truth.h"

namespace edgewise::lab {

// One picture's triangles before and after snapping: unsnapped for the methods of this family, which snap
// them if they need to, and snapped for the backends. Coordinates are finite and below 2^16 px; snapped ones,
// relative to the window's corner, lie in the guard band (rule 3).
struct CoverageInput {
  std::span<const FloatTriangle> floats;
  std::span<const ScreenTriangle> snapped;
};

// Memory that begins on a cache line, as rows of a Framebuffer do.
template <typename T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};
  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kLine)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, kLine); }
  bool operator==(const LineAllocator&) const = default;
};

// The draw target of a coverage method, with the backends' memory between draws. Use one per thread.
class Canvas {
 public:
  Canvas(int width, int height);
  Window window() const { return {frame.width(), frame.height()}; }
  // Made when it is first used.
  Backend& backend(std::string_view name, const std::function<std::unique_ptr<Backend>()>& make);

  Framebuffer frame;                               // all methods write payloads; backends also write depths
  std::vector<float, LineAllocator<float>> depth;  // of all other methods; rows are frame.stride() apart

 private:
  std::map<std::string_view, std::unique_ptr<Backend>> backends_;
};

// A method's promise in numbers: upper bounds of its errors against the float truth.
struct CoveragePromise {
  // The sample of every wrong pixel is at most this far from the line of one of the triangle's edges and from
  // its bounding box, for coordinates in 0 … 4096 px and boxes of at most max_side_px per side.
  double reach_px;
  int max_side_px = 4096;
  // For meshes that fill the image, whose neighbours share bit-identical vertices, and whose triangles are
  // neither slivers nor flipped by snapping:
  bool no_gaps = false, no_double_hits = false;
  bool if_on_grid = false;  // the two above hold only if all vertices lie on the 1/256 px grid
  // The subpixel bits to which it rounds vertices, half to even; none: it uses them as they are.
  std::optional<int> snap_bits = {};
};
inline constexpr int kMostSnapBits = 16;

struct CoverageMethod {
  MethodInfo info;
  CoveragePromise promise;
  // The timed part: clear, coverage, depth test, colour. All methods but the backends use the same float
  // depth test. All SIMD targets draw the same pixels and depths.
  std::function<void(const CoverageInput&, Canvas&, const Execution&)> draw;
  // Appends, in any order, each triangle's pixels before the depth test, found by the same code as in
  // draw(). Peers have none.
  std::function<void(const CoverageInput&, Window, std::vector<Run>&)> runs;
  bool threaded = false;        // draw uses the execution's threads
  bool contract_depth = false;  // draw writes the frame's depths, in units of rule 6
  bool backend = false;         // of the library: takes snapped positions of any subpixel bits
  bool fills = true;            // false for backends that do not fill triangles; these are not scored
  bool simd = false;            // draw uses the execution's SIMD target
  bool one_thread = false;      // all functions must run on one thread: an OpenGL context belongs to a thread
};

// The methods of methods.cpp.
std::vector<CoverageMethod> coverage_table();
// The backends first, then coverage_table().
std::span<const CoverageMethod> coverage_methods();
// Whether two draws of a method gave the same payloads and the same depths, bit for bit.
bool same_picture(const CoverageMethod& method, const Canvas& a, const Canvas& b);

// All methods that the viewer can draw: the coverage methods, then wireframe(), then compositions().
std::span<const CoverageMethod> drawing_methods();
// Throws std::invalid_argument for an unknown name; the message suggests the nearest known one.
const CoverageMethod& find_drawing_method(std::string_view name);

// Appends the runs of one row of a picture whose pixels hold triangle indices, or kNoTriangle. Its first
// pixel is at (x0, y).
void append_runs(std::span<const std::uint32_t> row, int y, int x0, std::vector<Run>& runs);

// Snaps as the front end does (rule 2). Does not clamp to the guard band, which is relative to a window's
// corner; |x|, |y| < 2^16 px.
std::vector<ScreenTriangle> snapped(std::span<const FloatTriangle> triangles, int subpixel_bits = 8);
// Joins the two lists of a front end. Throws std::invalid_argument if they differ in size: it must run with
// keep_unsnapped.
std::vector<FloatTriangle> unsnapped(std::span<const ScreenTriangle> triangles,
                                     std::span<const UnsnappedTriangle> at);

class SceneTruth;  // lab/projection/truth.h

// A picture's triangles as coverage methods take them.
struct CoverageScene {
  Size size;
  std::vector<FloatTriangle> floats;
  std::vector<ScreenTriangle> snapped;
  int subpixel_bits = 8;  // of these
  // Of a scene with a camera, from whose vertices a front end made these triangles: its truth, and of each of
  // them the triangle in it. Otherwise null and empty: the floats themselves are the source.
  std::shared_ptr<const SceneTruth> truth = nullptr;
  std::vector<std::uint32_t> sources = {};

  CoverageInput input() const { return {floats, snapped}; }
  Window window() const { return {size.width, size.height}; }
  // The bits to which a method rounds positions on this scene: see CoveragePromise::snap_bits.
  std::optional<int> snap_bits(const CoverageMethod& method) const {
    return method.backend ? subpixel_bits : method.promise.snap_bits;
  }
  // Drops the triangles for whose index keep() is false. Before there are `sources`.
  void keep_if(const std::function<bool(std::size_t)>& keep);
};

// The front end's triangles before and after snapping, and the truth that they are judged by. A stream in
// double is rounded to floats. Culls by the exact facing of their sources, so that all methods get the same
// triangles. A scene's payloads become ids.
CoverageScene coverage_scene(const Drawable& drawable, FrontendOptions options);
// The same with the front end's floats as the source.
CoverageScene coverage_scene_of_floats(const Drawable& drawable, FrontendOptions options);

// Small scenes on which coverage methods fail, as unsnapped screen triangles.
struct CoverageCase {
  std::string_view name;
  std::string_view summary;  // one line
  Size size;
  std::vector<FloatTriangle> (*make)();
};

std::span<const CoverageCase> coverage_cases();

// Converts a stream's triangles without a front end: nothing is clipped, culled or snapped.
std::vector<FloatTriangle> float_triangles(const TriangleStream& stream);

}  // namespace edgewise::lab
