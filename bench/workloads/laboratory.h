// What the laboratory draws, as rows: its coverage methods, the frames of the chart for choosing a method,
// and the least precise pipelines of scenes beside the exact one.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/row.h"
#include "lab/choice/choice.h"
#include "lab/scenes.h"

namespace edgewise::bench {

// A scene of the laboratory with the memory into which all its methods draw.
struct MethodScene {
  lab::LabScene info;
  // After a row is prepared:
  std::optional<lab::CoverageScene> scene = {};
  std::optional<lab::Canvas> canvas = {};
};
// The row has an error if it draws other pixels than its scalar form on one thread, so that the times would
// compare different work.
Row method_row(const std::shared_ptr<MethodScene>& scene, const lab::CoverageMethod& method,
               const Execution& how);
// All forms of all coverage methods: scalar and with the widest SIMD target, on one thread and on two, where
// they have these.
std::vector<Row> method_rows(const lab::LabScene& scene);

// From the vertices of the first frame to its picture, on one thread. A row has an error if it draws other
// pixels than in scalar code.
std::vector<Row> choice_rows(const lab::ChoiceScene& scene);
std::string choice_name(const lab::ChoiceScene& scene, std::string_view method);

// Of a file with a list of what `edgewise needs --json` prints about built-in scenes. Throws FileError. A row
// has an error if it draws more wrong pixels than the file tolerates.
std::vector<Row> pipeline_rows(const std::string& file);

}  // namespace edgewise::bench
