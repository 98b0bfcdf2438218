// Loads SDL only when a window opens: linking it would slow down every start of the program several times.
#pragma once

#include <SDL.h>
#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace edgewise::viewer {

#define EDGEWISE_SDL_FUNCTIONS(X)   \
  X(CreateRGBSurfaceWithFormatFrom) \
  X(CreateWindow)                   \
  X(Delay)                          \
  X(DestroyWindow)                  \
  X(FreeSurface)                    \
  X(GetCurrentVideoDriver)          \
  X(GetError)                       \
  X(GetWindowSurface)               \
  X(Init)                           \
  X(PollEvent)                      \
  X(Quit)                           \
  X(SetHint)                        \
  X(SetSurfaceBlendMode)            \
  X(SetWindowMinimumSize)           \
  X(UpdateWindowSurface)            \
  X(UpperBlit)                      \
  X(WaitEventTimeout)

// The member NAME is the function SDL_NAME. Throws std::runtime_error if the library cannot be loaded.
class SdlLibrary {
 public:
  // The soname of every SDL 2 version.
  SdlLibrary() : library_(dlopen("libSDL2-2.0.so.0", RTLD_NOW | RTLD_LOCAL)) {
    if (library_ == nullptr) fail();
#define EDGEWISE_LOAD(name)                                               \
  name = reinterpret_cast<decltype(name)>(dlsym(library_, "SDL_" #name)); \
  if (name == nullptr) fail();
    EDGEWISE_SDL_FUNCTIONS(EDGEWISE_LOAD)
#undef EDGEWISE_LOAD
  }

#define EDGEWISE_MEMBER(name) decltype(&SDL_##name) name;
  EDGEWISE_SDL_FUNCTIONS(EDGEWISE_MEMBER)
#undef EDGEWISE_MEMBER

 private:
  [[noreturn]] static void fail() {
    throw std::runtime_error(std::string("cannot open a window: ") + dlerror() +
                             "; --terminal works without one");
  }

  void* library_;  // stays open: SDL's drivers may leave threads and handlers behind
};

}  // namespace edgewise::viewer
