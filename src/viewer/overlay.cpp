#include "viewer/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <initializer_list>
#include <utility>

#include "support/printable.h"
#include "viewer/session.h"

namespace edgewise::viewer {

namespace {

constexpr std::uint32_t kPlain = rgb(225, 225, 225), kStrong = rgb(255, 255, 255),
                        kNotOurs = rgb(255, 190, 90), kWrong = rgb(255, 120, 90),
                        kNotice = rgb(140, 220, 255);
constexpr int kRowsForFull = 30;

// Writes lines of text down a column of the screen. Skips empty lines and lines below the screen, and cuts
// lines to the column's width.
class Column {
 public:
  Column(Screen& screen, Cell cell, int x, int y, int width)
      : screen_(screen), cell_(cell), x_(x), y_(y), letters_(std::max(width / cell.width, 0)) {}

  void line(std::string_view words, std::uint32_t colour = kPlain) {
    if (y_ + cell_.height > screen_.picture.height) return;
    if (words.empty()) return;
    std::string fitted = tools::printable_within(words, static_cast<std::size_t>(letters_));
    std::replace_if(
        fitted.begin(), fitted.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    if (!fitted.empty()) screen_.texts.push_back({x_, y_, std::move(fitted), colour});
    y_ += cell_.height;
  }
  // One line whose parts have different colours.
  void line(std::initializer_list<std::pair<std::string, std::uint32_t>> parts) {
    const int x = x_, y = y_, letters = letters_;
    for (const auto& [words, colour] : parts) {
      y_ = y;
      line(words, colour);
      const int used = static_cast<int>(words.size());
      x_ += used * cell_.width;
      letters_ = std::max(letters_ - used, 0);
    }
    x_ = x, letters_ = letters;
  }
  // Text wrapped at blanks into several lines.
  void lines(std::string_view words, std::uint32_t colour) {
    const auto width = static_cast<std::size_t>(letters_);
    if (width == 0) return;
    while (!words.empty()) {
      const std::size_t blank = words.size() > width ? words.rfind(' ', width) : words.size();
      const std::size_t end = blank == std::string_view::npos ? width : blank;
      line(words.substr(0, end), colour);
      words.remove_prefix(blank == std::string_view::npos ? end : std::min(end + 1, words.size()));
    }
  }
  int y() const { return y_; }

 private:
  Screen& screen_;
  Cell cell_;
  int x_, y_, letters_;
};

std::string count(std::uint64_t n, std::string_view what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string_view culling(const Side& side) {
  if (side.cull_front && side.cull_back) return "[1] [2] front and back faces culled: no faces left";
  if (side.cull_front) return "[1] front faces culled: diorama";
  return side.cull_back ? "[2] back faces culled" : "[1] [2] no faces culled";
}

std::string errors_of(const State& state, const Side& side, bool brief) {
  if (!side.judgement && !side.choice.fills())
    return brief ? "edges only" : "[y] edges only: no errors to count";
  if (state.errors == Errors::off || !side.judgement) return "[e] errors not counted";
  const Judgement& j = *side.judgement;
  std::string text = brief ? fmt::format("{} wrong", j.wrong)
                           : fmt::format("{}, {} covered", count(j.wrong, "wrong pixel"), j.covered);
  if (j.gaps) text += fmt::format(", {}, {}", count(*j.gaps, "gap"), count(*j.double_hits, "double hit"));
  return text;
}

// Whole degrees, never "-0".
int degrees(float radians) {
  return static_cast<int>(std::lround(glm::degrees(radians)));
}

// Rounded, never "-0.00".
double hundredths(double length) {
  return std::round(length * 100.0) / 100.0 + 0.0;
}

// Which frame the error count is from.
std::string_view judged_frame(const State& state, const Side& side) {
  if (side.judged != state.version) return "an earlier frame, to keep the frame rate";
  return "this frame";
}

class Overlaying {
 public:
  Overlaying(const Session& session, tools::Size panel, Cell cell, Screen& screen)
      : session_(session), state_(session.state()), panel_(panel), cell_(cell), screen_(screen) {}

  void full() {
    Column common = column(0, notice());
    common.line(fmt::format("{} {}x{}{}", tools::printable(state_.scene), panel_.width, panel_.height,
                            unless_reproducible("   {:.1f} ms per frame", state_.frame_ms)),
                kStrong);
    common.line(unless_reproducible("[j] {}  [i] {}",
                                    count(static_cast<std::uint64_t>(state_.execution.threads), "thread"),
                                    edgewise::name_of(state_.execution.target)));
    if (!state_.stream) camera_and_rotation(common);
    if (state_.errors == Errors::tint) legend(common);
    if (state_.arrangement == Arrangement::difference)
      common.line(fmt::format("{} differ between the sides", count(state_.differing, "pixel")), kWrong);
    const int y = common.y() + cell_.height / 2;
    if (state_.arrangement == Arrangement::difference) {
      Column both = column(0, y);
      side(both, 0), side(both, 1);
    } else {
      for (std::size_t i = 0; i < sides(); ++i) {
        Column own = column(i, y);
        side(own, i);
      }
    }
  }

  void brief() {
    const int top = notice();
    for (std::size_t i = 0; i < sides(); ++i) {
      const Side& s = session_.side(i);
      Column own = column(
          state_.arrangement == Arrangement::difference ? 0 : i,
          top + (state_.arrangement == Arrangement::difference ? static_cast<int>(i) * cell_.height : 0));
      own.line(fmt::format("{}{}{}", marker(i), describe(s.choice),
                           unless_reproducible("  {:.1f} ms", s.frontend_ms + s.raster_ms)),
               s.choice.ours() ? kStrong : kNotOurs);
      if (state_.arrangement != Arrangement::difference && state_.errors != Errors::off)
        own.line(errors_of(state_, s, true), error_colour(s));
      const bool as_usual = state_.stream || (s.cull_back && !s.cull_front);
      if (!as_usual && state_.arrangement != Arrangement::difference) own.line(culling(s), kNotOurs);
    }
    if (state_.arrangement == Arrangement::difference) {
      Column below = column(0, top + 2 * cell_.height);
      below.line(fmt::format("{} differ", count(state_.differing, "pixel")), kWrong);
    }
  }

  // The last line of the screen: the session's message, or else `otherwise`.
  void message(std::string_view otherwise) {
    Column last(screen_, cell_, cell_.width, (screen_.picture.height / cell_.height - 1) * cell_.height,
                screen_.picture.width - cell_.width);
    if (!state_.message.empty())
      last.line(state_.message, kStrong);
    else
      last.line(otherwise);
  }

  void labels() {
    const Scene* const scene = session_.world().scene();
    if (state_.arrangement == Arrangement::difference || scene == nullptr) return;
    for (std::size_t i = 0; i < sides(); ++i) {
      const Panel panel{left_of(i), panel_.width, panel_.height, cell_};
      if (state_.labels) add_vertex_labels(*scene, panel, screen_.texts);
      if (state_.face_states) add_face_letters(scene->camera, session_.side(i).faces, panel, screen_.texts);
    }
    // The magnifier covers labels in its corner.
    const int glass = state_.magnifier ? magnifier_side(panel_) : 0;
    std::erase_if(screen_.texts, [&](const Text& text) {
      const int x = text.x < panel_.width ? text.x : text.x - left_of(1);
      return x + cell_.width > panel_.width - glass && text.y + cell_.height > panel_.height - glass;
    });
  }

  int help() {
    constexpr int kKeys = 14, kBoth = 54;  // characters: the keys alone; a whole line
    const auto rows = key_table();
    const int letters = screen_.picture.width / cell_.width,
              lines = screen_.picture.height / cell_.height - 1;
    const int columns = std::clamp(letters / kBoth, 1, 2);
    const int on_page = std::max(lines * columns, 1),
              pages = (static_cast<int>(rows.size()) + on_page - 1) / on_page;
    const int page = state_.help_page <= pages ? state_.help_page : 0;
    if (page == 0) return 0;
    Column title(screen_, cell_, cell_.width, 0, screen_.picture.width);
    title.line(pages > 1 ? fmt::format("Keys, {} of {} [h]", page, pages) : "Keys [h closes]", kStrong);
    for (int c = 0; c < columns; ++c) {
      Column list(screen_, cell_, (1 + c * kBoth) * cell_.width, cell_.height,
                  screen_.picture.width - c * kBoth * cell_.width);
      for (int i = 0; i < lines; ++i) {
        const auto row = static_cast<std::size_t>((page - 1) * on_page + c * lines + i);
        if (row < rows.size())
          list.line(fmt::format("{:<{}} {}", rows[row].keys, letters < kBoth ? 6 : kKeys, rows[row].does));
      }
    }
    return page;
  }

 private:
  // Writes the demo's notice over the whole width. Returns its lower end in px.
  int notice() {
    Column lines(screen_, cell_, cell_.width, 0, screen_.picture.width - cell_.width);
    lines.lines(state_.notice, kNotice);
    return lines.y();
  }
  template <typename... Values>
  std::string unless_reproducible(fmt::format_string<const Values&...> words, const Values&... values) const {
    return state_.reproducible ? "" : fmt::format(words, values...);
  }
  std::size_t sides() const { return state_.arrangement == Arrangement::one ? 1 : 2; }
  int left_of(std::size_t i) const { return i == 0 ? 0 : screen_.picture.width - panel_.width; }
  Column column(std::size_t i, int y) {
    // Align texts to whole cells, so that a terminal can show them.
    const int x = (left_of(i) + 2 * cell_.width - 1) / cell_.width * cell_.width;
    return {screen_, cell_, x, y / cell_.height * cell_.height, left_of(i) + panel_.width - x};
  }
  const char* marker(std::size_t i) const {
    if (state_.arrangement == Arrangement::one) return "";
    return i == state_.active ? "> " : "  ";
  }
  std::string compared_with_first(const Side& s) const {
    const Side& other = session_.side(0);
    const double ratio = (s.frontend_ms + s.raster_ms) / (other.frontend_ms + other.raster_ms);
    return unless_reproducible("{:.2f}x {} than the first side", ratio < 1 ? 1 / ratio : ratio,
                               ratio < 1 ? "faster" : "slower");
  }
  std::uint32_t error_colour(const Side& s) const {
    return s.judgement && s.judgement->wrong > 0 && state_.errors != Errors::off ? kWrong : kPlain;
  }

  void camera_and_rotation(Column& to) {
    const Camera& camera = session_.world().scene()->camera;
    to.line(fmt::format("camera {:.2f} {:.2f} {:.2f}  yaw {}  pitch {}", hundredths(camera.position.x),
                        hundredths(camera.position.y), hundredths(camera.position.z), degrees(camera.yaw),
                        degrees(camera.pitch)));
    to.line(fmt::format("[m] moves along {} axes, speed {:.2g}", state_.along_view ? "camera" : "world",
                        state_.speed));
    to.line(fmt::format("{} {} deg about {:.2f} {:.2f} {:.2f}{}",
                        state_.spinning ? "[r] rotating," : "rotated", degrees(state_.angle),
                        hundredths(state_.axis.x), hundredths(state_.axis.y), hundredths(state_.axis.z),
                        state_.frozen ? ", frozen [f]" : ""));
    if (state_.labels && session_.vertex_count() > kMostLabels)
      to.line(fmt::format("[t] {} vertices are too many for labels", session_.vertex_count()), kNotOurs);
  }

  void legend(Column& to) {
    to.line("nothing drawn", lab::colour_of(lab::Mark::gap));
    to.line("drawn twice, or wrong triangle visible", lab::colour_of(lab::Mark::twice));
    to.line("drawn outside all triangles", lab::colour_of(lab::Mark::extra));
  }

  void side(Column& to, std::size_t i) {
    const Side& s = session_.side(i);
    const FrontendStats& n = s.stats;
    const lab::Choice& c = s.choice;
    const auto stage = [&](const char* key, bool ours, std::string_view name) {
      return std::pair(fmt::format("[{}] {}", key, name), ours ? kPlain : kNotOurs);
    };
    // Coverage methods other than backends use their own depth test (lab/coverage/coverage.h).
    const bool own_depth = c.our_visibility() && !c.our_coverage();
    to.line({{marker(i), kStrong},
             stage("b", c.our_coverage(), c.coverage->info.name),
             {"  ", kPlain},
             stage("x", c.our_clipping(), c.clipping->info.name)});
    to.line(
        {{state_.arrangement == Arrangement::one ? "" : "  ", kPlain},
         stage("z", c.our_visibility() && !own_depth, own_depth ? "float plane" : c.visibility->info.name),
         {"  ", kPlain},
         stage("n", c.our_facing(), c.facing->info.name)});
    to.line(fmt::format("{}{}", culling(s), state_.stream || state_.lit ? "" : "  [k] unlit"),
            s.cull_front ? kNotOurs : kPlain);
    to.line(unless_reproducible("front end {:.2f} ms, raster {:.2f} ms", s.frontend_ms, s.raster_ms));
    if (i == 1) to.line(compared_with_first(s));
    if (state_.outlines) to.line("[6] outlines; white: clipped into several triangles");
    to.line(fmt::format("{} in, {} outside, {} culled, {}{} drawn", n.triangles, n.whole_mesh + n.outside,
                        n.culled, c.our_clipping() ? fmt::format("{} clipped, ", n.clipped) : "", n.emitted));
    if (n.meshes > 0) to.line(fmt::format("{}, {} culled whole", count(n.meshes, "object"), n.meshes_culled));
    if (state_.face_states) faces(to, s);
    if (!s.because.empty()) to.line(s.because, kWrong);
    to.line(errors_of(state_, s, false), error_colour(s));
    if (s.judgement && state_.errors != Errors::off) {
      to.line(fmt::format("  against [u] {}, {}", viewer::name_of(state_.truth), judged_frame(state_, s)));
    }
  }

  void faces(Column& to, const Side& s) {
    if (state_.stream) return to.line("[7] a stream of triangles has no faces", kNotOurs);
    if (!s.choice.our_clipping())
      return to.line("[7] this clipping method doesn't report face states", kNotOurs);
    to.lines(fmt::format("[7] faces: {}", summary_of(s.faces)), kPlain);
    if (s.faces.size() > kMostLabels)
      to.line("    too many faces for letters", kNotOurs);
    else
      to.lines(letters_of(s.faces), kStrong);
  }

  const Session& session_;
  const State& state_;
  tools::Size panel_;
  Cell cell_;
  Screen& screen_;
};

}  // namespace

Overlay overlay_that_fits(tools::Size size, Cell cell) {
  return size.height / cell.height >= kRowsForFull ? Overlay::full : Overlay::brief;
}

int add_overlay(const Session& session, tools::Size panel, Cell cell, Screen& screen) {
  const State& state = session.state();
  Overlaying overlay(session, panel, cell, screen);
  const Overlay level = state.shown_overlay;
  if (state.help_page > 0) {
    const int page = overlay.help();
    if (page > 0) return page;
  }
  overlay.labels();
  if (level != Overlay::none && session.world().scene() != nullptr)
    draw_axes(session.world().scene()->camera, cell, screen);
  if (level == Overlay::full) overlay.full();
  if (level == Overlay::brief) overlay.brief();
  overlay.message(level == Overlay::none ? "" : "[h] help");
  return 0;
}

}  // namespace edgewise::viewer
