#include "viewer/keys.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "lab/choice.h"

namespace edgewise::viewer {

namespace {

constexpr double kLongestWait = 3600;  // s

constexpr std::array<std::pair<std::string_view, Key>, 10> kNames{{{"up", Key::up},
                                                                   {"down", Key::down},
                                                                   {"left", Key::left},
                                                                   {"right", Key::right},
                                                                   {"shift", Key::shift},
                                                                   {"tab", Key::tab},
                                                                   {"space", Key::space},
                                                                   {"enter", Key::enter},
                                                                   {"escape", Key::escape},
                                                                   {"backspace", Key::backspace}}};

Stroke parse_name(std::string_view name) {
  const auto found =
      std::find_if(kNames.begin(), kNames.end(), [&](const auto& known) { return known.first == name; });
  if (found != kNames.end()) return found->second;
  if (lab::Choice unused; put(name, unused)) return Named{std::string(name)};
  double seconds = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), seconds);
  if (error != std::errc{} || end != name.data() + name.size() || !(seconds >= 0 && seconds <= kLongestWait))
    throw std::invalid_argument("--keys: <" + std::string(name) +
                                "> is not a key, a method or a time in seconds");
  return seconds;
}

}  // namespace

std::span<const KeyRow> key_table() {
  static const std::vector<KeyRow> rows{
      {"w a s d",
       "move forwards, left, backwards, right",
       {{key_of('w'), Command::forwards},
        {key_of('a'), Command::step_left},
        {key_of('s'), Command::backwards},
        {key_of('d'), Command::step_right}}},
      {"space, shift c",
       "move up, down",
       {{Key::space, Command::rise}, {Key::shift, Command::sink}, {key_of('c'), Command::sink}}},
      {"arrows, drag",
       "look around",
       {{Key::up, Command::look_up},
        {Key::down, Command::look_down},
        {Key::left, Command::look_left},
        {Key::right, Command::look_right}}},
      {"m", "move along camera or world axes", {{key_of('m'), Command::axes}}},
      {"3 4", "move slower, faster", {{key_of('3'), Command::slower}, {key_of('4'), Command::faster}}},
      {"0", "reset camera and rotation", {{key_of('0'), Command::home}}},
      {"r", "start, stop rotating the objects", {{key_of('r'), Command::spin}}},
      {", .",
       "rotate the objects by hand",
       {{key_of(','), Command::turn_back}, {key_of('.'), Command::turn_on}}},
      {"l", "rotate about the view direction", {{key_of('l'), Command::axis_of_sight}}},
      {"f", "freeze the rotation", {{key_of('f'), Command::freeze}}},
      {"b", "next backend or coverage method", {{key_of('b'), Command::coverage}}},
      {"y", "edges only or filled", {{key_of('y'), Command::edges}}},
      {"x", "next clipping method", {{key_of('x'), Command::clipping}}},
      {"z", "next visibility method", {{key_of('z'), Command::visibility}}},
      {"n", "next facing test", {{key_of('n'), Command::facing}}},
      {"1 2",
       "cull front, back faces",
       {{key_of('1'), Command::cull_front}, {key_of('2'), Command::cull_back}}},
      {"k", "lighting on, off", {{key_of('k'), Command::light}}},
      {"j", "number of threads", {{key_of('j'), Command::threads}}},
      {"i", "SIMD target", {{key_of('i'), Command::target}}},
      {"backspace", "previous value of the last switch", {{Key::backspace, Command::switch_back}}},
      {"e", "errors: count, tint, off", {{key_of('e'), Command::errors}}},
      {"u", "reference for counting errors", {{key_of('u'), Command::truth}}},
      {"g", "magnifier", {{key_of('g'), Command::magnifier}}},
      {"enter", "magnifier to the next wrong pixel", {{Key::enter, Command::next_error}}},
      {"v", "one picture, side by side, difference", {{key_of('v'), Command::arrangement}}},
      {"tab", "switch the side that keys change", {{Key::tab, Command::other_side}}},
      {"t", "vertex numbers", {{key_of('t'), Command::labels}}},
      {"7", "state of each face (culled, clipped)", {{key_of('7'), Command::face_states}}},
      {"6", "outlines (white: cut by clipping)", {{key_of('6'), Command::outlines}}},
      {"o", "panel on, off", {{key_of('o'), Command::panel}}},
      {"p", "save a .png and a .tri file", {{key_of('p'), Command::save}}},
      {"8 5",
       "previous, next step of a demo",
       {{key_of('8'), Command::previous_step}, {key_of('5'), Command::next_step}}},
      {"h", "help: all keys and methods", {{key_of('h'), Command::help}}},
      {"/", "search the help", {{key_of('/'), Command::search}}},
      {"q, esc", "quit", {{key_of('q'), Command::quit}, {Key::escape, Command::quit}}},
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
