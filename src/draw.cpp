// The only file that knows the inside of both front end and backends.
#include "edgewise/draw.h"

#include "core/execution.h"
#include "core/float_state.h"
#include "core/triangle_source.h"
#include "raster/checks.h"

namespace edgewise {

// Reaches what front end and backend do for draw() alone.
struct DrawAccess {
  // Bins triangles where they are made, then draws them. Returns false, with the frame as it was, if that is
  // not possible.
  static bool draw_source(const Drawable& drawable, Frontend& frontend, const FrontendOptions& options,
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
  // Where nothing is drawn, the front end still counts its triangles.
  if (is_empty(part) || !DrawAccess::draw_source(drawable, frontend, options, backend, part, resolved))
    backend.draw(frontend.run(drawable, options, resolved), frame, pass, resolved);
}

}  // namespace edgewise
