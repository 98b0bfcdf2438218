// The panel beside the picture: methods, errors, magnifier, times, a demo's steps, help. Dear ImGui lays it
// out and handles its input; imgui_paint.h paints it.
#pragma once

#include <memory>

#include "edgewise/image.h"
#include "support/options.h"
#include "viewer/session.h"

struct ImGuiContext;
struct ImGuiIO;

namespace edgewise::viewer {

#ifdef EDGEWISE_IMGUI

class Panel {
 public:
  Panel();
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  // In px; 0 if the window has no room for a panel beside the picture.
  static int width_px(tools::Size window);
  // Draws the session's picture and the panel. The reference is valid until the next call.
  const Image& show(Session& session, tools::Size window);

  // Input. The first two return whether it is for the panel; if not, it is for the session. The panel wants
  // Escape while a list is open.
  bool press(Key key);
  bool point(Pixel to, bool held);
  void scroll(float lines);

 private:
  ImGuiIO& current_io();  // makes this panel's context the current one
  void set_font(int px);

  class Contents;
  ImGuiContext* context_;
  std::unique_ptr<Contents> contents_;
  int font_px_ = 0;
  Image font_, image_;
  int picture_width_px_ = 0;
  // A released button is so from the second pass on, so that Dear ImGui sees each click.
  bool mouse_released_ = false, began_in_panel_ = false;
};

#else  // built without Dear ImGui: the picture alone

struct Panel {
  static int width_px(tools::Size) { return 0; }
  static const Image& show(Session& session, tools::Size window) { return session.draw(window).picture; }
};

#endif

}  // namespace edgewise::viewer
