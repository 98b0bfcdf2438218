// A verify report for people (a table) and for machines (JSON).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/verify/verify.h"

namespace edgewise::app {

// One line a scene. In less than 80 columns those that a person misses least are left out; 60 are enough.
class VerifyTable {
 public:
  explicit VerifyTable(int terminal_columns) : wide_(terminal_columns >= 80) {}
  std::string header() const;
  std::string line(const SceneVerdict& verdict) const;

 private:
  bool wide_;
};

// "2 threads, avx2, tile 64, no prefetch"
std::string describe(const AblatedExecution& how);

// All that is known about the differences of a scene; empty if there are none.
std::string explain(const SceneVerdict& verdict);

// What was compared in all, and how it ended.
std::string summary(const VerifyReport& report, const VerifyPlan& plan);

nlohmann::json report_json(const VerifyReport& report, const VerifyPlan& plan);

}  // namespace edgewise::app
