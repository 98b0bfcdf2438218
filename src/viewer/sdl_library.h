// SDL, opened only once a window is wanted: loading it with the program would make every start of it,
// whatever the command, several times as long.
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

// SDL_NAME is the member NAME. Throws std::runtime_error where the library cannot be opened.
class SdlLibrary {
 public:
  // All of SDL 2 goes by this name.
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
    throw std::runtime_error(std::string("no window can be opened: ") + dlerror() +
                             "; --terminal needs none");
  }

  void* library_;  // stays open: SDL's drivers may leave threads and handlers behind
};

}  // namespace edgewise::viewer
