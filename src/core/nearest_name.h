// Looks names up in lists, and suggests the nearest name for an unknown one.
#pragma once

#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace edgewise {

// "; did you mean 'NEAREST'?", by edit distance; empty if `known` is empty.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> known);

// "unknown KIND 'NAME'; did you mean 'NEAREST'? (known: …)".
std::string unknown_name(std::string_view kind, std::string_view name,
                         std::span<const std::string_view> known);

// The entry of `all` whose name is `name`; a reference into `all`. `name_of`: member or function that gives
// an entry's name. Throws std::invalid_argument with the text of unknown_name() if there is none.
template <typename Entry, typename NameOf>
const Entry& find_named(std::string_view kind, std::string_view name, std::span<const Entry> all,
                        NameOf name_of) {
  std::vector<std::string_view> known;
  for (const Entry& entry : all) {
    if (std::invoke(name_of, entry) == name) return entry;
    known.push_back(std::invoke(name_of, entry));
  }
  throw std::invalid_argument(unknown_name(kind, name, known));
}

}  // namespace edgewise
