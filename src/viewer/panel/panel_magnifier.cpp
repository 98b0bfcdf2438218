#include "viewer/panel/panel_magnifier.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "viewer/panel/panel_widgets.h"

namespace edgewise::viewer {

namespace {

constexpr int kReach = 7;  // pixels to each side
constexpr int kAcross = 2 * kReach + 1;
constexpr std::size_t kMostTriangles = 6;  // listed

// An image's pixels as squares of a grid, with a frame around the middle one.
void show_grid(const Image& image, float square) {
  const float all = square * kAcross;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Image(id_of(image), {all, all});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (int k = 1; k < kAcross; ++k) {
    const float by = square * static_cast<float>(k);
    list.AddRectFilled({at.x + by, at.y}, {at.x + by + 1.0f, at.y + all}, 0x60000000u);
    list.AddRectFilled({at.x, at.y + by}, {at.x + all, at.y + by + 1.0f}, 0x60000000u);
  }
  const ImVec2 middle{at.x + square * kReach, at.y + square * kReach};
  list.AddRect(middle, {middle.x + square + 1.0f, middle.y + square + 1.0f}, rgb(255, 255, 0), 0.0f, 0,
               std::floor(square / 8.0f));
}

}  // namespace

void Magnifier::look(const Session& session) {
  const State& state = session.state();
  side_ = state.arrangement == Arrangement::side_by_side ? state.active : 0;
  triangles_ = triangles_of(session.triangles(side_), session.focus());
}

void Magnifier::lay_out(const Session& session) {
  const Pixel focus = session.focus();
  const std::size_t views = session.state().arrangement == Arrangement::side_by_side ? 2 : 1;
  const float room = (kPanelWidth - 3) * em() / static_cast<float>(views);
  for (std::size_t i = 0; i < views; ++i) {
    const int left = session.left_of(i);
    zoomed_[i] = around(session.picture(), left, left + session.side_size().width, focus, kReach);
    if (i > 0) ImGui::SameLine();
    show_grid(zoomed_[i], std::floor(std::min(room / kAcross, 0.8f * em())));
  }
  text(kStrong, "pixel {}, {}; {}{}", focus.x, focus.y, prefix(session, side_),
       triangles_.size() == 1 ? "1 triangle touches it"
                              : fmt::format("{} triangles touch it", triangles_.size()));
  if (triangles_.empty()) return;
  text(kFaint, "number, depth, edge values in 1/65536 px²");
  const std::size_t listed = std::min(triangles_.size(), kMostTriangles);
  for (const TriangleOfPixel& t : std::span(triangles_).first(listed)) {
    swatch(t.colour);
    text(t.covers() ? kPlain : kFaint, "#{} {} {} {} {}", t.index,
         t.covers() ? fmt::format("{:.6f}", t.depth01) : "misses", t.edges[0], t.edges[1], t.edges[2]);
  }
  if (triangles_.size() > listed) text(kPlain, "and {} more", triangles_.size() - listed);
}

}  // namespace edgewise::viewer
