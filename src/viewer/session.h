// The viewer without a window: its state, its commands, and the screens to show. A window or a terminal
// passes events and elapsed time to the session, and shows its screens.
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
#include "viewer/inset.h"
#include "viewer/keys.h"
#include "viewer/overlay.h"
#include "viewer/pipeline.h"
#include "viewer/text.h"
#include "viewer/world.h"

namespace edgewise::viewer {

// A step of a demo: keys to press after the previous step, as in --keys, and a text on what to notice.
struct Step {
  std::string_view keys, notice;
};

struct Start {
  // Loads the scene for a picture of this size. Called again after a change of size for built-in streams,
  // which fill the picture.
  std::function<tools::Shot(tools::Size)> load;
  lab::Choice choice = lab::our_choice("tiled");  // for the first side
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
  lab::Choice choice;
  const lab::CoverageMethod* filled = nullptr;  // the filling method to return to from edges only
  bool cull_front = false, cull_back = false;
  std::string because;                    // which part of the choice cannot be drawn, and why
  double frontend_ms = 0, raster_ms = 0;  // moving averages
  FrontendStats stats;                    // of the last frame
  std::vector<FaceState> faces;           // if shown and known
  std::uint64_t faces_of = 0;             // State::version of `faces`
  std::optional<Judgement> judgement;     // none: this choice is not judged yet
  double judging_ms = 0;                  // expected time of a judgement
  std::uint64_t judged = 0;               // State::version of `judgement`
};

struct State {
  std::string scene;
  bool stream = false;
  bool lit = true;  // scenes only
  Execution execution;
  bool along_view = true;
  float speed = 1.0f;  // factor
  bool spinning = false, frozen = false;
  glm::vec3 axis{0.0f, 1.0f, 0.0f};
  float angle = 0.0f;  // rad
  Errors errors = Errors::count;
  Truth truth = Truth::contract;
  Arrangement arrangement = Arrangement::one;
  std::optional<Overlay> overlay;         // none: chosen by the screen's size
  Overlay shown_overlay = Overlay::full;  // in the last frame
  std::size_t active = 0;                 // the side that keys change
  bool magnifier = false, labels = false, face_states = false, outlines = false;
  int help_page = 0;            // from 1; 0: none
  std::uint64_t differing = 0;  // pixels, in the difference of both sides
  double frame_ms = 0;          // moving average
  std::uint64_t version = 1;    // of the picture; changes with everything that the picture depends on
  std::string message;
  std::string notice;  // a demo's text on what to notice
  bool reproducible = false;
};

class Session {
 public:
  explicit Session(Start start);

  void press(Key key);
  void release(Key key);
  void release_all();
  // Selects a method for its stage on the active side. Throws std::invalid_argument for an unknown name.
  void choose(std::string_view method);
  // Shows a text on what to notice.
  void say(std::string_view notice) { state_.notice = notice; }
  // The pointer moved to a screen position, with the button held or not.
  void point(Pixel to, bool held);
  // Advances movement and rotation by this time.
  void advance(double seconds);
  // Draws a frame; the caller may paint into the returned screen. Throws what loading and drawing throw.
  Screen& draw(tools::Size size, Cell cell);

  bool done() const { return done_; }
  // Whether nothing changes until the next event.
  bool still() const;
  const State& state() const { return state_; }
  const Side& side(std::size_t i) const { return sides_[i]; }
  const World& world() const { return *world_; }
  std::size_t vertex_count() const;  // of all objects
  // The names of the files saved since the last take_saved().
  const std::vector<std::string>& saved() const { return saved_; }
  std::vector<std::string> take_saved();

 private:
  void act(Command command);
  void switch_by(Command command, int step);
  void move(Command command, float seconds);
  void load(tools::Size size);
  void draw_picture();
  View view_of(std::size_t side, tools::Size size) const;
  Image draw_side(std::size_t side, tools::Size size, double& work_ms);
  void judge_if_due(std::size_t side, const lab::Choice& choice, const View& view, double work_ms);
  void finish(Image& panel, std::size_t side);
  void reset_times();
  void show_next_error();
  void next_step();
  void save();

  Start start_;
  State state_;
  std::array<Side, 2> sides_;
  std::array<Pipeline, 2> pipelines_;
  std::optional<World> world_;
  FrontendOptions frontend_;
  bool fills_its_size_ = false;
  tools::Size size_{0, 0}, panel_{0, 0};
  Cell cell_{1, 1};
  std::size_t next_step_ = 0;
  bool demo_left_ = false;  // the user changed the state since the demo's last step
  std::set<Key> held_;
  std::optional<Command> last_switch_;
  std::optional<Pixel> pointer_, focus_;
  Pixel first_difference_{0, 0};
  bool done_ = false, save_next_ = false;
  bool cold_ = true;  // no frame of this size and these methods was drawn yet
  Screen screen_;
  std::vector<std::string> saved_;
};

}  // namespace edgewise::viewer
