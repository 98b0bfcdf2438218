// Makes OpenGL contexts current, and makes sure whose they are.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace edgewise::lab {

// Makes the context current if it isn't. Checks at each call that its renderer's name begins with `driver`:
// EGL may give another vendor's OpenGL instead of Mesa's. Throws std::runtime_error and leaves no context
// current if it does.
template <typename Context>
void use_context(Context& context, std::string_view driver) {
  if (!context.is_current() && !context.make_current())
    throw std::runtime_error("cannot make its context current");
  if (const std::string renderer = context.renderer(); !renderer.starts_with(driver)) {
    context.release();
    throw std::runtime_error("EGL gives " + renderer + " instead");
  }
}

}  // namespace edgewise::lab
