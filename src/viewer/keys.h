// The keys and what they do: one table, from which come the session's actions, the help on the screen and in
// the command line, and the tests.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace edgewise::viewer {

// A printable key is its character, a letter in lower case.
enum class Key : std::uint16_t {
  backspace = 8,
  tab = 9,
  enter = 13,
  escape = 27,
  space = ' ',
  up = 256,
  down,
  left,
  right,
  shift,
};
constexpr Key key_of(char c) {
  return static_cast<Key>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
}

enum class Command : std::uint8_t {
  // These work for as long as the key is held:
  forwards,
  backwards,
  step_left,
  step_right,
  rise,
  sink,
  look_up,
  look_down,
  look_left,
  look_right,
  turn_back,
  turn_on,
  // These at once:
  axes,
  slower,
  faster,
  home,
  spin,
  axis_of_sight,
  freeze,
  coverage,
  edges,
  clipping,
  visibility,
  facing,
  cull_front,
  cull_back,
  light,
  threads,
  target,
  switch_back,
  errors,
  truth,
  magnifier,
  next_error,
  arrangement,
  other_side,
  labels,
  face_states,
  outlines,
  overlay,
  next_step,
  help,
  save,
  quit,
};
constexpr bool is_held(Command command) {
  return command <= Command::turn_on;
}

struct Binding {
  Key key;
  Command command;
};

// A line of the help: some keys that belong together.
struct KeyRow {
  std::string_view keys, does;
  std::vector<Binding> bindings;
};
std::span<const KeyRow> key_table();
std::optional<Command> command_of(Key key);

// "wd<tab><1.5><float_lt>": characters are themselves, names of other keys stand in brackets (up, down, left,
// right, shift, tab, space, enter, escape, backspace), a number is a time to wait, in seconds, and the name
// of a method puts it at its stage. Throws std::invalid_argument for what is none of these.
struct Named {
  std::string method;
};
using Stroke = std::variant<Key, double, Named>;
std::vector<Stroke> parse_keys(std::string_view text);

}  // namespace edgewise::viewer
