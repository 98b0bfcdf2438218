// The SDL window: passes events to the panel or the session, and shows their pictures.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "edgewise/contract.h"
#include "program/sdl_library.h"
#include "viewer/panel/panel.h"
#include "viewer/session.h"
#include "viewer/window.h"

namespace edgewise::viewer {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kFrame = std::chrono::microseconds(1'000'000 / 60);
constexpr int kIdle_ms = 100;            // between frames while nothing happens
constexpr double kLongestStep_s = 0.25;  // limits the jump of movement after a long frame

const SdlLibrary& sdl() {
  static const SdlLibrary library;
  return library;
}

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(std::string(what) + ": " + sdl().GetError() +
                           "; --terminal works without a window");
}

struct Sdl {
  Sdl() {
    sdl().SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // the program has its own
    sdl().SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
    // Copies pixels without OpenGL, which is slower than the drawing where there is no GPU.
    sdl().SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");
    if (sdl().Init(SDL_INIT_VIDEO) != 0) fail("cannot open a window");
    // Without a display SDL falls back to drivers that show nothing.
    const std::string_view driver = sdl().GetCurrentVideoDriver();
    const char* const asked_for = std::getenv("SDL_VIDEODRIVER");
    if ((asked_for == nullptr || *asked_for == 0) &&
        (driver == "offscreen" || driver == "dummy" || driver == "evdev")) {
      sdl().Quit();
      throw std::runtime_error("cannot open a window: there is no display; --terminal works without one");
    }
  }
  ~Sdl() { sdl().Quit(); }
  Sdl(const Sdl&) = delete;
  Sdl& operator=(const Sdl&) = delete;
};

std::optional<Key> key_of(SDL_Keycode code) {
  switch (code) {
    case SDLK_UP:
      return Key::up;
    case SDLK_DOWN:
      return Key::down;
    case SDLK_LEFT:
      return Key::left;
    case SDLK_RIGHT:
      return Key::right;
    case SDLK_LSHIFT:
    case SDLK_RSHIFT:
      return Key::shift;
    case SDLK_KP_ENTER:
      return Key::enter;
    default:
      break;
  }
  // SDL key codes below 128 are ASCII.
  if (code > 0 && code < 128) return viewer::key_of(static_cast<char>(code));
  return std::nullopt;
}

class Window {
 public:
  explicit Window(const WindowOptions& o)
      : window_(sdl().CreateWindow(o.title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                   o.size.width, o.size.height, SDL_WINDOW_RESIZABLE),
                sdl().DestroyWindow) {
    if (!window_) fail("cannot open a window");
    sdl().SetWindowMinimumSize(window_.get(), 64, 48);
  }

  void show(Session& session, Panel& panel) {
    SDL_Surface* const surface = sdl().GetWindowSurface(window_.get());
    if (surface == nullptr) fail("cannot draw into the window");
    const tools::Size size{std::clamp(surface->w, 1, contract::kMaxImageSide),
                           std::clamp(surface->h, 1, contract::kMaxImageSide)};
    const Image& image = panel.show(session, size);
    const std::unique_ptr<SDL_Surface, decltype(&SDL_FreeSurface)> picture(
        sdl().CreateRGBSurfaceWithFormatFrom(const_cast<std::uint32_t*>(image.pixels.data()), size.width,
                                             size.height, 32, size.width * 4, SDL_PIXELFORMAT_ABGR8888),
        sdl().FreeSurface);
    if (!picture) fail("cannot draw into the window");
    sdl().SetSurfaceBlendMode(picture.get(), SDL_BLENDMODE_NONE);
    // Failures are ignored: the window has just changed size, and the next frame gets its new surface.
    sdl().UpperBlit(picture.get(), nullptr, surface, nullptr);
    sdl().UpdateWindowSurface(window_.get());
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

void show_sdl_window(Session& session, const WindowOptions& options) {
  const Sdl started;
  Window window(options);
  Panel panel;
  Clock::time_point last = Clock::now();
  for (bool open = true; open;) {
    if (session.still()) sdl().WaitEventTimeout(nullptr, kIdle_ms);
    const Clock::time_point now = Clock::now();
    const double passed = std::chrono::duration<double>(now - last).count();
    last = now;
    for (SDL_Event event; open && sdl().PollEvent(&event) != 0;) open = handle(event, panel, session);
    session.advance(std::min(passed, kLongestStep_s));
    window.show(session, panel);
    open = open && !session.done();  // the panel has a button for it
    if (const auto left = kFrame - (Clock::now() - now); left.count() > 0)
      sdl().Delay(static_cast<Uint32>(std::chrono::duration_cast<std::chrono::milliseconds>(left).count()));
  }
}

}  // namespace edgewise::viewer
