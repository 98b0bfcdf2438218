// The SDL window: passes events to the panel or the session, and shows their pictures.
#include <SDL.h>
#include <dlfcn.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "edgewise/contract.h"
#include "viewer/panel/panel.h"
#include "viewer/session.h"
#include "viewer/window.h"

namespace edgewise::viewer {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kFrame = std::chrono::microseconds(1'000'000 / 60);
constexpr int kIdle_ms = 100;            // between frames while nothing happens
constexpr double kLongestStep_s = 0.25;  // limits the jump of movement after a long frame

// SDL is loaded only when a window opens: linking it would slow down every start of the program several
// times. It stays loaded, because its drivers may leave threads and handlers behind.
void* sdl_function(const char* name) {
  static void* const library = dlopen("libSDL2-2.0.so.0", RTLD_NOW | RTLD_LOCAL);  // of every SDL 2 version
  void* const function = library == nullptr ? nullptr : dlsym(library, name);
  if (function == nullptr)
    throw std::runtime_error(std::string("cannot open a window: ") + dlerror() +
                             "; --terminal works without one");
  return function;
}
// Each place looks its function up once: events are polled and frames are shown in a loop.
#define EDGEWISE_CALL(name)                                                                           \
  ([] {                                                                                               \
    static const auto function = reinterpret_cast<decltype(&SDL_##name)>(sdl_function("SDL_" #name)); \
    return function;                                                                                  \
  }())

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(std::string(what) + ": " + EDGEWISE_CALL(GetError)() +
                           "; --terminal works without a window");
}

struct Sdl {
  Sdl() {
    EDGEWISE_CALL(SetHint)(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // the program has its own
    EDGEWISE_CALL(SetHint)(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
    // Copies pixels without OpenGL, which is slower than the drawing where there is no GPU.
    EDGEWISE_CALL(SetHint)(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");
    if (EDGEWISE_CALL(Init)(SDL_INIT_VIDEO) != 0) fail("cannot open a window");
    // Without a display SDL falls back to drivers that show nothing.
    const std::string_view driver = EDGEWISE_CALL(GetCurrentVideoDriver)();
    const char* const asked_for = std::getenv("SDL_VIDEODRIVER");
    if ((asked_for == nullptr || *asked_for == 0) &&
        (driver == "offscreen" || driver == "dummy" || driver == "evdev")) {
      EDGEWISE_CALL(Quit)();
      throw std::runtime_error("cannot open a window: there is no display; --terminal works without one");
    }
  }
  ~Sdl() { EDGEWISE_CALL(Quit)(); }
  Sdl(const Sdl&) = delete;
  Sdl& operator=(const Sdl&) = delete;
};

std::optional<Key> key_of(SDL_Keycode code) {
  constexpr std::pair<SDL_Keycode, Key> kNamed[] = {{SDLK_UP, Key::up},         {SDLK_DOWN, Key::down},
                                                    {SDLK_LEFT, Key::left},     {SDLK_RIGHT, Key::right},
                                                    {SDLK_LSHIFT, Key::shift},  {SDLK_RSHIFT, Key::shift},
                                                    {SDLK_KP_ENTER, Key::enter}};
  for (const auto& [named, key] : kNamed)
    if (named == code) return key;
  // SDL key codes below 128 are ASCII.
  if (code > 0 && code < 128) return viewer::key_of(static_cast<char>(code));
  return std::nullopt;
}

class Window {
 public:
  Window(const std::string& title, tools::Size size)
      : window_(EDGEWISE_CALL(CreateWindow)(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                            size.width, size.height, SDL_WINDOW_RESIZABLE),
                EDGEWISE_CALL(DestroyWindow)) {
    if (!window_) fail("cannot open a window");
    EDGEWISE_CALL(SetWindowMinimumSize)(window_.get(), 64, 48);
  }

  void show(Session& session, Panel& panel) {
    SDL_Surface* const surface = EDGEWISE_CALL(GetWindowSurface)(window_.get());
    if (surface == nullptr) fail("cannot draw into the window");
    const tools::Size size{std::clamp(surface->w, 1, contract::kMaxImageSide),
                           std::clamp(surface->h, 1, contract::kMaxImageSide)};
    const Image& image = panel.show(session, size);
    const std::unique_ptr<SDL_Surface, decltype(&SDL_FreeSurface)> picture(
        EDGEWISE_CALL(CreateRGBSurfaceWithFormatFrom)(const_cast<std::uint32_t*>(image.pixels.data()),
                                                      size.width, size.height, 32, size.width * 4,
                                                      SDL_PIXELFORMAT_ABGR8888),
        EDGEWISE_CALL(FreeSurface));
    if (!picture) fail("cannot draw into the window");
    EDGEWISE_CALL(SetSurfaceBlendMode)(picture.get(), SDL_BLENDMODE_NONE);
    // Failures are ignored: the window has just changed size, and the next frame gets its new surface.
    EDGEWISE_CALL(UpperBlit)(picture.get(), nullptr, surface, nullptr);
    EDGEWISE_CALL(UpdateWindowSurface)(window_.get());
  }

 private:
  std::unique_ptr<SDL_Window, decltype(&SDL_DestroyWindow)> window_;
};

// Passes an event to the panel, or else to the session. False if the window is to close.
bool handle(const SDL_Event& event, Panel& panel, Session& session) {
  const auto point = [&](Pixel to, bool held) {
    if (!panel.point(to, held)) session.point(to, held);
  };
  switch (event.type) {
    case SDL_QUIT:
      return false;
    case SDL_KEYDOWN:
      if (event.key.repeat == 0 && (event.key.keysym.mod & (KMOD_CTRL | KMOD_ALT | KMOD_GUI)) == 0)
        if (const auto key = key_of(event.key.keysym.sym); key && !panel.press(*key)) session.press(*key);
      break;
    case SDL_KEYUP:
      if (const auto key = key_of(event.key.keysym.sym)) session.release(*key);
      break;
    case SDL_MOUSEMOTION:
      point({event.motion.x, event.motion.y}, (event.motion.state & SDL_BUTTON_LMASK) != 0);
      break;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
      if (event.button.button == SDL_BUTTON_LEFT)
        point({event.button.x, event.button.y}, event.type == SDL_MOUSEBUTTONDOWN);
      break;
    case SDL_MOUSEWHEEL:
      panel.scroll(static_cast<float>(event.wheel.y));
      break;
    case SDL_WINDOWEVENT:
      if (event.window.event == SDL_WINDOWEVENT_LEAVE) panel.point({-1, -1}, false);  // ends tooltips
      break;
    default:
      break;
  }
  return !session.done();
}

}  // namespace

void show_sdl_window(Session& session, const std::string& title, tools::Size size) {
  const Sdl started;
  Window window(title, size);
  Panel panel;
  Clock::time_point last = Clock::now();
  for (bool open = true; open;) {
    if (session.still()) EDGEWISE_CALL(WaitEventTimeout)(nullptr, kIdle_ms);
    const Clock::time_point now = Clock::now();
    const double passed = std::chrono::duration<double>(now - last).count();
    last = now;
    for (SDL_Event event; open && EDGEWISE_CALL(PollEvent)(&event) != 0;)
      open = handle(event, panel, session);
    session.advance(std::min(passed, kLongestStep_s));
    window.show(session, panel);
    open = open && !session.done();  // the panel has a button for it
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(kFrame - (Clock::now() - now));
    if (left.count() > 0) EDGEWISE_CALL(Delay)(static_cast<Uint32>(left.count()));
  }
}

}  // namespace edgewise::viewer
