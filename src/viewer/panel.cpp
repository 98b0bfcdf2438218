#include "viewer/panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>  // ImGuiItemFlags_MixedValue

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "support/printable.h"
#include "viewer/imgui_paint.h"

namespace edgewise::viewer {

namespace {

constexpr int kFont_px = 13;  // Dear ImGui's font is sharp at this size and its multiples
constexpr int kWidth = 26;    // of the panel, in heights of the font
constexpr int kReach = 7;     // of the magnifier, in pixels to each side
constexpr std::size_t kTriangles = 6;  // listed of a pixel
constexpr std::uint32_t kPlain = rgb(225, 225, 225), kStrong = rgb(255, 255, 255), kFaint = rgb(150, 150, 150),
                        kNotOurs = rgb(255, 190, 90), kWrong = rgb(255, 120, 90), kShadow = rgb(20, 20, 20),
                        kFocus = rgb(255, 255, 0), kBackground = rgb(30, 31, 34);

float em() {
  return ImGui::GetFontSize();
}

void text(std::string_view words, std::uint32_t colour = kPlain) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(words.data(), words.data() + words.size());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

bool section(const char* title) {
  return ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
}

// At the lower end of the panel, where it hides neither the picture nor the list that the pointer is in.
void tooltip(std::string_view words) {
  if (words.empty() || !ImGui::IsItemHovered()) return;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({window.x - kWidth * em(), window.y}, ImGuiCond_Always, {0.0f, 1.0f});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos((kWidth - 1) * em());
  ImGui::TextUnformatted(words.data(), words.data() + words.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

// A square of a colour, at the begin of a line.
void swatch(std::uint32_t colour) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + em() - 2.0f, at.y + em() - 2.0f}, colour | 0xFF000000u);
  ImGui::Dummy({em(), em()});
  ImGui::SameLine();
}

ImTextureID id_of(const Image& image) {
  return const_cast<Image*>(&image);
}

// Whole degrees, never "-0".
int degrees(float radians) {
  return static_cast<int>(std::lround(glm::degrees(radians)));
}

// Rounded, never "-0.00".
double hundredths(double length) {
  return std::round(length * 100.0) / 100.0 + 0.0;
}

struct Entry {
  std::string name;
  std::string_view summary;
};

template <typename Method>
std::vector<Entry> entries_of(std::span<const Method> methods) {
  std::vector<Entry> entries;
  for (const Method& method : methods)
    entries.push_back({std::string(method.info.name), method.info.summary});
  return entries;
}

std::size_t index_of(const auto& list, const auto& value) {
  return static_cast<std::size_t>(std::find(std::begin(list), std::end(list), value) - std::begin(list));
}

}  // namespace

// The widgets, and what they keep from frame to frame. A widget presses the keys that are shown on it.
class Panel::Contents {
 public:
  // Once per frame.
  void prepare(Session& session);
  void lay_out();

 private:
  const State& state() const { return session_->state(); }
  const Side& side() const { return session_->side(state().active); }
  std::string name_of(std::size_t side) const {
    return session_->side_count() == 1 ? "" : side == 0 ? "left: " : "right: ";
  }
  // The side whose triangles the magnifier lists.
  std::size_t magnified() const {
    return state().arrangement == Arrangement::side_by_side ? state().active : 0;
  }
  void press(char key) { session_->press(key_of(key)); }

  void choice(std::string_view what, char key, const std::vector<Entry>& entries, std::size_t current,
              bool ours = true);
  void toggle(const char* what, char key, bool on);
  void button(const char* what, Key key);

  void steps();
  void methods();
  void errors();
  void magnifier();
  void times();
  void triangles();
  void faces(const Side& side);
  void camera();
  void help();

  Session* session_ = nullptr;
  std::array<Image, 2> zoomed_;
  Image axes_;
  std::vector<TriangleOfPixel> of_pixel_;
  std::array<float, 120> frames_ms_{};
  ImGuiTextFilter filter_;
  std::uint64_t searches_ = 0;
};

