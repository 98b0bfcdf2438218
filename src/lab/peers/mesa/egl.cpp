#include "lab/peers/mesa/egl.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>
#include <fmt/format.h>
#include <stdlib.h>

#include <array>
#include <map>
#include <stdexcept>
#include <utility>

#include "lab/peers/mesa/gl_context.h"
#include "lab/peers/peer.h"

namespace edgewise::lab {

namespace {

template <typename Function>
Function egl_function(const char* name) {
  const auto found = reinterpret_cast<Function>(eglGetProcAddress(name));
  if (found == nullptr) throw std::runtime_error(fmt::format("EGL lacks {}", name));
  return found;
}

EGLDeviceEXT software_device() {
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT")(static_cast<EGLint>(devices.size()),
                                                                devices.data(), &count);
  const auto extensions = egl_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  for (EGLint i = 0; i < count; ++i) {
    EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
    const char* has = extensions(device, EGL_EXTENSIONS);
    if (has != nullptr && std::string_view(has).find("EGL_MESA_device_software") != std::string_view::npos)
      return device;
  }
  throw std::runtime_error("EGL has no software device");
}

// Mesa reads the driver's name and its number of threads once per display, so every context needs a display
// of its own. The software device is Mesa's own, and gives two: Mesa distinguishes an empty list of
// attributes from none. The third, of the surfaceless platform, may be another vendor's.
EGLDisplay display_for(MesaDriver driver, int threads) {
  constexpr EGLint kNoAttributes[] = {EGL_NONE};
  const auto get = egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (driver == MesaDriver::softpipe) return get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  return get(EGL_PLATFORM_DEVICE_EXT, software_device(), threads == 1 ? nullptr : kNoAttributes);
}

std::string text_of(GLenum what) {
  const auto get = egl_function<PFNGLGETSTRINGPROC>("glGetString");
  const auto* const text = reinterpret_cast<const char*>(get(what));
  return text == nullptr ? "no OpenGL" : text;
}

struct Context {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  bool is_current() const { return eglGetCurrentContext() == context; }
  bool make_current() {  // whether that worked
    return eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE;
  }
  void release() { eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
  std::string renderer() const { return text_of(GL_RENDERER); }
};

Context open(MesaDriver driver, int threads) {
  // Overrides the user's settings, since the rows' names say so.
  setenv("GALLIUM_DRIVER", std::string(name_of(driver)).c_str(), 1);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("MESA_SHADER_CACHE_DISABLE", "1", 1);
  unsetenv("LP_NATIVE_VECTOR_WIDTH");
  // 0: no worker thread beside the caller. 2: two workers draw while the caller bins.
  setenv("LP_NUM_THREADS", threads == 1 ? "0" : "2", 1);
  Context made;
  made.display = display_for(driver, threads);
  if (!eglInitialize(made.display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API))
    throw std::runtime_error("EGL offers no display without a window");
  const bool newest = driver == MesaDriver::llvmpipe;  // softpipe has OpenGL 3.3, with the extensions we need
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               newest ? 4 : 3,
                               EGL_CONTEXT_MINOR_VERSION,
                               newest ? 5 : 3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  made.context = eglCreateContext(made.display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  if (made.context == EGL_NO_CONTEXT)
    throw std::runtime_error(fmt::format("no OpenGL {} context", newest ? "4.5" : "3.3"));
  return made;
}

void use(MesaDriver driver, int threads) {
  static std::map<std::pair<MesaDriver, int>, Context> contexts;
  Context& context = contexts[{driver, threads}];
  if (context.context == EGL_NO_CONTEXT) context = open(driver, threads);
  use_context(context, name_of(driver));
}

}  // namespace

std::string_view name_of(MesaDriver driver) {
  return driver == MesaDriver::llvmpipe ? "llvmpipe" : "softpipe";
}

void use_mesa(MesaDriver driver, int threads) {
  try {
    use(driver, threads);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", name_of(driver), error.what()));
  }
}

std::string mesa_version(MesaDriver driver) {
  use_mesa(driver, 1);
  // "4.5 (Core Profile) Mesa 22.3.6"; "llvmpipe (LLVM 15.0.6, 256 bits)" or "softpipe"
  const std::string opengl = with_year(text_of(GL_VERSION)), renderer = text_of(GL_RENDERER);
  const auto mesa = opengl.find("Mesa"), llvm = renderer.find("LLVM");
  if (mesa == std::string::npos) return opengl;
  if (llvm == std::string::npos) return opengl.substr(mesa) + ", scalar";
  return fmt::format("{}, {}", opengl.substr(mesa), renderer.substr(llvm, renderer.rfind(')') - llvm));
}

}  // namespace edgewise::lab
