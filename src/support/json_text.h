// JSON as text that can always be written.
#pragma once

#include <string>

namespace edgewise::app {

// A file name may hold bytes that are not UTF-8, which dump() alone answers with an exception: they become
// U+FFFD. `indent` as in dump().
template <typename Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace edgewise::app
