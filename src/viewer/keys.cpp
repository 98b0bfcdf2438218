#include "viewer/keys.h"

#include <stdexcept>
#include <utility>

#include "core/numbers.h"
#include "lab/stage_methods.h"

namespace edgewise::viewer {

namespace {

constexpr double kLongestWait = 3600;  // s

constexpr std::pair<std::string_view, Key> kNames[] = {
    {"up", Key::up},         {"down", Key::down},
    {"left", Key::left},     {"right", Key::right},
    {"shift", Key::shift},   {"tab", Key::tab},
    {"space", Key::space},   {"enter", Key::enter},
    {"escape", Key::escape}, {"backspace", Key::backspace}};

Stroke parse_name(std::string_view name) {
  for (const auto& [known, key] : kNames)
    if (known == name) return key;
  if (lab::StageMethods unused; put(name, unused)) return Named{std::string(name)};
  if (const auto seconds = parsed<double>(name); seconds && *seconds >= 0 && *seconds <= kLongestWait)
    return *seconds;
  throw std::invalid_argument("--keys: <" + std::string(name) +
                              "> is not a key, a method or a time in seconds");
}

}  // namespace

std::span<const KeyRow> key_table() {
  using enum Command;
  static const std::vector<KeyRow> rows{
      {"w a s d",
       "move forwards, left, backwards, right",
       {{'w', forwards}, {'a', step_left}, {'s', backwards}, {'d', step_right}}},
      {"space, shift or c", "move up, down", {{Key::space, rise}, {Key::shift, sink}, {'c', sink}}},
      {"arrows, drag",
       "look around",
       {{Key::up, look_up}, {Key::down, look_down}, {Key::left, look_left}, {Key::right, look_right}}},
      {"m", "move along camera or world axes", {{'m', axes}}},
      {"3 4", "move slower, faster", {{'3', slower}, {'4', faster}}},
      {"0", "reset camera and rotation", {{'0', home}}},
      {"r", "start, stop rotating the objects", {{'r', spin}}},
      {"b", "next backend or coverage method", {{'b', coverage}}},
      {"y", "edges only or filled", {{'y', edges}}},
      {"x", "next clipping method", {{'x', clipping}}},
      {"z", "next visibility method", {{'z', visibility}}},
      {"n", "next facing test", {{'n', facing}}},
      {"1 2", "cull front, back faces", {{'1', cull_front}, {'2', cull_back}}},
      {"k", "lighting on, off", {{'k', light}}},
      {"backspace", "previous value of the last switch", {{Key::backspace, switch_back}}},
      {"e", "errors: count, tint, off", {{'e', errors}}},
      {"u", "reference for counting errors", {{'u', truth}}},
      {"g", "magnifier", {{'g', magnifier}}},
      {"enter", "magnifier to the next wrong pixel", {{Key::enter, next_error}}},
      {"v", "one picture, side by side, difference", {{'v', arrangement}}},
      {"tab", "switch the side that keys change", {{Key::tab, other_side}}},
      {"t", "vertex numbers", {{'t', labels}}},
      {"7", "state of each face (culled, clipped)", {{'7', face_states}}},
      {"6", "outlines (white: cut by clipping)", {{'6', outlines}}},
      {"o", "panel on, off", {{'o', panel}}},
      {"p", "save a .png and a .tri file", {{'p', save}}},
      {"8 5", "previous, next step of a demo", {{'8', previous_step}, {'5', next_step}}},
      {"h", "help: all keys and methods", {{'h', help}}},
      {"q, esc", "quit", {{'q', quit}, {Key::escape, quit}}},
  };
  return rows;
}

std::optional<Command> command_of(Key key) {
  for (const KeyRow& row : key_table())
    for (const Binding& binding : row.bindings)
      if (binding.key == key) return binding.command;
  return std::nullopt;
}

double seconds_of(const Stroke& stroke) {
  constexpr double kHeld_s = 0.1;
  const double* const wait = std::get_if<double>(&stroke);
  return wait != nullptr ? *wait : kHeld_s;
}

std::vector<Stroke> parse_keys(std::string_view text) {
  std::vector<Stroke> strokes;
  while (!text.empty()) {
    std::size_t used = 1;
    if (text.front() == '<') {
      const auto end = text.find('>');
      if (end == std::string_view::npos) throw std::invalid_argument("--keys: a '<' without '>'");
      strokes.push_back(parse_name(text.substr(1, end - 1)));
      used = end + 1;
    } else {
      const Key key = key_of(text.front());
      if (!command_of(key))
        throw std::invalid_argument("--keys: no command is bound to '" + std::string(text.substr(0, 1)) +
                                    "'");
      strokes.emplace_back(key);
    }
    text.remove_prefix(used);
  }
  return strokes;
}

}  // namespace edgewise::viewer