void Panel::Contents::prepare(Session& session) {
  session_ = &session;
  std::rotate(frames_ms_.begin(), frames_ms_.begin() + 1, frames_ms_.end());
  frames_ms_.back() = static_cast<float>(state().last_frame_ms);
  if (state().magnifier) of_pixel_ = triangles_of(session.triangles(magnified()), session.focus());
}

// A drop-down for what a key cycles through: choosing an entry presses the key as often as it takes.
void Panel::Contents::choice(std::string_view what, char key, const std::vector<Entry>& entries,
                             std::size_t current, bool ours) {
  ImGui::PushID(key);
  ImGui::AlignTextToFramePadding();
  text(fmt::format("[{}] {}", key, what));
  ImGui::SameLine(10.0f * em());
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::PushStyleColor(ImGuiCol_Text, ours ? kPlain : kNotOurs);
  const bool open = ImGui::BeginCombo("##entries", entries[current].name.c_str(), ImGuiComboFlags_HeightLarge);
  ImGui::PopStyleColor();
  if (!open) {
    tooltip(entries[current].summary);
  } else {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (ImGui::Selectable(entries[i].name.c_str(), i == current))
        for (std::size_t n = current; n % entries.size() != i; ++n) press(key);
      tooltip(entries[i].summary);
    }
    ImGui::EndCombo();
  }
  ImGui::PopID();
}

void Panel::Contents::toggle(const char* what, char key, bool on) {
  // A filled box, not a check mark: the lines of that depend on the processor (imgui_paint.cpp).
  ImGui::PushItemFlag(ImGuiItemFlags_MixedValue, on);
  if (ImGui::Checkbox(fmt::format("[{}] {}", key, what).c_str(), &on)) press(key);
  ImGui::PopItemFlag();
}

void Panel::Contents::button(const char* what, Key key) {
  if (ImGui::Button(what)) session_->press(key);
}

void Panel::Contents::lay_out() {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({window.x - kWidth * em(), 0.0f});
  ImGui::SetNextWindowSize({kWidth * em(), window.y});
  ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
  ImGui::BeginChild("contents", {0.0f, -2.5f * ImGui::GetTextLineHeightWithSpacing()});
  if (state().help) {
    help();
  } else {
    steps();
    methods();
    errors();
    magnifier();
    times();
    triangles();
    if (!state().stream) camera();
  }
  ImGui::EndChild();
  ImGui::Separator();
  if (state().message.empty())
    text("[h] help  [/] search  [o] hide panel\n[p] save a picture  [q] quit", kFaint);
  else
    text(state().message, kStrong);
  ImGui::End();
}

void Panel::Contents::steps() {
  if (session_->steps().empty() || !section("Steps")) return;
  for (std::size_t i = 0; i < session_->steps().size(); ++i) {
    const bool shown = i + 1 == state().step;
    const std::string words = fmt::format("{}. {}", i + 1, session_->steps()[i].notice);
    if (shown)
      text(words, kStrong);
    else if (ImGui::Selectable(words.c_str()))
      session_->take_step(i);
    if (!shown) tooltip(words);
  }
  button("[8] back", key_of('8'));
  ImGui::SameLine();
  button("[5] next", key_of('5'));
}

