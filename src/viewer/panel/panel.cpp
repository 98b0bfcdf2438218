#include "viewer/panel/panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>  // ImGuiItemFlags_MixedValue, ClosePopupToLevel

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/console.h"
#include "viewer/panel/imgui_paint.h"

namespace edgewise::viewer {

namespace {

constexpr std::uint32_t kBackground = rgb(30, 31, 34);

constexpr int kPanelWidth = 26;  // in heights of the font
constexpr std::uint32_t kPlain = rgb(225, 225, 225), kStrong = rgb(255, 255, 255),
                        kNotOurs = rgb(255, 190, 90), kWrong = rgb(255, 120, 90);

float em() {
  return ImGui::GetFontSize();
}

// `wrap`: where lines end; 0: at the end of the window.
void wrapped(std::uint32_t colour, std::string_view words, float wrap) {
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

void text(std::uint32_t colour, std::string_view words) {
  wrapped(colour, words, 0.0f);
}
template <typename... Values>
void text(std::uint32_t colour, fmt::format_string<const Values&...> words, const Values&... values) {
  wrapped(colour, fmt::format(words, values...), 0.0f);
}

// At the lower end of the panel, where it hides neither the picture nor the list that the pointer is in.
void tooltip(std::string_view words) {
  if (words.empty() || !ImGui::IsItemHovered()) return;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({window.x - kPanelWidth * em(), window.y}, ImGuiCond_Always, {0.0f, 1.0f});
  ImGui::BeginTooltip();
  wrapped(kPlain, words, (kPanelWidth - 1) * em());
  ImGui::EndTooltip();
}

bool section(const char* title) {
  return ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
}

// A square of a colour, at the start of a line.
void swatch(std::uint32_t colour) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + em() - 2.0f, at.y + em() - 2.0f},
                                            colour | 0xFF000000u);
  ImGui::Dummy({em(), em()});
  ImGui::SameLine();
}

ImTextureID id_of(const Image& image) {
  return const_cast<Image*>(&image);
}

// Before a line about one side, where there are two.
const char* prefix(const Session& session, std::size_t side) {
  return session.side_count() == 1 ? "" : side == 0 ? "left: " : "right: ";
}

constexpr int kReach = 7;  // pixels to each side
constexpr int kAcross = 2 * kReach + 1;

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

constexpr int kFont_px = 13;  // the height for which Dear ImGui's font is made

// A high window gets a larger font, and a narrow one a smaller font; 0: no room.
int font_px(tools::Size window) {
  constexpr int kLines = 1080 / 16;  // of text in a high window
  const int px = std::min(std::max(window.height / kLines, kFont_px), window.width / (2 * kPanelWidth));
  return px < kFont_px ? 0 : px;
}

struct Entry {
  std::string name;
  std::string_view summary{};
};

}  // namespace

// The widgets, and what they keep from frame to frame. A widget presses the key that it shows.
class Panel::Contents {
 public:
  // Whether a widget changed the session since the last call.
  bool take_changed() { return std::exchange(changed_, false); }

