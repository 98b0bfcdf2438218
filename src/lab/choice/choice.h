// The chart for choosing a method: in a few moving scenes, the wrong pixels of whole frames, from the user's
// vertices to the picture. The benchmark times the first of these frames.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lab/coverage/coverage.h"
#include "lab/coverage/cracks.h"

namespace edgewise::lab {

struct ChoiceScene {
  std::string_view name, summary;
  Size size;
  int frames;
  std::function<Drawable(int frame)> make;
};
// `quick`: smaller pictures, fewer frames.
std::vector<ChoiceScene> choice_scenes(bool quick);

// A coverage method behind our front end.
struct ChoiceMethod {
  std::string name;
  const CoverageMethod* method;
  int subpixel_bits;  // of the front end's positions; only backends use them
};
// Those of `methods` that the chart shows; `tiled` with several subpixel bits.
std::vector<ChoiceMethod> choice_methods(std::span<const CoverageMethod* const> methods);

// Draws whole frames of one size. Backends draw by edgewise::draw(). Other methods get the floats that the
// front end rounds to 8 bits, and the facing that it decides by the rounded ones.
class FrameDrawer {
 public:
  explicit FrameDrawer(Size size) : canvas_(size.width, size.height) {}
  // Payload::id numbers the drawable's triangles from 1; the background is 0.
  void draw(const Drawable& drawable, const ChoiceMethod& method, Payload payload,
            const Execution& execution = {});
  // Repeats the last draw() of this drawable, to be timed. The front end runs without keeping floats, which
  // needs scalar code; then the method, unless it is a backend, draws the floats that a draw() has kept.
  void redraw(const Drawable& drawable, const ChoiceMethod& method, Payload payload);
  const Canvas& canvas() const { return canvas_; }

 private:
  FrontendOptions frontend_options(const Drawable& drawable, const ChoiceMethod& method,
                                   Payload payload) const;

  Canvas canvas_;
  Frontend frontend_;
  std::vector<FloatTriangle> floats_;
  std::vector<ScreenTriangle> snapped_;
};

struct ChoiceCounts {
  std::uint64_t wrong = 0;  // pixels that show another triangle than the exact picture
  // Of these, the ones inside a surface: all nine exact pixels around show the same triangle or one that
  // touches it, and what is drawn touches none of these.
  std::uint64_t holes = 0;
};

// Holds a frame's exact picture: of a scene's own vertices, or of a stream's floats.
class ChoiceJudge {
 public:
  ChoiceJudge(const Drawable& drawable, Size size, int threads);
  ChoiceCounts count(const Framebuffer& drawn) const;  // with Payload::id
  // Of the exact picture of the floats that our front end makes of a scene's vertices; none of a stream.
  std::optional<ChoiceCounts> of_float_projection(int threads) const;

 private:
  template <typename Shown>
  ChoiceCounts count_of(Shown&& shown) const;
  bool is_hole(int x, int y, std::uint32_t shown) const;

  const Drawable& drawable_;  // must outlive it
  Size size_;
  std::vector<FloatTriangle> floats_;  // of a stream
  std::unique_ptr<const SourceTruth> source_;
  VisibleTriangles exact_;
};

}  // namespace edgewise::lab
