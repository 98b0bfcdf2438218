// The panel by Dear ImGui: what it shows, that mouse and keys reach it, and that it never covers the picture.
#ifdef EDGEWISE_IMGUI
#include "viewer/panel/panel.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <set>

#include "viewer/demos.h"
#include "viewer/panel/imgui_paint.h"
#include "viewer/viewer_support.h"

namespace edgewise::viewer {
namespace {

constexpr tools::Size kWindow{960, 720};

// A session with the panel beside it.
class Shown {
 public:
  explicit Shown(Session session, tools::Size window = kWindow)
      : window_(window), session_(std::move(session)) {
    // Dear ImGui can copy all text that a window shows, even what is scrolled out of view, to its clipboard.
    ImGuiContextHook hook;
    hook.Type = ImGuiContextHookType_NewFramePost;
    hook.Callback = [](ImGuiContext*, ImGuiContextHook*) { ImGui::LogToClipboard(); };
    ImGui::AddContextHook(ImGui::GetCurrentContext(), &hook);
    image_ = panel_.show(session_, window_);
  }
  const Image& show() { return image_ = panel_.show(session_, window_); }
  std::string text() {
    show();
    return ImGui::GetClipboardText();
  }
  bool says(std::string_view words) { return text().find(words) != std::string::npos; }
  Session& type(std::string_view keys) {
    session_.type(parse_keys(keys));
    return session_;
  }
  void point(Pixel to, bool held) {
    if (!panel_.point(to, held)) session_.point(to, held);
  }
  void click(Pixel at) {
    point(at, false);
    show();
    point(at, true);
    point(at, false);
    show();
  }
  Session& session() { return session_; }
  Panel& panel() { return panel_; }
  const Image& image() const { return image_; }
  int panel_left() const { return window_.width - Panel::width_px(window_); }