void Panel::Contents::methods() {
  const tools::Size size = session_->side_size();
  const lab::Choice& c = side().choice;
  text(fmt::format("{}, {} x {} px", tools::printable(state().scene), size.width, size.height), kStrong);
  choice("pictures", 'v', {{"one", ""}, {"side by side", ""}, {"difference", ""}},
         static_cast<std::size_t>(state().arrangement));
  if (session_->side_count() > 1) {
    button("[tab] change the other side", Key::tab);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    text(state().active == 0 ? "now: left" : "now: right", kStrong);
  }
  choice("coverage", 'b', entries_of(lab::drawing_methods()),
         static_cast<std::size_t>(c.coverage - lab::drawing_methods().data()), c.our_coverage());
  choice("clipping", 'x', entries_of(lab::clipping_methods()),
         static_cast<std::size_t>(c.clipping - lab::clipping_methods().data()), c.our_clipping());
  choice("visibility", 'z', entries_of(lab::visibility_methods()),
         static_cast<std::size_t>(c.visibility - lab::visibility_methods().data()), c.our_visibility());
  choice("facing", 'n', entries_of(lab::facing_methods()),
         static_cast<std::size_t>(c.facing - lab::facing_methods().data()), c.our_facing());
  if (!side().because.empty()) text(side().because, kWrong);
  // Coverage methods other than backends use their own depth test (lab/coverage/coverage.h).
  if (c.our_visibility() && !c.our_coverage()) text("depth test: the coverage method's own, in float", kNotOurs);
  toggle("cull front", '1', side().cull_front);
  ImGui::SameLine(13.0f * em());
  toggle("cull back", '2', side().cull_back);
  toggle("edges only", 'y', !c.fills());
  if (!state().stream) {
    ImGui::SameLine(13.0f * em());
    toggle("lighting", 'k', state().lit);
  }
  if (state().reproducible) return;
  std::vector<Entry> targets, threads;
  for (const SimdTarget target : supported_targets())
    targets.push_back({std::string(edgewise::name_of(target)), ""});
  for (const int n : thread_counts()) threads.push_back({std::to_string(n), ""});
  const std::vector<int> counts = thread_counts();
  const auto used = std::find_if(counts.begin(), counts.end(),
                                 [&](int n) { return n >= state().execution.threads; });
  if (used == counts.end()) threads.push_back({std::to_string(state().execution.threads), ""});
  choice("SIMD target", 'i', targets, index_of(supported_targets(), state().execution.target));
  choice("threads", 'j', threads, static_cast<std::size_t>(used - counts.begin()));
}

void Panel::Contents::errors() {
  if (!section("Errors")) return;
  choice("show", 'e', {{"count", ""}, {"count and tint", ""}, {"off", ""}},
         static_cast<std::size_t>(state().errors));
  choice("against", 'u',
         {{"contract", "the library's picture"},
          {"snapped", "exact depths at snapped positions: rounded depths count as errors too"},
          {"floats", "exact at positions before snapping: snapping counts too"}},
         static_cast<std::size_t>(state().truth));
  if (state().arrangement == Arrangement::difference)
    text(fmt::format("{} pixels differ between the sides", state().differing), kWrong);
  if (state().errors == Errors::off) return;
  for (std::size_t i = 0; i < session_->side_count(); ++i) {
    const Side& s = session_->side(i);
    if (!s.judgement) {
      text(name_of(i) + (s.choice.fills() ? "not counted" : "edges only: no errors to count"));
      continue;
    }
    text(fmt::format("{}{}{}", name_of(i), errors_of(*s.judgement),
                     s.judged == state().version ? "" : " (an earlier frame, to keep the frame rate)"),
         s.judgement->wrong > 0 ? kWrong : kPlain);
  }
  const Side& s = side();
  if (!s.judgement) return;
  for (const auto& [mark, what] :
       {std::pair(lab::Mark::gap, "nothing drawn"),
        std::pair(lab::Mark::twice, "drawn twice, or wrong triangle"),
        std::pair(lab::Mark::extra, "outside all triangles")}) {
    swatch(lab::colour_of(mark));
    text(fmt::format("{} {}", s.marked[static_cast<std::size_t>(mark)], what));
  }
}

