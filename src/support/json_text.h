// JSON as valid UTF-8 text.
#pragma once

#include <string>

namespace edgewise::tools {

// Replaces bytes that are not UTF-8, as in file names, by U+FFFD, where plain dump() throws. `indent` as in
// dump().
template <typename Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace edgewise::tools