  void lay_out(Session& session) {
    session_ = &session;
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({window.x - kPanelWidth * em(), 0.0f});
    ImGui::SetNextWindowSize({kPanelWidth * em(), window.y});
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBackground);
    ImGui::BeginChild("contents", {0.0f, -footer_height_});
    if (state().help) {
      help();
    } else {
      steps();
      const bool magnified = state().magnifier;
      if (magnified) magnifier();  // where a low window shows it
      methods();
      errors();
      if (!magnified) magnifier();
      times();
      triangles();
      camera();
    }
    ImGui::EndChild();
    const float top = ImGui::GetCursorPosY();
    ImGui::Separator();
    if (!state().message.empty()) text(kStrong, state().message);
    button("[h] help", key_of('h'));
    button_beside("[o] hide", key_of('o'));
    button_beside("[p] save", key_of('p'));
    button_beside("[q] quit", key_of('q'));
    footer_height_ = ImGui::GetCursorPosY() - top;  // of the next pass
    ImGui::End();
  }

 private:
  const State& state() const { return session_->state(); }

  void press(Key key) {
    session_->press(key);
    changed_ = true;
  }

  // A drop-down for what a key cycles through: choosing an entry presses the key as often as it takes.
  void choice(const char* what, char key, const std::vector<Entry>& entries, std::size_t current,
              bool ours = true) {
    ImGui::PushID(key);
    ImGui::AlignTextToFramePadding();
    text(kPlain, "[{}] {}", key, what);
    ImGui::SameLine(10.0f * em());
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::PushStyleColor(ImGuiCol_Text, ours ? kPlain : kNotOurs);
    const bool open = ImGui::BeginCombo("##", entries[current].name.c_str(), ImGuiComboFlags_HeightLarge);
    ImGui::PopStyleColor();
    if (!open) tooltip(entries[current].summary);
    for (std::size_t i = 0; open && i < entries.size(); ++i) {
      if (ImGui::Selectable(entries[i].name.c_str(), i == current))
        for (std::size_t n = current; n % entries.size() != i; ++n) press(key_of(key));
      tooltip(entries[i].summary);
    }
    if (open) ImGui::EndCombo();
    ImGui::PopID();
  }

  template <typename Method>
  void method(const char* stage, char key, std::span<const Method> all, const Method* current, bool ours) {
    std::vector<Entry> entries;
    for (const Method& m : all) entries.push_back({std::string(m.info.name), m.info.summary});
    choice(stage, key, entries, static_cast<std::size_t>(current - all.data()), ours);
  }

  void toggle(const char* what, char key, bool on) {
    // A filled box, not a check mark: the lines of that depend on the processor (imgui_paint.cpp).
    ImGui::PushItemFlag(ImGuiItemFlags_MixedValue, on);
    if (ImGui::Checkbox(fmt::format("[{}] {}", key, what).c_str(), &on)) press(key_of(key));
    ImGui::PopItemFlag();
  }
  void toggle_beside(const char* what, char key, bool on) {
    ImGui::SameLine(13.0f * em());
    toggle(what, key, on);
  }

  void button(const char* what, Key key) {
    if (ImGui::Button(what)) press(key);
  }
  void button_beside(const char* what, Key key) {
    ImGui::SameLine();
    button(what, key);
  }

  void steps() {
    if (session_->steps().empty() || !section("Steps")) return;
    const float width = ImGui::GetContentRegionAvail().x;
    for (std::size_t i = 0; i < session_->steps().size(); ++i) {
      const bool current = i + 1 == state().step;
      const std::string words = fmt::format("{}. {}", i + 1, session_->steps()[i].notice);
      const ImVec2 at = ImGui::GetCursorPos(),
                   size = ImGui::CalcTextSize(words.c_str(), nullptr, false, width);
      if (ImGui::Selectable(fmt::format("##{}", i).c_str(), current, 0, {0.0f, size.y})) {
        session_->take_step(i);
        changed_ = true;
      }
      ImGui::SetCursorPos(at);
      text(current ? kStrong : kPlain, words);
    }
    button("[8] back", key_of('8'));
    button_beside("[5] next", key_of('5'));
  }

  void methods() {
    const tools::Size size = session_->side_size();
    const Side& side = session_->side(state().active);
    const lab::StageMethods& c = side.choice;
    text(kStrong, "{}, {} x {} px", tools::printable(state().scene), size.width, size.height);
    choice("pictures", 'v', {{"one"}, {"side by side"}, {"difference"}},
           static_cast<std::size_t>(state().arrangement));
    if (session_->side_count() > 1) {
      button("[tab] other side", Key::tab);
      ImGui::SameLine();
      text(kStrong, state().active == 0 ? "side: left" : "side: right");
    }
    method("coverage", 'b', lab::drawing_methods(), c.coverage, c.our_coverage());
    method("clipping", 'x', lab::clipping_methods(), c.clipping, c.our_clipping());
    method("visibility", 'z', lab::visibility_methods(), c.visibility, c.our_visibility());
    method("facing", 'n', lab::facing_methods(), c.facing, c.our_facing());
    if (!side.because.empty()) text(kWrong, side.because);
    // Coverage methods other than backends use their own depth test (lab/coverage/coverage.h).
    if (c.our_visibility() && !c.our_coverage()) text(kNotOurs, "depth test: the coverage method's own");
    toggle("cull front", '1', side.cull_front);
    toggle_beside("cull back", '2', side.cull_back);
    toggle("edges only", 'y', !c.fills());
    toggle_beside("lighting", 'k', state().lit && !state().stream);
  }

  void errors() {
    if (!section("Errors")) return;
    choice("show", 'e', {{"count"}, {"count and tint"}, {"off"}}, static_cast<std::size_t>(state().errors));
    choice("against", 'u',
           {{"contract", "the library's picture"},
            {"snapped", "exact depths at snapped positions: rounded depths count as errors too"},
            {"floats", "exact at positions before snapping: snapping counts too"}},
           static_cast<std::size_t>(state().truth));
    if (state().arrangement == Arrangement::difference)
      text(kWrong, "{} pixels differ between the sides", state().differing);
    if (state().errors == Errors::off) return;
    for (std::size_t i = 0; i < session_->side_count(); ++i) {
      const Side& side = session_->side(i);
      if (!side.judgement)
        text(kPlain, "{}{}", prefix(*session_, i),
             side.choice.fills() ? "not counted" : "edges have no errors to count");
      else
        text(side.judgement->wrong > 0 ? kWrong : kPlain, "{}{}{}", prefix(*session_, i),
             errors_of(*side.judgement),
             side.judged == state().version ? "" : " (an earlier frame, to keep the frame rate)");
    }
    const Side& side = session_->side(state().active);
    if (!side.judgement) return;
    if (side.judgement->double_hits) text(kPlain, "marked, also pixels hit twice but right:");
    constexpr std::pair<lab::Mark, const char*> kKinds[] = {{lab::Mark::gap, "nothing drawn"},
                                                            {lab::Mark::twice, "twice, or wrong triangle"},
                                                            {lab::Mark::extra, "outside all triangles"}};
    for (const auto& [mark, what] : kKinds) {
      swatch(lab::colour_of(mark));
      text(kPlain, "{}{} {}", prefix(*session_, state().active), side.marked[static_cast<std::size_t>(mark)],
           what);
    }
  }

  void magnifier() {
    if (!section("Magnifier")) return;
    toggle("at pointer", 'g', state().magnifier);
    button_beside("[enter] wrong pixel", Key::enter);
    if (!state().magnifier) return;
    const Pixel focus = session_->focus();
    const std::size_t views = state().arrangement == Arrangement::side_by_side ? 2 : 1;
    const float room = (kPanelWidth - 3) * em() / static_cast<float>(views);
    for (std::size_t i = 0; i < views; ++i) {
      const int left = session_->left_of(i);
      zoomed_[i] = around(session_->picture(), left, left + session_->side_size().width, focus, kReach);
      if (i > 0) ImGui::SameLine();
      show_grid(zoomed_[i], std::floor(std::min(room / kAcross, 0.8f * em())));
    }
    text(kStrong, "pixel {}, {}", focus.x, focus.y);
  }

  void times() {
    if (session_->reproducible() || !section("Times")) return;
    text(kPlain, "{:.1f} ms per frame", state().frame_ms);
    for (std::size_t i = 0; i < session_->side_count(); ++i) {
      const Side &side = session_->side(i), &first = session_->side(0);
      text(kPlain, "{}front end {:.2f} ms, raster {:.2f} ms", prefix(*session_, i), side.frontend_ms,
           side.raster_ms);
      const double ratio = (side.frontend_ms + side.raster_ms) / (first.frontend_ms + first.raster_ms);
      if (i > 0)
        text(kPlain, "right: {:.2f}x {} than left", std::max(ratio, 1 / ratio),
             ratio < 1 ? "faster" : "slower");
    }
  }

  void triangles() {
    if (!section("Triangles")) return;
    for (std::size_t i = 0; i < session_->side_count(); ++i) {
      const FrontendStats& n = session_->side(i).stats;
      text(kPlain, "{}{} in, {} outside, {} culled, {}{} drawn", prefix(*session_, i), n.triangles,
           n.whole_mesh + n.outside, n.culled,
           session_->side(i).choice.our_clipping() ? fmt::format("{} clipped, ", n.clipped) : "", n.emitted);
      if (n.meshes > 1)
        text(kPlain, "{}{} objects, {} culled whole", prefix(*session_, i), n.meshes, n.meshes_culled);
    }
    toggle("outlines", '6', state().outlines);
    if (state().stream) return;
    toggle("vertex numbers", 't', state().labels);
    const std::size_t vertices = vertex_count(*session_->world().scene());
    if (state().labels && vertices > kMostLabels)
      text(kNotOurs, "{} vertices are too many for labels", vertices);
    toggle("state of each face", '7', state().face_states);
    for (std::size_t i = 0; state().face_states && i < session_->side_count(); ++i) {
      const Side& side = session_->side(i);
      if (!side.choice.our_clipping())
        text(kNotOurs, "{}this clipping method doesn't report face states", prefix(*session_, i));
      else
        text(kPlain, "{}{}{}", prefix(*session_, i), summary_of(side.faces),
             side.faces.size() > kMostLabels ? "; too many faces for letters" : "");
    }
  }

  void camera() {
    if (state().stream || !section("Camera and objects")) return;
    const Camera& c = session_->world().scene()->camera;
    const glm::vec3 axis = state().axis;
    const auto degrees = [](float radians) {
      return std::lround(radians * (180.0f / std::numbers::pi_v<float>));
    };
    text(kPlain, "camera {:.2f} {:.2f} {:.2f}, yaw {}, pitch {}", c.position.x, c.position.y, c.position.z,
         degrees(c.yaw), degrees(c.pitch));
    choice("move along", 'm', {{"world axes"}, {"camera axes"}}, state().along_view ? 1 : 0);
    button("[3] slower", key_of('3'));
    button_beside("[4] faster", key_of('4'));
    ImGui::SameLine();
    text(kPlain, "speed {:.2g}", state().speed);
    toggle("rotate", 'r', state().spinning);
    text(kPlain, "{} degrees about {:.2f} {:.2f} {:.2f}", degrees(state().angle), axis.x, axis.y, axis.z);
    button("[0] reset", key_of('0'));
  }

  void help() {
    const auto row = [&](std::string_view name, std::string_view does) {
      text(kStrong, name);
      ImGui::SameLine(11.0f * em());
      text(kPlain, does);
    };
    if (section("Keys"))
      for (const KeyRow& keys : key_table()) row(keys.keys, keys.does);
    constexpr const char* kTitles[] = {"Coverage methods [b]", "Visibility methods [z]", "Facing tests [n]",
                                       "Clipping methods [x]", "Projection methods"};
    for (const lab::Family family : lab::kFamilies)
      if (section(kTitles[static_cast<std::size_t>(family)]))
        for (const lab::MethodInfo& method : lab::methods_of(family)) row(method.name, method.summary);
  }

  Session* session_ = nullptr;
  bool changed_ = false;
  float footer_height_ = 0.0f;
  std::array<Image, 2> zoomed_;  // the magnifier's, until they are painted
};

