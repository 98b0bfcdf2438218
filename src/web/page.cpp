// The program of the page (page.html): draws a few triangles by the laboratory's coverage methods, and marks
// wrong pixels and cracks by its exact truth. JavaScript calls the exported functions, and reads and writes
// their memory.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/grid.h"
#include "edgewise/backend.h"
#include "edgewise/builtin.h"
#include "edgewise/contract.h"
#include "edgewise/hash.h"
#include "lab/coverage/cracks.h"
#include "lab/error_marks.h"
#include "lab/needs/needs.h"

#define EXPORT(name) extern "C" [[clang::export_name(#name)]]

namespace edgewise::lab {

namespace {

constexpr int kLargestSide = 401;  // of the cases that are shown

// Whether gmpxx.h is exact for such a coordinate.
bool is_exact(float px) {
  return std::abs(px) < 0x1p12f && std::rint(px * 0x1p32f) == px * 0x1p32f;
}

CoverageScene scene;
bool from_front_end = false;
std::optional<CoverageTruth> truth;  // of the scene, and the hash of the library's picture: none until judged
std::uint64_t hash;

// What judge() found. All members have 32 bits, the pointers too.
struct Verdict {
  std::uint32_t width, height, triangle_count;
  const FloatTriangle* triangles;
  const std::uint32_t* visible;  // row by row: 1 + a triangle's index, or 0
  const Mark* marks;             // row by row
  std::uint32_t wrong, gaps, double_hits, covered, hash_low, hash_high;  // the hash: of the library's picture
} verdict;
std::vector<std::uint32_t> visible;
std::vector<Mark> marks;

std::vector<CoverageCase> cases() {
  std::vector<CoverageCase> list;
  for (const CoverageCase& c : coverage_cases()) {
    if (c.size.width > kLargestSide || c.size.height > kLargestSide) continue;
    bool exact = true;
    for (const FloatTriangle& t : c.make())
      for (int i = 0; i < 3; ++i) exact &= is_exact(t.at.x_px[i]) && is_exact(t.at.y_px[i]);
    if (exact) list.push_back(c);
  }
  return list;
}

// A line per entry, with tabs between its fields.
template <typename List, typename... Field>
const char* lines(const List& list, Field... field) {
  static std::string joined;
  joined.clear();
  for (const auto& entry : list) {
    ((joined += field(entry), joined += '\t'), ...);
    joined.back() = '\n';
  }
  return joined.c_str();
}

void open(CoverageScene next, bool with_front_end) {
  scene = std::move(next);
  from_front_end = with_front_end;
  truth.reset();
  for (std::uint32_t i = 0; i < scene.floats.size(); ++i) {
    scene.floats[i].payload = i + 1;
    if (from_front_end) scene.snapped[i].payload = i + 1;
  }
}

std::string why(const Question& question) {
  const Answer* const weaker = question.next_weaker();
  if (!question.proof.empty() || weaker == nullptr) return question.proof;
  return fmt::format("not enough: {}, with {} {}{}, as at ({}, {})", weaker->name, weaker->wrong_px,
                     question.error, weaker->wrong_px == 1 ? "" : "s", weaker->witness->x_px,
                     weaker->witness->y_px);
}

std::uint32_t count(std::uint64_t n) {
  return static_cast<std::uint32_t>(n);
}

}  // namespace

EXPORT(methods) const char* methods() {
  return lines(
      coverage_methods(), [](const auto& m) { return m.info.name; },
      [](const auto& m) { return m.info.summary; },
      [](const auto& m) { return m.promise.snap_bits ? std::to_string(*m.promise.snap_bits) : "none"; });
}

EXPORT(cases) const char* case_list() {
  return lines(
      cases(), [](const auto& c) { return c.name; }, [](const auto& c) { return c.summary; });
}

EXPORT(open_case) void open_case(int index) {
  const CoverageCase chosen = cases()[static_cast<std::size_t>(index)];
  open({chosen.size, chosen.make(), {}}, false);
}

// The tutorials' cube. While it is not turned, the diagonal of its front face runs through samples, up to the
// rounding of the front end.
EXPORT(open_cube) void open_cube(float angle) {
  Scene cube = std::get<Scene>(find_scene("cube").make({}));
  cube.instances[0].axis = {0.0f, 1.0f, 0.0f};
  cube.instances[0].angle = angle;
  cube.camera = {};
  cube.camera.position = {0.0f, 0.0f, 3.0f};
  cube.camera.fov_y = 1.5707964f;  // 90 degrees
  open(coverage_scene_of_floats(cube, {.width = 160, .height = 96}), true);
}

// Makes room for triangles. The caller writes their positions, and calls judge().
EXPORT(open_triangles) FloatTriangle* open_triangles(int triangles, int width, int height) {
  open({{width, height}, std::vector<FloatTriangle>(static_cast<std::size_t>(triangles)), {}}, false);
  return scene.floats.data();
}

EXPORT(judge) const Verdict* judge(int index) {
  const CoverageMethod& method = coverage_methods()[static_cast<std::size_t>(index)];
  if (!truth) {
    if (!from_front_end) scene.snapped = snapped(scene.floats);
    truth = float_coverage(scene.input(), scene.window(), 1);
    Framebuffer picture(scene.size.width, scene.size.height);
    find_backend("tiled").make()->draw(scene.snapped, picture.view(), {0xFF000000});
    hash = hash_of(picture.view());
  }
  const DrawnRuns drawn(method, scene.input(), scene.window());
  const Cracks cracks = CrackJudge(scene.floats, *truth).find(drawn, method.promise.snap_bits);
  const CoverageScore score = score_coverage(*truth, drawn, scene.floats);
  marks = mark_coverage(*truth, drawn, cracks, FloatSource(scene.floats)).marks;

  Canvas canvas(scene.size.width, scene.size.height);
  method.draw(scene.input(), canvas, {});
  visible.clear();
  for (int y = 0; y < scene.size.height; ++y) {
    const std::uint32_t* const row = canvas.frame.payload_row(y);
    visible.insert(visible.end(), row, row + scene.size.width);
  }
  verdict = {static_cast<std::uint32_t>(scene.size.width),
             static_cast<std::uint32_t>(scene.size.height),
             count(scene.floats.size()),
             scene.floats.data(),
             visible.data(),
             marks.data(),
             count(score.errors()),
             count(cracks.gaps.size() + cracks.t_gaps.size()),
             count(cracks.double_hits.size() + cracks.t_double_hits.size()),
             count(truth->covered),
             static_cast<std::uint32_t>(hash),
             static_cast<std::uint32_t>(hash >> 32)};
  return &verdict;
}

// What the edges of the shown triangles need: question, answer, reason.
EXPORT(needs) const char* needs() {
  TriangleStream stream;
  for (const auto& [at, payload] : scene.floats) {
    StreamTriangle& t = stream.triangles.emplace_back();
    for (int i = 0; i < 3; ++i) t.vertex[i] = {at.x_px[i], at.y_px[i], at.z01[i]};
  }
  const Drawable drawable = std::move(stream);
  const StudiedFrame frame{
      0, drawable, {.width = scene.size.width, .height = scene.size.height, .cull = Cull::none}};
  CoverageNeeds coverage({});
  coverage.add(frame, scene, 1);
  Ranges ranges;
  ranges.add(frame);
  std::vector<Question> questions = coverage.questions();
  questions.push_back(ranges.edge_values(Coarse::kSubBits));
  return lines(
      questions, [](const Question& q) { return q.name; },
      [](const Question& q) { return q.needed() == nullptr ? "none is enough" : q.needed()->name; }, why);
}

}  // namespace edgewise::lab
