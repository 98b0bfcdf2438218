#include "viewer/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <system_error>
#include <utility>

#include "edgewise/tri_file.h"
#include "files/atomic_file.h"
#include "lab/cases/to_stream.h"
#include "support/console.h"
#include "support/milliseconds.h"

namespace edgewise::viewer {

namespace {

constexpr float kTurnPerSecond = 0.6f, kLookPerSecond = 1.2f;  // rad
constexpr float kSpeedStep = 1.5f, kSlowest = 0.01f, kFastest = 100.0f;
// During movement, errors are counted only if the frame is expected to stay within kBudget_ms. The expected
// judging time decays by kDecay per frame, so that counting is retried every few seconds.
constexpr double kBudget_ms = 10.0, kDecay = 0.995;
// Vertices of a scene, or triangles of a stream. With more, counting errors takes seconds, so it starts on
// request.
constexpr std::size_t kMostJudged = 100'000;

// To the method `step` places further, cyclically.
template <typename Method>
void step_method(std::span<const Method> methods, const Method*& method, int step) {
  const auto count = static_cast<std::ptrdiff_t>(methods.size());
  method = &methods[static_cast<std::size_t>((method - methods.data() + step + count) % count)];
}

// Switches between a filling method and the wireframe.
void switch_edges(Side& side) {
  if (side.choice.fills())
    side.filled = std::exchange(side.choice.coverage, &lab::find_drawing_method(wireframe().name));
  else
    side.choice.coverage = side.filled;
}

template <typename Enum>
Enum next_of_three(Enum value) {
  return static_cast<Enum>((static_cast<int>(value) + 1) % 3);
}

// Updates an exponential moving average; 0 means that there is no value yet.
void update_mean(double now, double& mean) {
  constexpr double kWeight = 0.1;
  mean = mean == 0.0 ? now : mean + kWeight * (now - mean);
}

}  // namespace

Session::Session(Start start) : start_(std::move(start)) {
  sides_[0].choice = start_.choice;
  start_.execution.target = resolve(start_.execution.target);
}

void Session::press(Key key) {
  const auto command = command_of(key);
  if (!command) return;
  demo_left_ |= *command < Command::panel;
  if (*command <= Command::look_right)
    held_.insert(key);
  else
    act(*command);
}

void Session::release(Key key) {
  held_.erase(key);
}

void Session::type(std::span<const Stroke> strokes, const std::function<void(double)>& pass) {
  for (const Stroke& stroke : strokes) {
    const Key* const key = std::get_if<Key>(&stroke);
    if (key != nullptr) press(*key);
    if (const Named* const named = std::get_if<Named>(&stroke)) {
      put(named->method, sides_[state_.active].choice);
      reset_results();
      ++state_.version;
    }
    if (pass)
      pass(seconds_of(stroke));
    else
      advance(seconds_of(stroke));
    if (key != nullptr) release(*key);
    draw(window_, panel_width_px_);
  }
}

void Session::point(Pixel to, bool held) {
  if (held && pointer_ && !state_.stream && side_size_.height > 0) {
    demo_left_ = true;
    // The centre of the picture follows the pointer.
    const float per_px = world_->scene()->camera.fov_y / static_cast<float>(side_size_.height);
    look(world_->camera(), per_px * static_cast<float>(pointer_->x - to.x),
         per_px * static_cast<float>(pointer_->y - to.y));
    ++state_.version;
  }
  pointer_ = to;
  // A drag may leave the picture.
  const auto within = [](int at, int size) { return std::clamp(at, 0, std::max(size - 1, 0)); };
  const int left = to.x < left_of(1) ? 0 : left_of(1);
  focus_ = Pixel{within(to.x - left, side_size_.width), within(to.y, side_size_.height)};
}

bool Session::still() const {
  return state_.stream || (held_.empty() && !state_.spinning);
}

void Session::advance(double seconds) {
  if (!world_ || still()) return;
  const auto passed = static_cast<float>(seconds);
  for (const Key key : held_) move(*command_of(key), passed);
  if (state_.spinning) state_.angle += kTurnPerSecond * passed;
  state_.angle = std::remainder(state_.angle, 2.0f * std::numbers::pi_v<float>);
  world_->turn(state_.axis, state_.angle);
  ++state_.version;
}

void Session::move(Command command, float seconds) {
  // Speed grows with the square root of the scene's size.
  const float distance = state_.speed * std::sqrt(world_->radius()) * seconds,
              turn = kLookPerSecond * seconds;
  constexpr glm::vec3 kDirections[] = {{0, 0, -1}, {0, 0, 1}, {-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  constexpr glm::vec2 kLooks[] = {{0, 1}, {0, -1}, {1, 0}, {-1, 0}};
  const int i = static_cast<int>(command), first_look = static_cast<int>(Command::look_up);
  if (command <= Command::sink)
    viewer::move(world_->camera(), distance * kDirections[i], state_.along_view);
  else
    look(world_->camera(), turn * kLooks[i - first_look].x, turn * kLooks[i - first_look].y);
}

void Session::act(Command command) {
  state_.message.clear();
  if (command < Command::axes) ++state_.version;
  constexpr std::pair<Command, bool State::*> kToggles[] = {
      {Command::axes, &State::along_view},     {Command::spin, &State::spinning},
      {Command::magnifier, &State::magnifier}, {Command::labels, &State::labels},
      {Command::outlines, &State::outlines},   {Command::face_states, &State::face_states},
      {Command::panel, &State::panel}};
  for (const auto& [toggle, flag] : kToggles)
    if (command == toggle) {
      state_.*flag = !(state_.*flag);
      return;
    }
  const std::pair<Command, std::function<void()>> kActions[] = {
      {Command::slower, [&] { state_.speed = std::max(state_.speed / kSpeedStep, kSlowest); }},
      {Command::faster, [&] { state_.speed = std::min(state_.speed * kSpeedStep, kFastest); }},
      {Command::home, [&] { go_home(); }},
      {Command::switch_back, [&] { switch_by(last_switch_, -1); }},
      {Command::errors, [&] { state_.errors = next_of_three(state_.errors); }},
      {Command::next_error, [&] { show_next_error(); }},
      {Command::other_side, [&] { change_side(); }},
      {Command::previous_step, [&] { take_step(state_.step - 2); }},
      {Command::next_step, [&] { take_step(state_.step); }},
      {Command::help, [&] { state_.panel |= state_.help = !(state_.help && state_.panel); }},
      {Command::save, [&] { save_next_ = true; }},
      {Command::quit, [&] { done_ = true; }}};
  for (const auto& [wanted, action] : kActions)
    if (command == wanted) return action();
  switch_by(command, 1);
  if (command <= Command::light) last_switch_ = command;
}

void Session::go_home() {
  if (!world_ || state_.stream) return;
  world_->camera() = world_->home();
  state_.angle = 0.0f;
  world_->turn(state_.axis, state_.angle);
}

void Session::change_side() {
  if (state_.arrangement == Arrangement::one)
    state_.message = "there is one side only; [v] shows two";
  else
    state_.active = 1 - state_.active;
}

void Session::switch_by(Command command, int step) {
  Side& side = sides_[state_.active];
  lab::StageMethods& choice = side.choice;
  const std::pair<Command, std::function<void()>> switches[] = {
      {Command::coverage, [&] { step_method(lab::drawing_methods(), choice.coverage, step); }},
      {Command::edges, [&] { switch_edges(side); }},
      {Command::clipping, [&] { step_method(lab::clipping_methods(), choice.clipping, step); }},
      {Command::visibility, [&] { step_method(lab::visibility_methods(), choice.visibility, step); }},
      {Command::facing, [&] { step_method(lab::facing_methods(), choice.facing, step); }},
      {Command::cull_front, [&] { side.cull_front = !side.cull_front; }},
      {Command::cull_back, [&] { side.cull_back = !side.cull_back; }},
      {Command::light, [&] { state_.lit = !state_.lit; }},
      {Command::truth, [&] { state_.truth = next_of_three(state_.truth); }},
      {Command::arrangement, [&] { state_.arrangement = next_of_three(state_.arrangement); }}};
  for (const auto& [wanted, action] : switches)
    if (command == wanted) action(), reset_results();
  if (state_.arrangement == Arrangement::one) state_.active = 0;
}

// Forgets what was measured and counted with other methods or at another size.
void Session::reset_results() {
  for (Side& side : sides_) {
    side.judgement.reset();
    side.frontend_ms = side.raster_ms = 0;
  }
  state_.frame_ms = 0;
}

// The keys of a step assume the state after the previous one. If that is not the state, all earlier steps are
// taken again from the start.
void Session::take_step(std::size_t step) {
  if (step >= start_.steps.size()) {
    state_.message = start_.steps.empty() ? "only demos have steps" : "there is no further step";
    return;
  }
  std::size_t from = step;
  if (demo_left_ || state_.step != step) {
    Session fresh{Start(start_)};
    fresh.saved_ = std::move(saved_);
    fresh.save_next_ = save_next_;
    fresh.done_ = done_;
    fresh.state_.panel = state_.panel;
    fresh.draw(window_, panel_width_px_);
    *this = std::move(fresh);
    from = 0;
  }
  for (; from <= step; ++from) {
    show_step(from);
    type(parse_keys(start_.steps[from].keys));
  }
  demo_left_ = false;
}

void Session::load(tools::Size size) {
  const bool first = !world_;
  if (!first && !fills_its_size_) return;
  tools::Shot shot = start_.load(size);
  fills_its_size_ = shot.source.stream && shot.source.built_in != nullptr;
  world_.emplace(std::move(shot.source.drawable));
  if (!first) return;
  frontend_ = shot.frontend;
  state_.scene = shot.source.name;
  state_.stream = world_->scene() == nullptr;
  state_.lit = frontend_.shade;
  for (Side& side : sides_) {
    side.cull_front = frontend_.cull == Cull::front || frontend_.cull == Cull::both;
    side.cull_back = frontend_.cull == Cull::back || frontend_.cull == Cull::both;
  }
  state_.axis = start_.axis.value_or(world_->first_axis());
  const std::size_t amount =
      state_.stream ? std::get<TriangleStream>(world_->drawable()).size() : vertex_count(*world_->scene());
  if (!start_.reproducible && amount > kMostJudged) {
    state_.errors = Errors::off;
    state_.message = "large scene: errors are not counted; [e] counts them";
  }
}

View Session::view_of(std::size_t i, tools::Size size) const {
  const Side& side = sides_[i];
  View view{*world_, frontend_, start_.execution};
  view.frontend.width = size.width;
  view.frontend.height = size.height;
  view.frontend.cull = side.cull_front ? (side.cull_back ? Cull::both : Cull::front)
                                       : (side.cull_back ? Cull::back : Cull::none);
  view.frontend.shade = !state_.stream && state_.lit;
  return view;
}

const Screen& Session::draw(tools::Size window, int panel_width_px) {
  window_ = window;
  panel_width_px_ = panel_width_px;
  const tools::Size size{window.width - (state_.panel ? panel_width_px : 0), window.height};
  if (size.width != size_.width || size.height != size_.height) {
    load(size);
    size_ = size;
    ++state_.version;
    reset_results();
  }
  update_mean(tools::milliseconds([&] { draw_picture(); }), state_.frame_ms);
  if (save_next_) save();
  add_labels();
  return screen_;
}

void Session::draw_picture() {
  double work_ms = 0;
  const bool halves = state_.arrangement == Arrangement::side_by_side && size_.width > 1;
  side_size_ = {halves ? size_.width / 2 : size_.width, size_.height};
  Image first = draw_side(0, side_size_, work_ms);
  if (state_.arrangement == Arrangement::one) {
    screen_.picture = std::move(first);
    return;
  }
  Image second = draw_side(1, side_size_, work_ms);
  if (halves) {
    screen_.picture = {size_.width, size_.height, {}};
    screen_.picture.pixels.resize(static_cast<std::size_t>(size_.width) *
                                  static_cast<std::size_t>(size_.height));
    paste(first, 0, screen_.picture);
    paste(second, left_of(1), screen_.picture);
  } else {
    Difference both = difference(first, second);
    state_.differing = both.count;
    first_difference_ = {both.first_x, both.first_y};
    screen_.picture = std::move(both.picture);
  }
}

void Session::add_labels() {
  screen_.labels.clear();
  const Scene* const scene = world_->scene();
  if (state_.arrangement == Arrangement::difference || scene == nullptr) return;
  for (std::size_t i = 0; i < side_count(); ++i) {
    const Strip strip{left_of(i), side_size_.width, side_size_.height};
    if (state_.labels) add_vertex_labels(*scene, strip, screen_.labels);
    if (state_.face_states) add_face_letters(scene->camera, sides_[i].faces, strip, screen_.labels);
  }
}

Image Session::draw_side(std::size_t i, tools::Size size, double& work_ms) {
  Side& side = sides_[i];
  const View view = view_of(i, size);
  const auto [choice, because] = lab::drawable_part(side.choice, state_.stream);
  side.because = because;
  Picture picture = pipelines_[i].draw(choice, view);
  update_mean(picture.frontend_ms, side.frontend_ms);
  update_mean(picture.raster_ms, side.raster_ms);
  side.stats = picture.stats;
  work_ms += picture.frontend_ms + picture.raster_ms;
  judge_if_due(i, choice, view, work_ms);
  if (state_.outlines) pipelines_[i].outline(choice, view, picture.image);
  if (state_.face_states && !state_.stream && side.faces_of != state_.version) {
    side.faces.clear();
    if (choice.our_clipping()) side.faces = face_states(*world_->scene(), pipelines_[i].states(choice, view));
    side.faces_of = state_.version;
  }
  const bool tinted = state_.errors == Errors::tint && state_.arrangement != Arrangement::difference;
  for (std::size_t p = 0; tinted && side.judgement && p < picture.image.pixels.size(); ++p)
    if (const lab::Mark mark = side.judgement->marks[p]; mark != lab::Mark::none)
      picture.image.pixels[p] = lab::colour_of(mark);
  return std::move(picture.image);
}

void Session::judge_if_due(std::size_t i, const lab::StageMethods& choice, const View& view, double work_ms) {
  Side& side = sides_[i];
  const bool fresh = side.judgement && side.judged == state_.version;
  if (state_.errors == Errors::off || !choice.fills() || fresh) return;
  const bool affordable = start_.reproducible || work_ms + side.judging_ms < kBudget_ms;
  if (side.judgement && !affordable && !still() && state_.errors != Errors::tint) {
    side.judging_ms *= kDecay;
    return;
  }
  side.judging_ms =
      tools::milliseconds([&] { side.judgement = pipelines_[i].judge(choice, view, state_.truth); });
  side.judged = state_.version;
  side.marked = {};
  for (const lab::Mark mark : side.judgement->marks) ++side.marked[static_cast<std::size_t>(mark)];
}

void Session::show_next_error() {
  const auto show = [&](Pixel at, const char* what) {
    state_.magnifier = true;
    focus_ = at;
    state_.message = fmt::format("{} at {}, {}", what, at.x, at.y);
  };
  if (state_.arrangement == Arrangement::difference) {
    state_.message = "no difference";
    if (state_.differing > 0) show(first_difference_, "first difference");
    return;
  }
  const auto& judgement = sides_[state_.active].judgement;
  state_.message = "errors are not counted; [e] counts them";
  if (!judgement || state_.errors == Errors::off) return;
  const std::vector<lab::Mark>& marks = judgement->marks;
  const std::size_t width = static_cast<std::size_t>(side_size_.width);
  const Pixel from = focus_.value_or(Pixel{-1, 0});
  const std::size_t start =
      static_cast<std::size_t>(std::max(from.y, 0)) * width + static_cast<std::size_t>(from.x + 1);
  for (std::size_t k = 0; k < marks.size(); ++k) {
    const std::size_t at = (start + k) % marks.size();
    if (marks[at] == lab::Mark::none) continue;
    return show({static_cast<int>(at % width), static_cast<int>(at / width)}, "wrong pixel");
  }
  state_.message = "no wrong pixel";
}

void Session::save() {
  save_next_ = false;
  const auto path = [&](int n, const char* extension) {
    return start_.folder / fmt::format("{}-{:04}{}", state_.scene, n, extension);
  };
  try {
    std::error_code error;  // ignored: write_image() fails below if there is no folder
    std::filesystem::create_directories(start_.folder, error);
    int n = 1;
    while (std::filesystem::exists(path(n, ".png")) || std::filesystem::exists(path(n, ".tri"))) ++n;
    write_image(path(n, ".png"), screen_.picture);
    AtomicFile stream(path(n, ".tri"));
    write_tri(stream.stream(), lab::to_stream(pipelines_[state_.active].screen_triangles(), side_size_.width,
                                              side_size_.height));
    stream.commit();
    for (const char* extension : {".png", ".tri"}) saved_.push_back(path(n, extension).string());
    state_.message = fmt::format("saved {} and .tri", tools::printable(path(n, ".png").string()));
  } catch (const std::exception& error) {
    state_.message = fmt::format("not saved: {}", tools::printable(error.what()));
  }
}

}  // namespace edgewise::viewer
