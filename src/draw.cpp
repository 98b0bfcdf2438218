// A scene or stream drawn in one call: the only file that knows both front end and backends.
#include <variant>

#include "core/float_state.h"
#include "core/triangle_source.h"
#include "edgewise/backend.h"
#include "edgewise/frontend.h"
#include "raster/checks.h"

namespace edgewise {

void draw(const Drawable& drawable, Frontend& frontend, const FrontendOptions& options, Backend& backend,
          FrameView frame, const RenderPass& pass, const Execution& execution) {
  const DefaultFloatState state;
  throw_if_of_another_size("a drawable with options", options.width, options.height, frame);
  const Execution resolved = checked(frame, execution);
  const FramePart part = checked(frame, pass);
  TriangleSource* const source =
      is_empty(part) ? nullptr : frontend.start_source(drawable, options, resolved.threads);
  if (source != nullptr) {
    struct End {  // also if drawing throws
      Frontend& frontend;
      ~End() { frontend.end_source(); }
    };
    const End end{frontend};
    if (backend.draw_source(*source, backend.with_payload(part), resolved)) return;
  }
  FrontendOptions in_two_calls = options;
  if (std::holds_alternative<TriangleStream>(drawable)) in_two_calls.threads = resolved.threads;
  backend.draw(frontend.run(drawable, in_two_calls), frame, pass, resolved);
}

}  // namespace edgewise
