// The viewer without a window: its state, its commands, and the pictures to show. The panel, a window or a
// terminal passes events and elapsed time to the session, and shows its pictures.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "support/options.h"
#include "viewer/annotations.h"
#include "viewer/keys.h"
#include "viewer/pipeline.h"
#include "viewer/world.h"

namespace edgewise::viewer {

// A step of a demo: keys to press after the previous step, as in --keys, and a sentence on what to notice,
// which fits into a line of a terminal.
struct Step {
  std::string_view keys, notice;
};

struct Start {
  // Loads the scene for a picture of this size. Called again after a change of size for built-in streams,
  // which fill the picture.
  std::function<tools::Shot(tools::Size)> load;
  lab::StageMethods choice = lab::our_choice("tiled");  // for the first side
  Execution execution;
  std::optional<glm::vec3> axis;  // rotation axis; none: the first object's
  std::filesystem::path folder;   // for files saved with `p`
  std::span<const Step> steps;    // of a demo
  // Hides times and all else that differs between runs or machines, and counts errors in every frame, however
  // long that takes.
  bool reproducible = false;
};

enum class Errors { count, tint, off };
enum class Arrangement { one, side_by_side, difference };

// One of the two pictures that can be compared.
struct Side {
  lab::StageMethods choice = lab::our_choice("tiled");
  const lab::CoverageMethod* filled = choice.coverage;  // the method to return to from edges only
  bool cull_front = false, cull_back = false;
  std::string because;                    // which part of the choice cannot be drawn, and why
  double frontend_ms = 0, raster_ms = 0;  // moving averages
  FrontendStats stats;                    // of the last frame
  std::vector<FaceState> faces;           // if shown and known
  std::uint64_t faces_of = 0;             // State::version of `faces`
  std::optional<Judgement> judgement;     // none: this choice is not judged yet
  std::array<std::uint64_t, 5> marked{};  // pixels of the judgement, by lab::Mark
  double judging_ms = 0;                  // expected time of a judgement
  std::uint64_t judged = 0;               // State::version of `judgement`
};

struct State {
  std::string scene;
  bool stream = false;
  bool lit = true;  // scenes only
  bool along_view = true;
  float speed = 1.0f;  // factor
  bool spinning = false;
  glm::vec3 axis{0.0f, 1.0f, 0.0f};
  float angle = 0.0f;  // rad
  Errors errors = Errors::count;
  Truth truth = Truth::contract;
  Arrangement arrangement = Arrangement::one;
  std::size_t active = 0;  // the side that keys change
  bool magnifier = false, labels = false, face_states = false, outlines = false;
  bool panel = true, help = false;
  std::uint64_t differing = 0;  // pixels, in the difference of both sides
  double frame_ms = 0;          // moving average
  std::uint64_t version = 1;    // of the picture; changes with everything that the picture depends on
  std::string message;
  std::size_t step = 0;  // of a demo: how many steps were taken
};

class Session {
 public:
  explicit Session(Start start);

  void press(Key key);
  void release(Key key);
  // Types strokes into a session that has been drawn, and draws after each, because some keys depend on the
  // last frame. `pass` calls advance() for a stroke's time; null: once for all of it.
  void type(std::span<const Stroke> strokes, const std::function<void(double)>& pass = nullptr);
  // Takes a demo's step, counted from 0, or says that there is none. Walking, for example, is a jump.
  void take_step(std::size_t step);
  // Shows a step as taken, without its keys.
  void show_step(std::size_t step) { state_.step = step + 1; }
  // The pointer moved to a position in the picture, with the button held or not.
  void point(Pixel to, bool held);
  // Advances movement and rotation by this time.
  void advance(double seconds);
  // Draws the picture, which fills `size`, less the panel's width at the right while the panel is shown.
  // Throws what loading and drawing throw.
  const Screen& draw(tools::Size size, int panel_width_px = 0);

  bool done() const { return done_; }
  // Whether nothing changes until the next event.
  bool still() const;
  const State& state() const { return state_; }
  const Side& side(std::size_t i) const { return sides_[i]; }
  std::size_t side_count() const { return state_.arrangement == Arrangement::one ? 1 : 2; }
  const Image& picture() const { return screen_.picture; }  // the last one
  tools::Size side_size() const { return side_size_; }      // of one side's picture
  int left_of(std::size_t side) const { return side == 0 ? 0 : screen_.picture.width - side_size_.width; }
  // What the magnifier shows, in one side's picture.
  Pixel focus() const { return focus_.value_or(Pixel{side_size_.width / 2, side_size_.height / 2}); }
  std::span<const Step> steps() const { return start_.steps; }
  bool reproducible() const { return start_.reproducible; }
  const World& world() const { return *world_; }
  const std::vector<std::string>& saved() const { return saved_; }  // files' names

 private:
  void act(Command command);
  void go_home();
  void change_side();
  void switch_by(Command command, int step);
  void move(Command command, float seconds);
  void load(tools::Size size);
  void draw_picture();
  View view_of(std::size_t side, tools::Size size) const;
  Image draw_side(std::size_t side, tools::Size size, double& work_ms);
  void judge_if_due(std::size_t side, const lab::StageMethods& choice, const View& view, double work_ms);
  void add_labels();
  void reset_results();
  void show_next_error();
  void save();

  Start start_;
  State state_;
  std::array<Side, 2> sides_;
  std::array<Pipeline, 2> pipelines_;
  std::optional<World> world_;
  FrontendOptions frontend_;
  bool fills_its_size_ = false;
  tools::Size window_{0, 0}, size_{0, 0}, side_size_{0, 0};  // with the panel; of the picture; of one side
  int panel_width_px_ = 0;
  bool demo_left_ = false;  // the user changed the state since the demo's last step
  std::set<Key> held_;
  Command last_switch_ = Command::quit;  // quit: none
  std::optional<Pixel> pointer_, focus_;
  Pixel first_difference_{0, 0};
  bool done_ = false, save_next_ = false;
  Screen screen_;
  std::vector<std::string> saved_;
};

}  // namespace edgewise::viewer
