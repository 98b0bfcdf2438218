#include "bench/peers/egl.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>
#include <fmt/format.h>
#include <stdlib.h>

#include <array>
#include <stdexcept>
#include <string_view>

namespace edgewise::bench {

namespace {

template <typename Function>
Function egl_function(const char* name) {
  const auto found = reinterpret_cast<Function>(eglGetProcAddress(name));
  if (found == nullptr) throw std::runtime_error(std::string("llvmpipe: EGL lacks ") + name);
  return found;
}

EGLDisplay surfaceless_display() {
  return egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT")(
      EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

EGLDisplay software_device_display() {
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT")(static_cast<EGLint>(devices.size()),
                                                                devices.data(), &count);
  const auto extensions = egl_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  for (EGLint i = 0; i < count; ++i) {
    EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
    const char* has = extensions(device, EGL_EXTENSIONS);
    if (has != nullptr && std::string_view(has).find("EGL_MESA_device_software") != std::string_view::npos)
      return egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT")(
          EGL_PLATFORM_DEVICE_EXT, device, nullptr);
  }
  throw std::runtime_error("llvmpipe: EGL has no software device");
}

struct Context {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

Context open(int threads) {
  // Overrides the user's settings, since the rows' names promise these.
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("MESA_SHADER_CACHE_DISABLE", "1", 1);
  unsetenv("LP_NATIVE_VECTOR_WIDTH");
  // 0: no worker thread beside the caller. 2: two workers draw while the caller bins.
  setenv("LP_NUM_THREADS", threads == 1 ? "0" : "2", 1);
  Context made;
  made.display = threads == 1 ? software_device_display() : surfaceless_display();
  if (!eglInitialize(made.display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API))
    throw std::runtime_error("llvmpipe: EGL offers no display without a window");
  constexpr EGLint kAttributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                    4,
                                    EGL_CONTEXT_MINOR_VERSION,
                                    5,
                                    EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                    EGL_NONE};
  made.context = eglCreateContext(made.display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes);
  if (made.context == EGL_NO_CONTEXT) throw std::runtime_error("llvmpipe: no OpenGL 4.5 context");
  return made;
}

std::string text_of(GLenum what) {
  const auto get = egl_function<PFNGLGETSTRINGPROC>("glGetString");
  return reinterpret_cast<const char*>(get(what));
}

}  // namespace

void use_llvmpipe(int threads) {
  static std::array<Context, 2> contexts;
  Context& context = contexts.at(static_cast<std::size_t>(threads - 1));
  if (context.context == EGL_NO_CONTEXT) context = open(threads);
  if (eglGetCurrentContext() == context.context) return;
  if (!eglMakeCurrent(context.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context))
    throw std::runtime_error("llvmpipe: cannot make its context current");
  if (!text_of(GL_RENDERER).starts_with("llvmpipe"))
    throw std::runtime_error("llvmpipe: EGL gives " + text_of(GL_RENDERER) + " instead");
}

std::string llvmpipe_version() {
  static const std::string version = [] {
    use_llvmpipe(1);
    // "4.5 (Core Profile) Mesa 22.3.6" and "llvmpipe (LLVM 15.0.6, 256 bits)"
    const std::string opengl = text_of(GL_VERSION), renderer = text_of(GL_RENDERER);
    const auto mesa = opengl.find("Mesa"), llvm = renderer.find("LLVM");
    if (mesa == std::string::npos || llvm == std::string::npos) return opengl;
    return fmt::format("{}, {}", opengl.substr(mesa), renderer.substr(llvm, renderer.rfind(')') - llvm));
  }();
  return version;
}

}  // namespace edgewise::bench
