// Drives a viewer session by keys and mouse, as a window does, and checks pictures, error counts and saved
// files; parses terminal input, and shows pictures in a terminal.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "edgewise/draw.h"
#include "edgewise/image.h"
#include "edgewise/tri_file.h"
#include "lab/clipping/clipping.h"
#include "message_of.h"
#include "temp_dir.h"
#include "viewer/terminal_io.h"
#include "viewer/viewer_support.h"

namespace edgewise::viewer {
namespace {

Image rendered(std::string_view scene, Cull cull, tools::Size size = kTestSize,
               const BackendInfo& backend = find_backend("naive")) {
  Frontend frontend;
  Framebuffer frame(size.width, size.height);
  draw(find_scene(scene).make({size.width, size.height}), frontend,
       {.width = size.width, .height = size.height, .cull = cull}, *backend.make(), frame.view(),
       {rgb(0, 0, 0)});
  return to_image(frame);
}

// A quad, clockwise as given.
void add_quad(Scene& scene, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d,
              std::uint32_t colour = rgb(200, 200, 200)) {
  scene.instances.push_back({.mesh = scene.meshes.size()});
  scene.meshes.push_back({{a, b, c, d}, {}, {}});
  scene.meshes.back().add_quad({0, 1, 2, 3}, colour);
}

// Two squares; the nearer one is submitted first.
Scene near_then_far() {
  Scene scene;
  for (const float z : {-2.0f, -4.0f})
    add_quad(scene, {-1, 1, z}, {1, 1, z}, {1, -1, z}, {-1, -1, z},
             z > -3.0f ? rgb(250, 20, 20) : rgb(20, 250, 20));
  return scene;
}

// A floor that passes below the camera.
void add_floor(Scene& scene) {
  add_quad(scene, {-9, -1, -9}, {9, -1, -9}, {9, -1, 9}, {-9, -1, 9});
}

std::uint64_t wrong(const Session& session) {
  return session.side(0).judgement.value().wrong;
}

TEST(ViewerKeys, EachHasOneMeaningAndEachCommandAKey) {
  std::set<Key> keys;
  std::set<Command> commands;
  for (const KeyRow& row : key_table()) {
    for (const Binding& binding : row.bindings) {
      EXPECT_TRUE(keys.insert(binding.key).second) << row.keys;
      commands.insert(binding.command);
      EXPECT_EQ(command_of(binding.key), binding.command);
    }
  }
  EXPECT_EQ(commands.size(), static_cast<std::size_t>(Command::quit) + 1);
}

TEST(ViewerKeys, AreReadFromText) {
  const auto strokes = parse_keys("w<tab>B<1.5>");
  ASSERT_EQ(strokes.size(), 4u);
  EXPECT_EQ(std::get<Key>(strokes[1]), Key::tab);
  EXPECT_EQ(std::get<Key>(strokes[2]), key_of('b'));
  EXPECT_EQ(std::get<double>(strokes[3]), 1.5);
  EXPECT_EQ(std::get<Named>(parse_keys("<float_lt>").front()).method, "float_lt");
  for (const std::string wrong : {"<tabb>", "<-1>", "<nan>", "<tab", "%"})
    EXPECT_NE(message_of([&] { parse_keys("b" + wrong); }), "") << wrong;
}

TEST(Viewer, ShowsTheLibrarysBits) {
  Session session = session_of("cubes");
  for (const BackendInfo& backend : {find_backend("naive"), wireframe()}) {
    for (const auto& [keys, cull] : {std::pair("", Cull::back), std::pair("1", Cull::both),
                                     std::pair("2", Cull::front), std::pair("1", Cull::none)})
      EXPECT_EQ(type(session, keys).picture.pixels, rendered("cubes", cull, kTestSize, backend).pixels);
    type(session, "2y");
  }
  EXPECT_EQ(session.side(0).choice.coverage->info.name, "tiled");  // as before the wireframe
  // Painter's methods draw filled triangles only, so the wireframe key changes nothing.
  const Image sorted = type(session, "z").picture;
  EXPECT_EQ(type(session, "y").picture.pixels, sorted.pixels);
  EXPECT_NE(session.side(0).because.find("no wireframe"), std::string::npos);
}

TEST(Viewer, CyclesThroughAllCoverageMethodsAndExactOnesHaveNoErrors) {
  Session session = session_of("cubes");
  for (std::size_t i = 0; i < lab::drawing_methods().size(); ++i) {
    type(session, "b");
    const lab::CoverageMethod& method = *session.side(0).choice.coverage;
    const auto& judgement = session.side(0).judgement;
    EXPECT_EQ(judgement.has_value(), method.fills) << method.info.name;
    if (!judgement) continue;
    if (method.contract_depth) {
      EXPECT_EQ(judgement->wrong, 0u) << method.info.name;
    } else if (method.info.exact) {
      EXPECT_EQ(judgement->gaps.value() + judgement->double_hits.value(), 0u) << method.info.name;
    } else if (method.info.name == "whole_pixel") {
      EXPECT_GT(judgement->wrong, 100u);
    }
  }
  EXPECT_EQ(session.side(0).choice.coverage->info.name, "tiled");
  type(session, "b<backspace><backspace>");
  EXPECT_EQ(session.side(0).choice.coverage->info.name, "naive");
}

// The reference picture comes from the scene, so what a front end loses counts as well.
TEST(Viewer, ReplacesEachStageAlone) {
  Scene floor;
  add_floor(floor);
  for (const auto& [scene, cull, name, errors] :
       {std::tuple(near_then_far(), Cull::back, "submission_order", 500u),
        std::tuple(floor, Cull::none, "none", 5000u), std::tuple(box_aside(), Cull::back, "normal_z", 100u),
        std::tuple(lab::floor_far_from_origin(1 << 26).scene, Cull::none, "matrix_float", 5000u)}) {
    Session session = session_of(scene, cull);
    type(session, "");
    EXPECT_EQ(wrong(session), 0u);
    type(session, "<" + std::string(name) + ">");
    EXPECT_EQ(describe(session.side(0).choice), name);
    EXPECT_GT(wrong(session), errors);
  }
  Session box = session_of(box_aside());
  type(box, "<normal_dot_eye>");
  EXPECT_EQ(wrong(box), 0u) << "correct under perspective";
}

TEST(Viewer, CombinesEveryMethodOfEveryStage) {
  Session session = session_of("cubes");
  for (const auto& [key, count] : {std::pair{"x", lab::clipping_methods().size()},
                                   {"z", lab::visibility_methods().size()},
                                   {"n", lab::facing_methods().size()}})
    for (std::size_t i = 0; i < count; ++i) {
      type(session, key);
      const lab::StageMethods& choice = session.side(0).choice;
      // The whole scene is in view, and its depths differ clearly.
      const bool errs = choice.visibility->stored01 == nullptr || choice.facing->info.name == "normal_z" ||
                        choice.facing->info.name == "normal_dot_object";
      EXPECT_TRUE(errs || wrong(session) < 20u) << describe(choice);
    }
  EXPECT_TRUE(session.side(0).choice.ours());
}

TEST(Viewer, ExplainsWhichMethodsCannotBeCombined) {
  Session session = session_of("cubes");
  type(session, "bbz");
  EXPECT_NE(session.side(0).because.find("covers exactly by itself"), std::string::npos);
  Session stream = session_of("grid64");
  type(stream, "x");
  EXPECT_NE(stream.side(0).because.find("no camera"), std::string::npos);
  EXPECT_EQ(wrong(stream), 0u);
  type(stream, "wr<up>0t");  // these keys do nothing for a stream
  EXPECT_TRUE(stream.still());
}

TEST(Viewer, JudgesAgainstEachTruth) {
  Session session = session_of("cubes");
  for (const Truth truth : {Truth::contract, Truth::snapped, Truth::floats}) {
    type(session, "");
    EXPECT_EQ(session.state().truth, truth);
    EXPECT_LE(wrong(session), truth == Truth::floats ? 60u : 0u);
    EXPECT_GT(session.side(0).judgement->covered, 3000u);
    type(session, "u");
  }
}

TEST(Viewer, TintsWrongPixelsAndMovesTheMagnifierToThem) {
  Session session = session_of(near_then_far());
  const Image plain = type(session, "<submission_order>").picture;
  const Screen& screen = type(session, "e");
  std::uint64_t tinted = 0;
  for (std::size_t i = 0; i < plain.pixels.size(); ++i)
    if (screen.picture.pixels[i] != plain.pixels[i]) {
      ++tinted;
      EXPECT_EQ(screen.picture.pixels[i], lab::colour_of(lab::Mark::twice));
    }
  EXPECT_EQ(tinted, wrong(session));
  std::set<std::string> messages;
  for (const auto& [keys, says] : {std::pair("<enter>", "wrong pixel at"),
                                   {"<enter>", "wrong pixel at"},
                                   {"<contract31><enter>", "no wrong pixel"},
                                   {"e<enter>", "errors are not counted"}}) {
    type(session, keys);
    EXPECT_TRUE(session.state().message.starts_with(says)) << session.state().message;
    EXPECT_TRUE(messages.insert(session.state().message).second);
  }
  EXPECT_TRUE(session.state().magnifier);
}

TEST(Annotations, MagnifiesThePixelsAroundAFocusOfOnePicture) {
  Image image{4, 3, {}};
  for (std::uint32_t i = 0; i < 12; ++i) image.pixels.push_back(rgb(i, i, i));
  const Image part = around(image, 2, 4, {1, 0}, 1);  // of the right half
  const std::uint32_t none = rgb(0, 0, 0);
  EXPECT_EQ(part.width, 3);
  EXPECT_EQ(part.pixels, (std::vector<std::uint32_t>{none, none, none, rgb(2, 2, 2), rgb(3, 3, 3), none,
                                                     rgb(6, 6, 6), rgb(7, 7, 7), none}));
}

TEST(Viewer, LooksAroundByDragOrArrows) {
  Session session = session_of("cube");
  const Image home = type(session, "").picture;
  const Camera at_home = session.world().scene()->camera;
  const Camera& camera = session.world().scene()->camera;
  session.point({100, 80}, false);
  EXPECT_EQ(session.draw(kTestSize).picture.pixels, home.pixels);
  session.point({120, 70}, true);
  EXPECT_LT(camera.yaw, at_home.yaw);  // to the right
  EXPECT_GT(camera.pitch, at_home.pitch);
  EXPECT_NE(session.draw(kTestSize).picture.pixels, home.pixels);
  EXPECT_EQ(type(session, "0").picture.pixels, home.pixels);
  type(session, "<up><left>");
  EXPECT_GT(camera.yaw, at_home.yaw);
  EXPECT_GT(camera.pitch, at_home.pitch);
  for (int i = 0; i < 40; ++i) session.point({100, 80 - i * 100}, true);
  EXPECT_LE(camera.pitch, 1.5708f);
}

TEST(Viewer, TurnsAMeshFarFrom0AboutItsMiddle) {
  Scene scene;
  const glm::dvec3 at(-2'487'002.88, -4'684'683.67, 3'529'638.98), half(0.01);
  scene.meshes.push_back({.positions = {}, .triangles = {{0, 1, 2}}, .colours = {1}});
  scene.meshes[0].set_positions(std::vector{at - half, at + half, at + 0.5 * half});
  scene.instances.emplace_back();
  World world(scene);
  world.turn({0, 1, 0}, 3.0f);
  const Bounds box = bounds_of(*world.scene());
  EXPECT_LT(glm::distance(0.5 * (box.low + box.high), at), 1e-8);
}

TEST(Viewer, MovesAlongTheViewOrTheWorld) {
  Session session = session_of("cube");
  type(session, "");
  const glm::dvec3 home = session.world().scene()->camera.position;
  const auto moved = [&](std::string_view keys) {
    type(session, keys);
    const glm::dvec3 by = session.world().scene()->camera.position - home;
    type(session, "0");
    return by;
  };
  EXPECT_LT(moved("w").z, -0.05f);
  EXPECT_LT(moved("w").y, -0.01f);  // the camera looks down
  EXPECT_GT(moved("d").x, 0.05f);
  EXPECT_LT(moved("<shift>").y, -0.05f);
  EXPECT_EQ(moved("c"), moved("<shift>"));
  type(session, "m");
  EXPECT_LT(moved("w").z, -0.05f);
  EXPECT_EQ(moved("w").y, 0.0f);
  EXPECT_EQ(moved("<space>").z, 0.0f);
  const double slow = moved("<space>").y;
  EXPECT_GT(moved("44<space>").y, 2.0 * slow);
  for (const char key : {'w', 'd'}) session.press(key_of(key));
  session.release(key_of('w'));
  EXPECT_FALSE(session.still());
  session.release(key_of('d'));
  EXPECT_TRUE(session.still());
}

TEST(Viewer, TurnsObjects) {
  Session session = session_of("cube");
  const Image home = type(session, "").picture;
  EXPECT_NE(type(session, "r<1>").picture.pixels, home.pixels);
  EXPECT_GT(session.state().angle, 0.5f);
  EXPECT_FALSE(session.still());
  EXPECT_EQ(type(session, "r0").picture.pixels, home.pixels);
  EXPECT_EQ(session.side(0).judged, session.state().version);
  type(session, "r<1>");
  const glm::mat4 model = model_matrix({}, session.world().scene()->instances[0]);
  EXPECT_NEAR(glm::length(glm::vec3(model[3])), 0.0f, 1e-5f) << "the cube's centre stays in place";
  EXPECT_NEAR(glm::determinant(glm::mat3(model)), 1.0f, 1e-5f);
}

TEST(Viewer, ComparesTwoSides) {
  Session session = session_of("cubes");
  const Screen& halves = type(session, "v");
  const Image half = rendered("cubes", Cull::back, {kTestSize.width / 2, kTestSize.height});
  Image both = halves.picture;
  for (const int left : {0, half.width}) paste(half, left, both);
  EXPECT_EQ(both.pixels, halves.picture.pixels);
  type(session, "<tab><submission_order>");
  EXPECT_EQ(session.side(0).judgement->wrong, 0u);
  EXPECT_GT(session.side(1).judgement->wrong, 100u);
  const Screen& apart = type(session, "v");
  std::uint64_t red = 0;
  for (const std::uint32_t pixel : apart.picture.pixels)
    red += (pixel & 0xFFFFFFu) != 0 && (pixel & 0xFFFF00u) == 0;
  EXPECT_EQ(red, session.state().differing);
  EXPECT_GT(red, 100u);
  type(session, "<enter>");
  EXPECT_NE(session.state().message.find("first difference"), std::string::npos);
  type(session, "v<tab>");
  EXPECT_NE(session.state().message.find("one side only"), std::string::npos);
}

TEST(Viewer, FocusesTheSamePixelOfEitherSide) {
  constexpr tools::Size kOdd{241, 160};  // a column between the sides belongs to none
  Session session = session_of("cubes");
  type(session, "v", kOdd);
  ASSERT_EQ(session.left_of(1), 121);
  for (const auto& [to, seen] : {std::pair(Pixel{5, 7}, Pixel{5, 7}),
                                 {{119, 7}, {119, 7}},
                                 {{120, 7}, {119, 7}},
                                 {{121, 7}, {0, 7}},
                                 {{240, 159}, {119, 159}},
                                 {{999, -9}, {119, 0}},
                                 {{-9, 999}, {0, 159}}}) {
    session.point(to, false);
    EXPECT_EQ(std::pair(session.focus().x, session.focus().y), std::pair(seen.x, seen.y));
  }
}

// Saves in `folder`.
Session session_into(const std::filesystem::path& folder, std::string_view scene) {
  Start start = start_with(find_scene(scene).make({}), Cull::back);
  start.folder = folder;
  return Session(std::move(start));
}

TEST(Viewer, SavedStreamsRenderTheSamePictureAndReplaceNoFile) {
  const TempDir folder;
  folder.write("test-0001.png", "older");
  folder.write("test-0002.tri", "older");
  Session session = session_into(folder.path(), "cubes");
  type(session, "w<left>p");
  const auto saved = session.saved();
  ASSERT_EQ(saved,
            (std::vector<std::string>{folder.path() / "test-0003.png", folder.path() / "test-0003.tri"}));
  EXPECT_EQ(file_content(folder.path() / "test-0001.png"), "older");
  EXPECT_EQ(folder.count(), 4u);
  const Image picture = read_image(saved[0]);
  EXPECT_EQ(picture.pixels, session.draw(kTestSize).picture.pixels);
  Session replay = session_of(read_tri(saved[1]), Cull::none);
  EXPECT_EQ(type(replay, "").picture.pixels, picture.pixels);
}

TEST(Viewer, ReportsAFailedSave) {
  Session session = session_into("/proc/none", "cube");
  type(session, "p");
  EXPECT_NE(session.state().message.find("not saved"), std::string::npos);
  EXPECT_TRUE(session.saved().empty());
}

// Three quads (a front face, a back face, one behind the camera) and a floor that passes below the camera.
TEST(Viewer, ShowsTheStateOfEachFace) {
  constexpr tools::Size kLarge{640, 480};
  Scene scene;
  add_quad(scene, {-1, 1, -4}, {1, 1, -4}, {1, 0, -4}, {-1, 0, -4});
  add_quad(scene, {1, 1, -5}, {-1, 1, -5}, {-1, 0, -5}, {1, 0, -5});
  add_quad(scene, {-1, 1, 4}, {1, 1, 4}, {1, 0, 4}, {-1, 0, 4});
  add_floor(scene);
  Session session = session_of(scene);
  // The last row: the same with a facing method of src/lab, which doesn't clip.
  for (const auto& [keys, active, culled, summary] :
       {std::tuple("", 0, 0, ""),
        {"7", 1, 1, "a 1 active, c 1 clipped, b 1 culled by facing, - 1"},
        {"2", 2, 0, "a 2 active, c 1 clipped, - 1"},
        {"2<normal_dot_eye>", 1, 1, "a 1 active, c 1 clipped, b 1 culled by facing, - 1"}}) {
    const Screen& screen = type(session, keys, kLarge);
    EXPECT_TRUE(summary_of(session.side(0).faces).starts_with(summary));
    EXPECT_EQ(labels(screen, "a"), active);
    EXPECT_EQ(labels(screen, "b"), culled);
    EXPECT_EQ(labels(screen, "-"), 0) << "behind the camera";
  }
  EXPECT_TRUE(type(session, "<screen_linear>", kLarge).labels.empty()) << "it doesn't report face states";
  scene.meshes[1].flags = {kTwoSided, kTwoSided | kSameFace};
  Session two_sided = session_of(scene);
  EXPECT_EQ(labels(type(two_sided, "7", kLarge), "A"), 1);
  Session knot = session_of("torus-knot");
  EXPECT_TRUE(type(knot, "7", kLarge).labels.empty()) << "too many faces for letters";
  EXPECT_GT(knot.side(0).faces.size(), kMostLabels);
}

TEST(Viewer, FitsAnySize) {
  const TempDir folder;
  for (const tools::Size size : {tools::Size{1, 1}, tools::Size{2, 3}, tools::Size{33, 9},
                                 tools::Size{320, 200}, tools::Size{700, 20}, tools::Size{20, 700}}) {
    Session session = session_into(folder.path(), "cube");
    for (const char* keys : {"egt", "v", "<tab>bbb", "v<enter>", "ohp"}) {
      const Screen& screen = type(session, keys, size);
      ASSERT_EQ(screen.picture.pixels.size(), static_cast<std::size_t>(size.width * size.height));
    }
  }
}

TEST(Viewer, CountsErrorsOfLargeScenesOnRequestOnly) {
  Session large = session_of("terrain"), small = session_of("sphere");
  type(large, "");
  EXPECT_FALSE(large.side(0).judgement);
  EXPECT_NE(large.state().message.find("[e] counts them"), std::string::npos);
  type(small, "");
  EXPECT_TRUE(small.side(0).judgement);
}

TEST(TerminalInput, GivesKeysOnceTheirSequencesAreComplete) {
  struct Row {
    std::string bytes;
    bool paused;
    std::vector<Key> keys;
  };
  const Key b = key_of('b'), q = key_of('q');
  std::string pending;
  for (const auto& [bytes, paused, keys] : std::vector<Row>{
           {"wB\r\t\x7f \x1b[A\x1bOD",
            false,
            {key_of('w'), b, Key::enter, Key::tab, Key::backspace, Key::space, Key::up, Key::left}},
           {"\x1b", false, {}},
           {"[", false, {}},
           {"Cq", false, {Key::right, q}},
           {"\x1b", false, {}},
           {"", true, {Key::escape}},
           {"\x1bq", false, {Key::escape, q}},
           {"\x1b[15~\x1b[1;5Zb", false, {b}},
           {"\x1b[" + std::string(1000, '1'), false, {}},
           {"", true, {}},
           {"b", false, {b}},
           {"", true, {}}}) {
    pending += bytes;
    EXPECT_EQ(take_keys(pending, paused), keys) << bytes;
  }
}

TEST(TerminalPicture, ShowsTwoPixelsInEachCharacterLabelsOverThemAndAStatusBelow) {
  TerminalPicture picture;
  Screen screen{{2, 4, {rgb(1, 2, 3), rgb(4, 5, 6), rgb(7, 8, 9), rgb(4, 5, 6), 0, 0, 0, 0}}, {}};
  screen.labels = {{2, 2, "Q?", rgb(250, 251, 252)}, {0, 2, "?P", rgb(250, 251, 252)}};
  const std::string bytes = picture.show(screen, "status");
  EXPECT_NE(bytes.find("\x1b[38;2;1;2;3m\x1b[48;2;7;8;9m\xe2\x96\x80"), std::string::npos) << bytes;
  EXPECT_NE(bytes.find("\x1b[48;2;4;5;6m "), std::string::npos) << bytes;
  EXPECT_NE(bytes.find("PQ"), std::string::npos);
  EXPECT_EQ(bytes.find("?"), std::string::npos);  // beyond the borders
  EXPECT_NE(bytes.find("\x1b[3;1H"), std::string::npos);
  EXPECT_TRUE(bytes.ends_with("st")) << bytes;
}

TEST(TerminalPicture, SendsOnlyChangedRows) {
  TerminalPicture picture;
  Screen screen{{3, 20, std::vector<std::uint32_t>(60, rgb(9, 9, 9))}, {}};
  EXPECT_NE(picture.show(screen, "").find("\x1b[2J"), std::string::npos);
  EXPECT_EQ(picture.show(screen, ""), "");
  screen.picture.pixels[7] = rgb(200, 9, 9);
  EXPECT_EQ(picture.show(screen, ""), "\x1b[2;1H\x1b[48;2;9;9;9m \x1b[38;2;200;9;9m\xe2\x96\x80 ");
  screen.picture = {20, 3, std::vector<std::uint32_t>(60, rgb(9, 9, 9))};
  EXPECT_NE(picture.show(screen, "").find("\x1b[2J"), std::string::npos);
}

}  // namespace
}  // namespace edgewise::viewer
