// What an exception says, for tests of messages.
#pragma once

#include <exception>
#include <string>

namespace edgewise {

// Empty if nothing was thrown.
template <typename Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace edgewise
