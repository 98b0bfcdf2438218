// The report of `edgewise verify`: a table and JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/verify/verify.h"

namespace edgewise::tools {

// One line per scene. Below 80 columns, leaves out size, emitted and seconds; 60 columns suffice.
class VerifyTable {
 public:
  explicit VerifyTable(int terminal_columns) : wide_(terminal_columns >= 80) {}
  std::string header() const;
  std::string line(const SceneVerdict& verdict) const;

 private:
  bool wide_;
};

// "2 threads, avx2, tile 64, no prefetch"
std::string describe(const lab::AblatedExecution& how);

// The differences of a scene in detail; empty if there are none.
std::string explain(const SceneVerdict& verdict);

// The number of comparisons and the result.
std::string summary(const VerifyReport& report, const VerifyPlan& plan);

nlohmann::json report_json(const VerifyReport& report, const VerifyPlan& plan);

}  // namespace edgewise::tools