void Panel::Contents::magnifier() {
  if (!section("Magnifier")) return;
  toggle("at pointer", 'g', state().magnifier);
  ImGui::SameLine(11.0f * em());
  button("[enter] wrong pixel", Key::enter);
  if (!state().magnifier) return;
  const Pixel focus = session_->focus();
  const std::size_t views = state().arrangement == Arrangement::side_by_side ? 2 : 1;
  const int across = 2 * kReach + 1;
  const float room = (kWidth - 3) * em() / static_cast<float>(views),
              pixel_px = std::min(std::floor(room / across), em()), side_px = pixel_px * across;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < views; ++i) {
    const int left = session_->left_of(i);
    zoomed_[i] = around(session_->picture(), left, left + session_->side_size().width, focus, kReach);
    if (i > 0) ImGui::SameLine();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Image(id_of(zoomed_[i]), {side_px, side_px});
    for (int k = 1; k < across; ++k) {
      const float by = pixel_px * static_cast<float>(k);
      list.AddRectFilled({at.x + by, at.y}, {at.x + by + 1.0f, at.y + side_px}, 0x60000000u);
      list.AddRectFilled({at.x, at.y + by}, {at.x + side_px, at.y + by + 1.0f}, 0x60000000u);
    }
    const float corner = pixel_px * kReach;
    list.AddRect({at.x + corner, at.y + corner},
                 {at.x + corner + pixel_px + 1.0f, at.y + corner + pixel_px + 1.0f}, kFocus);
  }
  text(fmt::format("pixel {}, {}; {}{} triangles reach it", focus.x, focus.y, name_of(magnified()),
                   of_pixel_.size()),
       kStrong);
  for (std::size_t i = 0; i < std::min(of_pixel_.size(), kTriangles); ++i) {
    const TriangleOfPixel& t = of_pixel_[i];
    swatch(t.colour);
    text(fmt::format("{}{}", t.index, t.covers() ? fmt::format(", depth {:.6f}", t.depth01) : ", not at the sample"));
    text(fmt::format("  edges {} {} {}", t.edges[0], t.edges[1], t.edges[2]), kFaint);
  }
  if (of_pixel_.size() > kTriangles) text(fmt::format("and {} more", of_pixel_.size() - kTriangles));
  if (!of_pixel_.empty()) text("Edge values at the sample, in 1/65536 square pixels; negative: outside.", kFaint);
}

void Panel::Contents::times() {
  if (state().reproducible || !section("Times")) return;
  const float most = *std::max_element(frames_ms_.begin(), frames_ms_.end());
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::PlotLines("##frames", frames_ms_.data(), static_cast<int>(frames_ms_.size()), 0,
                   fmt::format("{:.1f} ms per frame, at most {:.1f}", state().frame_ms, most).c_str(), 0.0f,
                   most, {0.0f, 3.0f * em()});
  double first_ms = 0;
  for (std::size_t i = 0; i < session_->side_count(); ++i) {
    const Side& s = session_->side(i);
    const double all_ms = s.frontend_ms + s.raster_ms;
    text(fmt::format("{}front end {:.2f} ms, raster {:.2f} ms", name_of(i), s.frontend_ms, s.raster_ms));
    if (i == 0) first_ms = all_ms;
    else if (all_ms < first_ms) text(fmt::format("{:.2f}x faster than the left side", first_ms / all_ms));
    else text(fmt::format("{:.2f}x slower than the left side", all_ms / first_ms));
  }
}

void Panel::Contents::triangles() {
  if (!section("Triangles")) return;
  for (std::size_t i = 0; i < session_->side_count(); ++i) {
    const FrontendStats& n = session_->side(i).stats;
    text(fmt::format("{}{} in, {} outside, {} culled, {}{} drawn", name_of(i), n.triangles,
                     n.whole_mesh + n.outside, n.culled,
                     session_->side(i).choice.our_clipping() ? fmt::format("{} clipped, ", n.clipped) : "",
                     n.emitted));
    if (n.meshes > 1) text(fmt::format("{} objects, {} culled whole", n.meshes, n.meshes_culled));
  }
  toggle("outlines", '6', state().outlines);
  if (state().outlines) {
    ImGui::SameLine();
    text("white: cut by clipping", kFaint);
  }
  if (state().stream) return;
  toggle("vertex numbers", 't', state().labels);
  if (state().labels && session_->vertex_count() > kMostLabels)
    text(fmt::format("{} vertices are too many for labels", session_->vertex_count()), kNotOurs);
  toggle("state of each face", '7', state().face_states);
  for (std::size_t i = 0; i < session_->side_count() && state().face_states; ++i) faces(session_->side(i));
}

