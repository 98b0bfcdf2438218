// The message of an exception, for tests of messages.
#pragma once

#include <exception>
#include <string>

namespace edgewise {

// The message of the exception that `action` throws; empty if it throws none.
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
