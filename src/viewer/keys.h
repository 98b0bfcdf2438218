// The table of keys. The session's actions, the help on screen and on the command line, and the tests use it.
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

// clang-format off
enum class Command : std::uint8_t {
  // Act while the key is held; in the order of Session::move():
  forwards, backwards, step_left, step_right, rise, sink,
  look_up, look_down, look_left, look_right,
  // Act once per key press, and change the picture:
  home, spin,
  coverage, edges, clipping, visibility, facing, cull_front, cull_back, light, switch_back,
  errors, truth, arrangement, face_states, outlines,
  // The same, without a change of the picture:
  axes, slower, faster, magnifier, next_error, other_side, labels,
  // The same, without a change of anything that a demo's next step depends on:
  panel, previous_step, next_step, help, save, quit,
};
// clang-format on

struct Binding {
  constexpr Binding(Key k, Command c) : key(k), command(c) {}
  constexpr Binding(char k, Command c) : key(key_of(k)), command(c) {}
  Key key;
  Command command;
};

// A line of the help: related keys and their effect.
struct KeyRow {
  std::string_view keys, does;
  std::vector<Binding> bindings;
};
std::span<const KeyRow> key_table();
std::optional<Command> command_of(Key key);

// Parses keys such as "wd<tab><1.5><float_lt>". Characters are keys; in angle brackets stand other keys (up,
// down, left, right, shift, tab, space, enter, escape, backspace), times to wait in seconds, and methods to
// select for their stage. Throws std::invalid_argument for anything else.
struct Named {
  std::string method;
};
using Stroke = std::variant<Key, double, Named>;
std::vector<Stroke> parse_keys(std::string_view text);
double seconds_of(const Stroke& stroke);  // 0.1 s for a key or method, or the time to wait

}  // namespace edgewise::viewer