void Panel::Contents::faces(const Side& s) {
  if (!s.choice.our_clipping()) return text("this clipping method doesn't report face states", kNotOurs);
  text(summary_of(s.faces));
  if (s.faces.size() > kMostLabels)
    text("too many faces for letters", kNotOurs);
  else
    text(letters_of(s.faces), kStrong);
}

void Panel::Contents::camera() {
  if (!section("Camera and objects")) return;
  const Camera& c = session_->world().scene()->camera;
  text(fmt::format("camera {:.2f} {:.2f} {:.2f}", hundredths(c.position.x), hundredths(c.position.y),
                   hundredths(c.position.z)));
  text(fmt::format("yaw {}, pitch {} degrees", degrees(c.yaw), degrees(c.pitch)));
  text("[w a s d] [space] [shift] move\n[arrows] or drag: look around", kFaint);
  choice("move along", 'm', {{"world axes", ""}, {"camera axes", ""}}, state().along_view ? 1 : 0);
  button("[3] slower", key_of('3'));
  ImGui::SameLine();
  button("[4] faster", key_of('4'));
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  text(fmt::format("speed {:.2g}", state().speed));
  toggle("rotate", 'r', state().spinning);
  ImGui::SameLine(10.0f * em());
  toggle("freeze", 'f', state().frozen);
  ImGui::SameLine();
  text("[,] [.] by hand", kFaint);
  text(fmt::format("{} degrees about {:.2f} {:.2f} {:.2f}", degrees(state().angle), hundredths(state().axis.x),
                   hundredths(state().axis.y), hundredths(state().axis.z)));
  button("[l] about the view", key_of('l'));
  ImGui::SameLine();
  button("[0] reset", key_of('0'));
  axes_ = axes_picture(c, static_cast<int>(6.0f * em()), kBackground);
  ImGui::Image(id_of(axes_), {6.0f * em(), 6.0f * em()});
  ImGui::SameLine();
  text("axes: x red,\ny green, z blue", kFaint);
}

void Panel::Contents::help() {
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (searches_ != state().searches) ImGui::SetKeyboardFocusHere();
  searches_ = state().searches;
  if (ImGui::InputTextWithHint("##search", "[/] search keys and methods", filter_.InputBuf,
                               IM_ARRAYSIZE(filter_.InputBuf)))
    filter_.Build();
  const auto row = [&](std::string_view name, std::string_view does, float indent) {
    if (!filter_.PassFilter(fmt::format("{} {}", name, does).c_str())) return;
    text(name, kStrong);
    ImGui::SameLine(indent * em());
    text(does);
  };
  if (section("Keys"))
    for (const KeyRow& keys : key_table()) row(keys.keys, keys.does, 9.0f);
  const auto methods = [&](const char* title, const auto& all) {
    if (!section(title)) return;
    for (const auto& method : all) row(method.info.name, method.info.summary, 10.0f);
  };
  methods("Coverage methods [b]", lab::drawing_methods());
  methods("Clipping methods [x]", lab::clipping_methods());
  methods("Visibility methods [z]", lab::visibility_methods());
  methods("Facing tests [n]", lab::facing_methods());
}

Panel::Panel(int least_font_scale)
    : context_(ImGui::CreateContext()),
      contents_(std::make_unique<Contents>()),
      least_font_scale_(least_font_scale) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = io.LogFilename = nullptr;
  for (const auto& [key, ours] : {std::pair(ImGuiKey_Backspace, Key::backspace),
                                  std::pair(ImGuiKey_Enter, Key::enter),
                                  std::pair(ImGuiKey_Escape, Key::escape),
                                  std::pair(ImGuiKey_LeftArrow, Key::left),
                                  std::pair(ImGuiKey_RightArrow, Key::right)})
    io.KeyMap[key] = static_cast<int>(ours);
}

