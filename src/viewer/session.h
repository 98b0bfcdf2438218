// The viewer without a window: its state, what keys and mouse do to it, and what is to be seen. A window or a
// terminal hands in events and the time that has passed, and shows the screens it gets.
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

// A step of a demonstration: keys that lead on, as --keys takes them, and what to notice then.
struct Step {
  std::string_view keys, notice;
};

struct Start {
  // What to look at, for a picture of this size. Asked again when the size changes, of streams that fill it.
  std::function<app::Shot(app::Size)> load;
  lab::Choice choice = lab::our_choice("tiled");  // of the first side
  Execution execution;
  std::optional<glm::vec3> axis;  // none: the scene's own
  std::filesystem::path folder;   // where `p` saves
  std::span<const Step> steps;    // of a demonstration; key by key
  // Nothing is shown that differs from run to run or between machines, as times do; and errors are counted in
  // every frame, however long that takes.
  bool reproducible = false;
};

enum class Errors { count, tint, off };
enum class Arrangement { one, side_by_side, difference };

// What is known of one of the two pictures that can be compared.
struct Side {
  lab::Choice choice;
  const lab::CoverageMethod* filled = nullptr;  // what `choice` filled with before it drew edges
  bool cull_front = false, cull_back = false;
  std::string because;                    // what of the choice cannot be drawn, and why
  double frontend_ms = 0, raster_ms = 0;  // means of late
  FrontendStats stats;                    // of the last frame
  std::vector<FaceState> faces;           // where wanted and known, of
  std::uint64_t faces_of = 0;             // this version of the picture
  std::optional<Judgement> judgement;     // none yet, of this choice
  double judging_ms = 0;                  // what it took
  std::uint64_t judged = 0;               // the version of the picture
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
  std::optional<Overlay> overlay;         // none: what there is room for
  Overlay shown_overlay = Overlay::full;  // in the last frame
  std::size_t active = 0;                 // the side that keys go to
  bool magnifier = false, labels = false, face_states = false, outlines = false;
  int help_page = 0;            // from 1; 0: none
  std::uint64_t differing = 0;  // pixels, in the difference of both sides
  double frame_ms = 0;          // mean of late
  std::uint64_t version = 1;    // of the picture: changes with all that it depends on
  std::string message;
  std::string notice;  // what to notice, of a demonstration
  bool reproducible = false;
};

class Session {
 public:
  explicit Session(Start start);

  void press(Key key);
  void release(Key key);
  void release_all();
  // Puts a method at its stage, of the side that keys go to. Throws std::invalid_argument for an unknown
  // name.
  void choose(std::string_view method);
  // Shows what to notice.
  void say(std::string_view notice) { state_.notice = notice; }
  // The pointer moved to a place of the screen, with the button held or not.
  void point(Pixel to, bool held);
  // Lets this much time pass, in seconds.
  void advance(double seconds);
  // Draws; the caller may paint into the screen. Throws what loading and drawing throw.
  Screen& draw(app::Size size, Cell cell);

  bool done() const { return done_; }
  // Nothing changes until the next event.
  bool still() const;
  const State& state() const { return state_; }
  const Side& side(std::size_t i) const { return sides_[i]; }
  const World& world() const { return *world_; }
  std::size_t vertex_count() const;  // of all objects
  // The names of what `p` has saved since the last call.
  std::vector<std::string> take_saved();

 private:
  void act(Command command);
  void switch_by(Command command, int step);
  void move(Command command, float seconds);
  void load(app::Size size);
  void draw_picture();
  View view_of(std::size_t side, app::Size size) const;
  Image draw_side(std::size_t side, app::Size size, double& work_ms);
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
  app::Size size_{0, 0}, panel_{0, 0};
  Cell cell_{1, 1};
  std::size_t next_step_ = 0;
  bool strayed_ = false;  // from the demonstration's way, since its last step
  std::set<Key> held_;
  std::optional<Command> last_switch_;
  std::optional<Pixel> pointer_, focus_;
  Pixel first_difference_{0, 0};
  bool done_ = false, save_next_ = false;
  bool cold_ = true;  // this size and these methods were not drawn yet
  Screen screen_;
  std::vector<std::string> saved_;
};

}  // namespace edgewise::viewer