 private:
  tools::Size window_;
  Panel panel_;
  Session session_;
  Image image_;
};

// What each widget shows, by its key in brackets, from "[b] coverage {tiled}" or "[x] [1] cull front".
std::map<std::string, std::string> widgets(const std::string& text) {
  std::map<std::string, std::string> shown;
  for (std::size_t at = text.find('['); at != std::string::npos; at = text.find('[', at + 1)) {
    const std::size_t line = text.rfind('\n', at) + 1, box = at >= line + 4 ? at - 4 : at;
    if (text.find(']', at) == at + 2)  // a key of one character
      shown[text.substr(at, 3)] = text.substr(box, text.find('\n', at) - box);
  }
  return shown;
}

TEST(Panel, StandsBesideThePictureAndNeverOverIt) {
  for (const tools::Size window : {tools::Size{960, 540}, tools::Size{1920, 1080}})
    for (const char* keys : {"", "eg", "h", "vg<enter>", "vv"}) {
      Shown shown(session_of("cubes"), window);
      shown.type(keys);
      const Image& image = shown.show();
      const Image& picture = shown.session().picture();
      ASSERT_EQ(picture.width, shown.panel_left());
      ASSERT_GE(2 * picture.width, window.width);
      std::set<std::uint32_t> colours;
      for (int y = 0; y < window.height; ++y) {
        const auto row = image.pixels.begin() + y * window.width, beside = row + picture.width;
        ASSERT_TRUE(std::equal(row, beside, picture.pixels.begin() + y * picture.width)) << keys << y;
        colours.insert(beside, row + window.width);
      }
      EXPECT_GT(colours.size(), 5u) << keys;
    }
}

TEST(Panel, LeavesWithTheKeyOOrForLackOfRoom) {
  Shown shown(session_of("cubes")), narrow(session_of("cubes"), {320, 200});
  EXPECT_EQ(narrow.show().pixels, narrow.session().picture().pixels);
  shown.type("o");
  EXPECT_EQ(shown.show().pixels, shown.session().picture().pixels);
  shown.type("hoh");
  EXPECT_TRUE(shown.session().state().panel && shown.session().state().help) << "the help needs the panel";
}

TEST(Panel, ShowsTheMethodsThatKeysChoose) {
  Shown shown(session_of("cubes"));
  for (const char* key : {"b", "x", "z", "n"}) {
    const lab::StageMethods c = shown.type(key).side(0).choice;
    auto seen = widgets(shown.text());
    for (const auto& [widget, method] :
         {std::pair("[b]", c.coverage->info.name), std::pair("[x]", c.clipping->info.name),
          std::pair("[z]", c.visibility->info.name), std::pair("[n]", c.facing->info.name)})
      EXPECT_NE(seen[widget].find(method), std::string::npos) << method;
  }
}

// The first click may open a drop-down, and the second one then chooses an entry.
TEST(Panel, ObeysTheMouse) {
  std::set<std::string> changed;
  for (int y = 4; y < 560; y += 7) {
    Shown shown(session_of("cubes"));
    auto before = widgets(shown.text());
    shown.click({shown.panel_left() + 200, y});
    shown.click({shown.panel_left() + 200, y + 45});
    const Image at_once = shown.session().picture();
    for (const auto& [key, now] : widgets(shown.text()))
      if (before[key] != now) changed.insert(key);
    EXPECT_EQ(shown.session().picture().pixels, at_once.pixels) << y;
  }
  for (const char* key : {"[v]", "[b]", "[x]", "[z]", "[n]", "[2]", "[k]", "[e]", "[u]"})
    EXPECT_TRUE(changed.contains(key)) << key;
}

TEST(Panel, WantsEscapeWhileADropDownIsOpen) {
  Shown shown(session_of("cubes"));
  shown.click({shown.panel_left() + 200, 35});
  EXPECT_TRUE(shown.panel().press(Key::escape));
  shown.show();
  EXPECT_FALSE(shown.panel().press(Key::escape));
}

TEST(Panel, LeavesThePictureItsMouse) {
  Shown shown(session_of("cube"));
  const int edge = shown.panel_left();
  const auto yaw = [&] { return shown.session().world().scene()->camera.yaw; };
  for (const auto& [from, to, turns] : {std::tuple{edge + 100, edge + 200, false},
                                        {edge + 100, edge - 100, false},
                                        {edge - 100, edge + 50, true}}) {
    const float before = yaw();
    for (const auto& [x, held] : {std::pair(from, false), {from, true}, {to, true}, {to, false}}) {
      shown.point({x, 700}, held);
      shown.show();
    }
    EXPECT_EQ(yaw() != before, turns) << "from " << from << " to " << to;
  }
}

TEST(Panel, CountsErrorsByKindBesideTheirColours) {
  Shown shown(session_of("cubes"));
  const Side& side = shown.type("<dda_rounded>e").side(0);
  ASSERT_GT(side.judgement->wrong, 100u);
  EXPECT_TRUE(shown.says(errors_of(*side.judgement)));
  std::ptrdiff_t all = 0;
  for (const auto& [mark, what] :
       {std::pair(lab::Mark::gap, " nothing drawn"), std::pair(lab::Mark::twice, " twice, or wrong triangle"),
        std::pair(lab::Mark::extra, " outside all triangles")}) {
    const std::ptrdiff_t n = std::ranges::count(side.judgement->marks, mark);
    EXPECT_TRUE(shown.says(std::to_string(n) + what));
    EXPECT_GT(std::ranges::count(shown.image().pixels, lab::colour_of(mark)), n) << "in the legend, too";
    all += n;
  }
  EXPECT_GE(all, static_cast<std::ptrdiff_t>(side.judgement->wrong));
  shown.type("e");
  EXPECT_FALSE(shown.says("nothing drawn"));
}

TEST(Panel, MagnifiesThePixelUnderThePointer) {
  Shown shown(session_of("cubes"));
  shown.type("g");
  shown.point({12, 34}, false);
  EXPECT_TRUE(shown.says("pixel 12, 34"));
}

TEST(Panel, ListsADemosStepsAndGoesToThem) {
  const Demo& demo = find_demo("pico8-culling");
  std::set<std::size_t> seen;
  for (int y = 4; y < kWindow.height / 4; y += 6) {
    Shown shown{Session(start_of(demo))};
    shown.session().take_step(1);
    for (const Step& step : demo.steps) EXPECT_TRUE(seen.size() > 1 || shown.says(step.notice));
    shown.click({shown.panel_left() + 20, y});
    seen.insert(shown.session().state().step);
  }
  EXPECT_EQ(seen, (std::set<std::size_t>{1, 2, 3, 4, 5}));
}

TEST(Panel, HelpListsEveryKeyAndMethod) {
  Shown shown(session_of("cube"));
  shown.type("h");
  const std::string all = shown.text();
  for (const KeyRow& row : key_table()) EXPECT_NE(all.find(row.does), std::string::npos) << row.does;
  for (const lab::Family family : lab::kFamilies)
    for (const lab::MethodInfo& method : lab::methods_of(family))
      EXPECT_NE(all.find(method.name), std::string::npos) << method.name;
  shown.type("h");
  EXPECT_FALSE(shown.says(key_table()[0].does));
}

TEST(Panel, OfReproducibleSessionsIsTheSameOnAllTargetsAndThreads) {
  std::optional<Image> expected;
  for (const SimdTarget target : supported_targets())
    for (const int threads : {1, 3}) {
      Start start = start_with(find_scene("cubes").make({}), Cull::back);
      start.reproducible = true;
      start.execution = {.threads = threads, .target = target};
      Shown shown(Session(std::move(start)));
      shown.type("<dda_rounded>veg<enter>");
      if (!expected) expected = shown.show();
      EXPECT_EQ(shown.show().pixels, expected->pixels);
      EXPECT_FALSE(shown.says(" ms"));
    }
}

TEST(Panel, FontGrowsWithTheWindow) {
  EXPECT_EQ(Panel::width_px({3840, 2160}), 2 * Panel::width_px({1920, 1080}));
  for (const int width : {700, 1000, 1280}) EXPECT_LE(Panel::width_px({width, 2160}), width / 2);
  EXPECT_EQ(Panel::width_px({600, 400}), 0);
}

// Whole pixels, blended once each, the shared edge of a rectangle's two triangles included.
TEST(ImguiPaint, FillsRectanglesExactly) {
  const Panel panel;  // its context
  Image white{1, 1, {0xFFFFFFFFu}}, image{8, 6, std::vector<std::uint32_t>(48, rgb(0, 0, 0))};
  ImDrawListSharedData shared;
  ImDrawList list(&shared);
  list._ResetForNewFrame();
  list.PushClipRect({0, 0}, {7, 6});
  list.PushTextureID(&white);
  list.PrimReserve(6, 4);
  list.PrimRect({2, 1}, {12, 4}, rgb(200, 100, 0) & 0x80FFFFFFu);
  ImDrawList* lists[] = {&list};
  ImDrawData drawn;
  drawn.CmdLists = lists;
  drawn.CmdListsCount = 1;
  paint(drawn, image);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 8; ++x)
      EXPECT_EQ(image.pixels[static_cast<std::size_t>(8 * y + x)],
                x >= 2 && x < 7 && y >= 1 && y < 4 ? rgb(100, 50, 0) : rgb(0, 0, 0))
          << x << ", " << y;
}

}  // namespace
}  // namespace edgewise::viewer
#endif
