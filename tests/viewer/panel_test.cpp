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
  // As a window passes them on.
  void press(Key key) {
    if (!panel_.press(key)) session_.press(key);
    panel_.release(key);
    show();
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
  int panel_left() const { return window_.width - panel_.width_px(window_); }

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
  for (const tools::Size window : {tools::Size{960, 540}, tools::Size{1280, 720}, tools::Size{1920, 1080}})
    for (const char* keys : {"", "g", "eg", "h", "vg<enter>", "vv", "67"}) {
      Shown shown(session_of("cubes"), window);
      shown.type(keys);
      const Image& image = shown.show();
      const Image& picture = shown.session().picture();
      ASSERT_EQ(picture.width, shown.panel_left());
      ASSERT_GE(2 * picture.width, window.width);
      if (std::string_view(keys) != "67") {  // letters of faces stand in the picture
        for (int y = 0; y < window.height; ++y)
          ASSERT_TRUE(std::equal(picture.pixels.begin() + y * picture.width,
                                 picture.pixels.begin() + (y + 1) * picture.width,
                                 image.pixels.begin() + y * window.width))
              << keys << ", row " << y;
      }
      std::set<std::uint32_t> colours;
      for (int y = 0; y < window.height; ++y)
        for (int x = picture.width; x < window.width; ++x)
          colours.insert(image.pixels[static_cast<std::size_t>(y * window.width + x)]);
      EXPECT_GT(colours.size(), 5u) << keys;
    }
}

TEST(Panel, LeavesWithTheKeyOOrForLackOfRoom) {
  Shown shown(session_of("cubes"));
  shown.type("o");
  EXPECT_EQ(shown.show().pixels, shown.session().picture().pixels);
  shown.type("hoh");
  EXPECT_TRUE(shown.session().state().panel && shown.session().state().help) << "the help needs the panel";
  Shown narrow(session_of("cubes"), {320, 200});
  EXPECT_EQ(narrow.show().pixels, narrow.session().picture().pixels);
}

TEST(Panel, ShowsTheMethodsAndItsDropDownsFollowTheKeys) {
  Shown shown(session_of("cubes"));
  EXPECT_TRUE(shown.says("[b] coverage"));
  for (const auto& [key, list] : {std::pair('b', lab::methods_of(lab::Family::coverage)),
                                  std::pair('x', lab::methods_of(lab::Family::clipping)),
                                  std::pair('z', lab::methods_of(lab::Family::visibility)),
                                  std::pair('n', lab::methods_of(lab::Family::facing))})
    for (std::size_t i = 0; i < 3; ++i) {
      shown.type(std::string(1, key));
      const lab::StageMethods& c = shown.session().side(0).choice;
      const std::string_view now = key == 'b'   ? c.coverage->info.name
                                   : key == 'x' ? c.clipping->info.name
                                   : key == 'z' ? c.visibility->info.name
                                                : c.facing->info.name;
      EXPECT_NE(widgets(shown.text())[std::string("[") + key + "]"].find(now), std::string::npos) << now;
    }
}

TEST(Panel, ShowsANumberOfThreadsThatNoKeyChooses) {
  Start start = start_with(find_scene("cube").make({}), Cull::back);
  start.execution.threads = tools::default_threads() + 1;
  const std::string threads = std::to_string(start.execution.threads);
  Shown shown(Session(std::move(start)));
  EXPECT_NE(widgets(shown.text())["[j]"].find(threads), std::string::npos);
}

TEST(Panel, ShowsTheSpeed) {
  Shown shown(session_of("cube"));
  EXPECT_TRUE(shown.says("speed 1\n"));
  shown.type("4");
  EXPECT_TRUE(shown.says("speed 1.5\n"));
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
  for (const char* key : {"[v]", "[b]", "[x]", "[z]", "[n]", "[2]", "[k]", "[e]", "[u]", "[i]"})
    EXPECT_TRUE(changed.contains(key)) << key;
  EXPECT_TRUE(changed.contains("[j]") || session_of("cubes").thread_counts().size() == 1);
}

TEST(Panel, EscapeClosesADropDownBeforeItQuits) {
  Shown shown(session_of("cubes"));
  shown.click({shown.panel_left() + 200, 35});
  EXPECT_TRUE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
  shown.press(Key::escape);
  EXPECT_FALSE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
  EXPECT_FALSE(shown.session().done());
  shown.press(Key::escape);
  EXPECT_TRUE(shown.session().done());
}

