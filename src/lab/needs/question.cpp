#include "lab/needs/question.h"

#include <algorithm>

namespace edgewise::lab {

const Answer* Question::needed() const {
  const auto failing =
      std::find_if(answers.rbegin(), answers.rend(), [](const Answer& a) { return !a.enough(); });
  return failing == answers.rbegin() ? nullptr : &*failing.base();
}

const Answer* Question::next_weaker() const {
  const Answer* const first_enough = needed();
  if (first_enough == nullptr) return &answers.back();
  return first_enough == answers.data() ? nullptr : first_enough - 1;
}

std::string bits_name(int bits, std::string_view kind) {
  return std::to_string(bits) + " " + std::string(kind) + (kind.empty() ? "bit" : " bit") +
         (bits == 1 ? "" : "s");
}

}  // namespace edgewise::lab
