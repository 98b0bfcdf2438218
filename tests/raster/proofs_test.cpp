// Compares the proofs' definitions (tests/proofs/contract.smt2) with the functions of contract.h: for
// many arguments, the solver must find the code's values.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

#include "edgewise/contract.h"
#include "run_program.h"
#include "support.h"

namespace edgewise::testing {
namespace {

using namespace contract;

// SMT-LIB writes negative numbers as applications of `-`.
std::string text(int128 v) {
  return v < 0 ? fmt::format("(- {})", -v) : fmt::format("{}", v);
}
template <typename... Texts>
std::string call_text(std::string_view function, const Texts&... arguments) {
  return fmt::format("({} {})", function,
                     fmt::join(std::array<std::string, sizeof...(Texts)>{std::string(arguments)...}, " "));
}
template <typename... Numbers>
std::string call(std::string_view function, Numbers... v) {
  return call_text(function, text(v)...);
}
// The same for functions over the reals.
template <typename... Numbers>
std::string call_real(std::string_view function, Numbers... v) {
  return call_text(function, call("to_real", v)...);
}

class Equations {
 public:
  void add(const std::string& term, const std::string& value) {
    wrong_ += fmt::format("\n  (not (= {} {}))", term, value);
    ++count_;
  }
  void add(const std::string& term, int128 value) { add(term, text(value)); }
  int count() const { return count_; }

  // Asks the solver whether one of the equations is wrong.
  std::string solve() const {
    const TempDir folder;
    const std::string definitions = EDGEWISE_SOURCE_DIR "/tests/proofs/contract.smt2";
    const auto script = folder.write(
        "equations.smt2", file_content(definitions) + "(assert (or" + wrong_ + "))\n(check-sat)\n");
    return run_program("z3", "-T:60 '" + script.string() + "'").out;
  }

 private:
  std::string wrong_;
  int count_ = 0;
};

void add_coverage(Equations& equations, const ScreenTriangle& triangle, int px, int py) {
  const auto& [x, y, z, payload] = triangle;
  const std::int64_t area = signed_area(triangle);
  equations.add(call_real("signed_area", x[0], y[0], x[1], y[1], x[2], y[2]), area);
  const PixelBox box = pixel_box(triangle, kMaxImageSide, kMaxImageSide);
  const auto [min_x, max_x] = std::minmax({x[0], x[1], x[2]});
  if (box.x0 > 0) equations.add(call("first_sample", min_x), box.x0);
  if (box.x1 < kMaxImageSide) equations.add(call("first_sample", max_x), box.x1);
  equations.add(call("sample_q15", px), sample_q15(px));
  if (area == 0) return;
  const Oriented t = orient(triangle);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Edge edge = make_edge(t, i);
    const std::string a = call_real("edge_a", t.y[i], t.y[j]), b = call_real("edge_b", t.x[i], t.x[j]);
    equations.add(a, edge.a);
    equations.add(b, edge.b);
    equations.add(call_text("top_left", a, b), is_top_left(edge.a, edge.b) ? "true" : "false");
    const std::string e =
        call_real("edge_at", t.x[i], t.y[i], t.x[j], t.y[j], sample_q15(px), sample_q15(py));
    equations.add(call_text("+", e, call_text("to_real", call_text("bias", a, b))), edge.at(px, py));
    equations.add(call_real("owns", t.x[i], t.y[i], t.x[j], t.y[j], sample_q15(px), sample_q15(py)),
                  edge.at(px, py) >= 0 ? "true" : "false");
  }
}

void add_depth(Equations& equations, const ScreenTriangle& triangle, int px, int py) {
  const Oriented t = orient(triangle);
  if (t.area == 0) return;
  const std::int64_t dz1 = t.z[1] - t.z[0], dz2 = t.z[2] - t.z[0];
  const std::int64_t nx = dz1 * (t.y[2] - t.y[0]) - dz2 * (t.y[1] - t.y[0]);
  const std::int64_t ny = dz2 * (t.x[1] - t.x[0]) - dz1 * (t.x[2] - t.x[0]);
  const std::string gx = call("gradient", nx, t.area), gy = call("gradient", ny, t.area);
  const DepthPlane plane = make_depth(t);
  const auto add_wrapped = [&](const std::string& term, std::uint64_t value, std::string_view modulus) {
    equations.add(call_text("mod", term, modulus), value);
  };
  add_wrapped(gx, plane.gx, "two64");
  add_wrapped(gy, plane.gy, "two64");
  add_wrapped(call_text("depth_step", gx), plane.zx, "two32");
  add_wrapped(call_text("depth_step", gy), plane.zy, "two32");
  int top = 0;
  for (int i = 1; i < 3; ++i)
    if (t.y[i] < t.y[top] || (t.y[i] == t.y[top] && t.x[i] < t.x[top])) top = i;
  const int x = px % kDepthCell, y = py % kDepthCell;
  const std::string z = text(t.z[top]), dx = text(sample_q15(px - x + kDepthCell / 2) - t.x[top]),
                    dy = text(sample_q15(py - y + kDepthCell / 2) - t.y[top]);
  add_wrapped(call_text("depth_at", z, gx, gy, dx, dy, text(0), text(0)), plane.base(px - x, py - y),
              "two32");
  add_wrapped(call_text("depth_at", z, gx, gy, dx, dy, text(x), text(y)), plane.at(px, py), "two32");
}

// The proofs apply to the code only if this holds.
TEST(Proofs, DefinitionsMatchTheContractsFunctions) {
  if (std::system("command -v z3 >/dev/null") != 0) GTEST_SKIP() << "z3 is not installed";
  Random random(21);
  Equations equations;
  for (const auto family : {"mixed", "vertices"})
    for (const ScreenTriangle& triangle : adversarial(family, 750, kMaxImageSide, kMaxImageSide, 21)) {
      const auto pixel = [&] { return static_cast<int>(random.below(kMaxImageSide)); };
      const int px = pixel(), py = pixel();
      add_coverage(equations, triangle, px, py);
      add_depth(equations, triangle, px, py);
    }
  EXPECT_GT(equations.count(), 20'000);
  EXPECT_EQ(equations.solve(), "unsat\n");
  RecordProperty("comparisons", equations.count());
}

}  // namespace
}  // namespace edgewise::testing
