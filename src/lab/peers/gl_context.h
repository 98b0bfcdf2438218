// Makes OpenGL contexts current, and makes sure whose they are.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace edgewise::lab {

class GlContext {
 public:
  virtual ~GlContext() = default;
  virtual bool is_current() const = 0;
  virtual bool make_current() = 0;           // whether that worked
  virtual void release() = 0;                // leaves no context current
  virtual std::string renderer() const = 0;  // GL_RENDERER of the current context
};

// Makes the context current if it isn't. Checks at each call that its renderer's name begins with `driver`:
// EGL may give another vendor's OpenGL instead of Mesa's. Throws std::runtime_error and leaves no context
// current if it does.
inline void use_context(GlContext& context, std::string_view driver) {
  if (!context.is_current() && !context.make_current())
    throw std::runtime_error("cannot make its context current");
  if (const std::string renderer = context.renderer(); !renderer.starts_with(driver)) {
    context.release();
    throw std::runtime_error("EGL gives " + renderer + " instead");
  }
}

}  // namespace edgewise::lab
