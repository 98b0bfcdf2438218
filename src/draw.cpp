// The only file that calls the private half of both Frontend and Backend. The map: src/raster/README.md
#include "edgewise/draw.h"

#include "core/execution.h"
#include "core/float_state.h"
#include "core/triangle_source.h"
#include "raster/checks.h"

namespace edgewise {

struct DrawAccess {  // a friend of both
  // Bins triangles where they are made, then draws them. If it cannot, returns false and leaves the frame.
  static bool bin_and_draw(const Drawable& drawable, Frontend& frontend, const FrontendOptions& options,
                           Backend& backend, const FramePart& part, const Execution& execution) {
    TriangleSource* const source = frontend.start_source(drawable, options, execution);
    if (source == nullptr) return false;
    struct End {  // also if drawing throws
      Frontend& frontend;
      ~End() { frontend.end_source(); }
    };
    const End end{frontend};
    return backend.draw_source(*source, backend.with_payload(part), execution);
  }
};

void draw(const Drawable& drawable, Frontend& frontend, const FrontendOptions& options, Backend& backend,
          FrameView frame, const RenderPass& pass, const Execution& execution) {
  const DefaultFloatState state;
  throw_if_of_another_size("a drawable with options", options.width, options.height, frame);
  check(frame);
  const Execution resolved = checked(execution);
  const FramePart part = checked(frame, pass);
  // run() even if the part is empty: the front end still counts its triangles.
  if (is_empty(part) || !DrawAccess::bin_and_draw(drawable, frontend, options, backend, part, resolved))
    backend.draw(frontend.run(drawable, options, resolved), frame, pass, resolved);
}

}  // namespace edgewise