Panel::Panel() : context_(ImGui::CreateContext()), contents_(std::make_unique<Contents>()) {
  ImGuiIO& io = current_io();
  io.IniFilename = io.LogFilename = nullptr;
  io.BackendFlags = ImGuiBackendFlags_RendererHasVtxOffset;
}

Panel::~Panel() {
  ImGui::DestroyContext(context_);
}

ImGuiIO& Panel::current_io() {
  ImGui::SetCurrentContext(context_);
  return ImGui::GetIO();
}

int Panel::width_px(tools::Size window) {
  return font_px(window) * kPanelWidth;
}

void Panel::set_font(int px) {
  if (px == font_px_) return;
  font_px_ = px;
  ImGuiStyle style;
  style.ItemSpacing.y = 3.0f;
  style.ScaleAllSizes(static_cast<float>(px) / kFont_px);
  style.ScrollbarRounding = style.TabRounding = 0.0f;
  style.WindowBorderSize = 0.0f;
  // Smooth shapes depend on the processor (imgui_paint.cpp), and round ones on the C library's sine.
  style.AntiAliasedLines = style.AntiAliasedLinesUseTex = style.AntiAliasedFill = false;
  ImGui::StyleColorsDark(&style);
  style.Colors[ImGuiCol_PopupBg].w = 1.0f;
  ImGui::GetStyle() = style;
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  ImFontConfig config;
  config.SizePixels = static_cast<float>(px);
  config.OversampleH = 1;
  config.PixelSnapH = true;
  fonts.AddFontDefault(&config);
  unsigned char* pixels = nullptr;
  fonts.GetTexDataAsRGBA32(&pixels, &font_.width, &font_.height);
  font_.pixels.resize(static_cast<std::size_t>(font_.width) * static_cast<std::size_t>(font_.height));
  // Few levels hide the last bits, which depend on the compiler of stb_truetype at sizes other than kFont_px.
  for (std::size_t i = 0; i < font_.pixels.size(); ++i)
    font_.pixels[i] = 0xFFFFFFu | std::min((pixels[4 * i + 3] + 3u) / 16u * 17u, 255u) << 24;
  fonts.SetTexID(id_of(font_));
}