TEST(Panel, LeavesThePictureItsMouse) {
  Shown shown(session_of("cube"));
  const Camera home = shown.session().world().scene()->camera;
  const auto turned = [&] { return shown.session().world().scene()->camera.yaw != home.yaw; };
  const auto drag = [&](Pixel from, Pixel to) {
    shown.point(from, false);
    shown.show();
    shown.point(from, true);
    shown.show();
    shown.point(to, true);
    shown.show();
    shown.point(to, false);
    shown.show();
  };
  const int edge = shown.panel_left();
  drag({edge + 100, 700}, {edge + 200, 700});
  drag({edge + 100, 700}, {edge - 100, 700});  // begins in the panel
  EXPECT_FALSE(turned());
  drag({edge - 100, 300}, {edge + 50, 300});  // begins in the picture
  EXPECT_TRUE(turned());
}

TEST(Panel, CountsErrorsByKindBesideTheirColours) {
  Shown shown(session_of("cubes"));
  shown.type("<dda_rounded>e");
  const Side& side = shown.session().side(0);
  ASSERT_GT(side.judgement->wrong, 100u);
  EXPECT_TRUE(shown.says(errors_of(*side.judgement)));
  EXPECT_TRUE(shown.says("also pixels hit twice but right"));
  std::uint64_t all = 0;
  for (const auto& [mark, what] :
       {std::pair(lab::Mark::gap, " nothing drawn"), std::pair(lab::Mark::twice, " twice, or wrong triangle"),
        std::pair(lab::Mark::extra, " outside all triangles")}) {
    const std::uint64_t n = side.marked[static_cast<std::size_t>(mark)];
    EXPECT_TRUE(shown.says(std::to_string(n) + what));
    EXPECT_EQ(static_cast<std::uint64_t>(
                  std::count(side.judgement->marks.begin(), side.judgement->marks.end(), mark)),
              n);
    EXPECT_GT(std::count(shown.image().pixels.begin(), shown.image().pixels.end(), lab::colour_of(mark)),
              static_cast<std::ptrdiff_t>(n))
        << "in the picture and in the legend";
    all += n;
  }
  EXPECT_GE(all, side.judgement->wrong);
  shown.type("e");
  EXPECT_FALSE(shown.says("nothing drawn"));
}

TEST(Panel, ListsTheTrianglesOfTheMagnifiedPixel) {
  Shown shown(session_of("cubes"));
  EXPECT_FALSE(shown.says("triangles touch it"));
  shown.type("g");
  const tools::Size side = shown.session().side_size();
  shown.point({side.width / 2, side.height / 2}, false);
  const Pixel focus = shown.session().focus();
  const auto found = triangles_of(shown.session().triangles(0), focus);
  ASSERT_FALSE(found.empty());
  const std::string text = shown.text();
  ASSERT_GT(found.size(), 1u);
  EXPECT_NE(text.find(std::to_string(found.size()) + " triangles touch it"), std::string::npos);
  const auto& edges = found.front().edges;
  EXPECT_NE(text.find(fmt::format(" {} {} {}\n", edges[0], edges[1], edges[2])), std::string::npos);
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

TEST(Panel, HelpListsEveryKeyAndMethodAndIsSearched) {
  Shown shown(session_of("cube"));
  shown.type("h");
  const std::string all = shown.text();
  for (const KeyRow& row : key_table()) {
    EXPECT_NE(all.find(row.keys), std::string::npos) << row.keys;
    EXPECT_NE(all.find(row.does), std::string::npos) << row.does;
  }
  for (const lab::Family family : lab::kFamilies)
    for (const lab::MethodInfo& method : lab::methods_of(family))
      EXPECT_NE(all.find(method.name), std::string::npos) << method.name;
  shown.type("h");
  EXPECT_FALSE(shown.says("number of threads"));

  shown.press(key_of('/'));
  EXPECT_TRUE(shown.says("number of threads"));
  shown.press(key_of('h'));  // as a letter to search for; the help stays
  shown.press(key_of('q'));
  EXPECT_FALSE(shown.session().done());
  shown.panel().type("thread");
  EXPECT_TRUE(shown.says("number of threads"));
  EXPECT_FALSE(shown.says("vertex numbers"));
  shown.press(Key::escape);  // leaves the search
  shown.press(key_of('h'));
  EXPECT_FALSE(shown.session().state().help);
  EXPECT_TRUE(shown.says("[t] vertex numbers"));
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

TEST(Panel, FontGrowsWithTheWindowAndTheDisplay) {
  const Panel usual, dense(2 * Panel::kFont_px);
  EXPECT_EQ(dense.width_px({1920, 720}), 2 * usual.width_px({1280, 720}));
  EXPECT_GT(usual.width_px({1920, 1080}), usual.width_px({1280, 720}));
  EXPECT_EQ(usual.width_px({3840, 2160}), 2 * usual.width_px({1920, 1080}));
  for (const int width : {700, 1000, 1280}) EXPECT_LE(dense.width_px({width, 720}), width / 2);
  EXPECT_GT(dense.width_px({1280, 720}), usual.width_px({1280, 720}));
  EXPECT_EQ(usual.width_px({600, 400}), 0);
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