Panel::~Panel() {
  ImGui::DestroyContext(context_);
}

int Panel::font_scale(tools::Size window) const {
  const int most = window.width / (2 * kWidth * kFont_px);  // the panel takes half of the window at most
  return std::min(std::max(least_font_scale_, (window.height + 360) / 720), most);
}

int Panel::width_px(tools::Size window) const {
  return font_scale(window) * kWidth * kFont_px;
}

void Panel::set_font(int scale) {
  if (scale == font_scale_) return;
  font_scale_ = scale;
  ImGuiStyle style;
  style.ScaleAllSizes(static_cast<float>(scale));
  style.ScrollbarRounding = style.TabRounding = 0.0f;
  style.WindowBorderSize = 0.0f;
  // Smooth shapes depend on the processor (imgui_paint.cpp), and round ones on the C library's sine.
  style.AntiAliasedLines = style.AntiAliasedLinesUseTex = style.AntiAliasedFill = false;
  ImGui::StyleColorsDark(&style);
  style.Colors[ImGuiCol_WindowBg] = ImGui::ColorConvertU32ToFloat4(kBackground);
  ImGui::GetStyle() = style;
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  ImFontConfig config;
  config.SizePixels = static_cast<float>(kFont_px * scale);
  fonts.AddFontDefault(&config);
  unsigned char* pixels = nullptr;
  fonts.GetTexDataAsRGBA32(&pixels, &font_.width, &font_.height);
  font_.pixels.resize(static_cast<std::size_t>(font_.width) * static_cast<std::size_t>(font_.height));
  for (std::size_t i = 0; i < font_.pixels.size(); ++i) font_.pixels[i] = 0xFFFFFFu | std::uint32_t{pixels[4 * i + 3]} << 24;
  fonts.SetTexID(id_of(font_));
}

const Image& Panel::show(Session& session, tools::Size window) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(window.width), static_cast<float>(window.height)};
  set_font(std::max(font_scale(window), 1));
  const int width = width_px(window);
  const Screen& screen = session.draw(window, width);
  contents_->prepare(session);
  // The layout settles in the second pass; a search box that gets the focus takes text from the third on.
  for (int pass = 0; pass < 3; ++pass) {
    ImGui::NewFrame();
    for (const Key key : std::exchange(released_, {})) io.KeysDown[static_cast<std::size_t>(key)] = false;
    if (std::exchange(mouse_released_, false)) io.MouseDown[0] = false;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const Label& label : screen.labels) {
      const ImVec2 size = ImGui::CalcTextSize(label.words.c_str());
      const ImVec2 at{std::floor(static_cast<float>(label.x) - size.x / 2.0f),
                      std::floor(static_cast<float>(label.y) - size.y / 2.0f)};
      list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, kShadow & 0xA0FFFFFFu);
      list.AddText(at, label.colour, label.words.c_str());
    }
    if (session.state().panel && width > 0) contents_->lay_out();
    ImGui::Render();
  }
  image_ = {window.width, window.height, std::move(image_.pixels)};
  image_.pixels.assign(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height),
                       kBackground);
  paste(screen.picture, 0, 0, image_);
  paint(*ImGui::GetDrawData(), image_);
  picture_width_px_ = screen.picture.width;
  return image_;
}

bool Panel::press(Key key) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.KeysDown[static_cast<std::size_t>(key)] = true;
  return io.WantTextInput;
}

bool Panel::point(Pixel to, bool held) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {static_cast<float>(to.x), static_cast<float>(to.y)};
  if (!held) began_in_panel_ = to.x >= picture_width_px_;
  mouse_released_ = !held && io.MouseDown[0];
  if (held) io.MouseDown[0] = true;
  return began_in_panel_ || io.WantCaptureMouse;
}

void Panel::scroll(float lines) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().MouseWheel += lines;
}

void Panel::type(const char* utf8) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().AddInputCharactersUTF8(utf8);
}

}  // namespace edgewise::viewer
