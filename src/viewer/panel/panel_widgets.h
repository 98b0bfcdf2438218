// What the parts of the panel share: colours, and small widgets of Dear ImGui.
#pragma once

#include <fmt/format.h>
#include <imgui.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "edgewise/image.h"
#include "edgewise/scene.h"
#include "viewer/session.h"

namespace edgewise::viewer {

inline constexpr int kPanelWidth = 26;  // in heights of the font
inline constexpr std::uint32_t kPlain = rgb(225, 225, 225), kStrong = rgb(255, 255, 255),
                               kFaint = rgb(150, 150, 150), kNotOurs = rgb(255, 190, 90),
                               kWrong = rgb(255, 120, 90);

inline float em() {
  return ImGui::GetFontSize();
}

// `wrap`: where lines end; 0: at the end of the window.
inline void wrapped(std::uint32_t colour, std::string_view words, float wrap) {
  std::string shown(words);
  // Dear ImGui's font lacks this sign.
  constexpr std::string_view kAtMost = "\u2264";
  for (std::size_t at; (at = shown.find(kAtMost)) != std::string::npos;)
    shown.replace(at, kAtMost.size(), "<=");
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::PushTextWrapPos(wrap);
  ImGui::TextUnformatted(shown.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

inline void text(std::uint32_t colour, std::string_view words) {
  wrapped(colour, words, 0.0f);
}
template <typename... Values>
void text(std::uint32_t colour, fmt::format_string<const Values&...> words, const Values&... values) {
  wrapped(colour, fmt::format(words, values...), 0.0f);
}

// At the lower end of the panel, where it hides neither the picture nor the list that the pointer is in.
inline void tooltip(std::string_view words) {
  if (words.empty() || !ImGui::IsItemHovered()) return;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({window.x - kPanelWidth * em(), window.y}, ImGuiCond_Always, {0.0f, 1.0f});
  ImGui::BeginTooltip();
  wrapped(kPlain, words, (kPanelWidth - 1) * em());
  ImGui::EndTooltip();
}

inline bool section(const char* title) {
  return ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
}

// A square of a colour, at the start of a line.
inline void swatch(std::uint32_t colour) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + em() - 2.0f, at.y + em() - 2.0f},
                                            colour | 0xFF000000u);
  ImGui::Dummy({em(), em()});
  ImGui::SameLine();
}

inline ImTextureID id_of(const Image& image) {
  return const_cast<Image*>(&image);
}

// Before a line about one side, where there are two.
inline const char* prefix(const Session& session, std::size_t side) {
  return session.side_count() == 1 ? "" : side == 0 ? "left: " : "right: ";
}

}  // namespace edgewise::viewer