const Image& Panel::show(Session& session, tools::Size window) {
  ImGuiIO& io = current_io();
  io.DisplaySize = {static_cast<float>(window.width), static_cast<float>(window.height)};
  set_font(std::max(font_px(window), kFont_px));
  const int width = width_px(window);
  const Screen& screen = session.draw(window, width);
  // The layout settles in the second pass. The third one shows what a click changed.
  for (int pass = 0; pass < 3; ++pass) {
    if (contents_->take_changed()) session.draw(window, width);
    ImGui::NewFrame();
    if (std::exchange(mouse_released_, false)) io.MouseDown[0] = false;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const Label& label : screen.labels) {
      const ImVec2 size = ImGui::CalcTextSize(label.words.c_str());
      const ImVec2 at{std::floor(static_cast<float>(label.x) - size.x / 2.0f),
                      std::floor(static_cast<float>(label.y) - size.y / 2.0f)};
      list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, rgb(20, 20, 20) & 0xA0FFFFFFu);
      list.AddText(at, label.colour, label.words.c_str());
    }
    if (session.state().panel && width > 0) contents_->lay_out(session);
    ImGui::Render();
  }
  image_ = {window.width, window.height, std::move(image_.pixels)};
  image_.pixels.assign(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height),
                       kBackground);
  paste(screen.picture, 0, image_);
  paint(*ImGui::GetDrawData(), image_);
  picture_width_px_ = screen.picture.width;
  return image_;
}

bool Panel::press(Key key) {
  current_io();
  const bool closes = key == Key::escape && !context_->OpenPopupStack.empty();
  if (closes) ImGui::ClosePopupToLevel(0, false);
  return closes;
}

bool Panel::point(Pixel to, bool held) {
  ImGuiIO& io = current_io();
  io.MousePos = {static_cast<float>(to.x), static_cast<float>(to.y)};
  if (!held) began_in_panel_ = to.x >= picture_width_px_;
  mouse_released_ = !held && io.MouseDown[0];
  if (held) io.MouseDown[0] = true;
  return began_in_panel_;
}

void Panel::scroll(float lines) {
  current_io().MouseWheel += lines;
}

}  // namespace edgewise::viewer
