// A scene or stream drawn in one call.
#pragma once

#include "edgewise/cxx20.h"

#include "edgewise/backend.h"
#include "edgewise/frontend.h"
#include "edgewise/scene.h"

#pragma GCC visibility push(default)
namespace edgewise {

// Frontend::run() and Backend::draw() in one call: the same picture and Frontend::stats(), faster and with
// less memory. Screen triangles are binned where they are made, and those that become coverage masks are not
// kept. If clipping leaves more than about twice as many to be kept as were submitted, the first such frame
// of a backend makes all triangles twice. Throws what the two throw, and std::invalid_argument if `options`
// state another size than `frame` has.
void draw(const Drawable& drawable, Frontend& frontend, const FrontendOptions& options, Backend& backend,
          FrameView frame, const RenderPass& pass = {}, const Execution& execution = {});

}  // namespace edgewise
#pragma GCC visibility pop
