// OBJ files from their text.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "edgewise/obj_file.h"
#include "temp_dir.h"

namespace edgewise {

inline const std::string kCorners = "v 1 2 3\nv 4 5 6\nv 7 8 10\n";

struct ReadObj {
  Scene scene;
  ObjReport report;
  const Mesh& mesh() const { return scene.meshes[0]; }
};
// The warnings come without the file's name.
inline ReadObj read_with_report(const TempDir& dir, const std::string& text, bool recentre = false) {
  ReadObj read;
  read.scene = read_obj(dir.write("a.obj", text), {.recentre = recentre}, &read.report);
  for (std::string& warning : read.report.warnings) {
    EXPECT_TRUE(warning.starts_with((dir.path() / "a.obj: ").string())) << warning;
    warning.erase(0, (dir.path() / "a.obj: ").string().size());
  }
  return read;
}

}  // namespace edgewise
