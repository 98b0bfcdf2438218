// Draws one case with every backend, SIMD target and two thread counts, and compares the frames.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cli/soak/case.h"
#include "cli/soak/tally.h"
#include "lab/measure.h"
#include "raster/ablation.h"

namespace edgewise::soak {

// The code under test. The first backend, on one thread and the scalar target, is the reference for all
// frames; the oracle checks the reference itself. The front end's reference is its path for single triangles,
// without SIMD and threads.
struct Judged {
  std::vector<BackendInfo> backends;
  std::function<std::span<const ScreenTriangle>(Frontend&, const Drawable&, const FrontendOptions&)>
      frontend =
          [](Frontend& f, const Drawable& drawable, const FrontendOptions& o) { return f.run(drawable, o); };
};

// How one frame was drawn.
struct Draw {
  std::size_t backend;  // index
  AblatedExecution how;
  lab::GuardedFrame::Layout layout;
  bool whole_frame = false;  // by draw(drawable, …), which includes the front end
};
// The input of the backend, in words.
const char* input_of(const Draw& draw);

// The first frame, or triangle list of the front end, that differs in a case.
struct Finding {
  std::string judge;  // the reference's name, "oracle" or "one triangle at a time"
  bool of_frontend;   // if true, only target and threads of `draw` are valid
  Draw draw;
  lab::FrameDifference difference;        // empty for the front end
  std::vector<ScreenTriangle> triangles;  // of the frame; empty for the front end
};

struct Verdict {
  Tally tally;
  std::vector<Finding> findings;  // at most one per judge and backend
};

// Reuses its buffers between cases. Not thread-safe.
class Checker {
 public:
  explicit Checker(const Judged& judged);

  Verdict check(const Case& c);

  // Whether a finding's draw of these triangles differs from its judge. Draws on several threads get several
  // attempts, since a race may not show in the first.
  bool differs(const Finding& finding, const Case& c, std::span<const ScreenTriangle> triangles);
  // The same for a finding of the front end, on any target and thread count, or of a whole frame, with
  // another stream than the case has.
  bool differs(const Finding& finding, const Case& c, const TriangleStream& stream);

  const Judged& judged() const { return judged_; }

 private:
  std::span<const ScreenTriangle> check_frontend(const Case& c, Verdict& verdict);
  void check_frame(const Case& c, const std::string& judge, const Framebuffer& expected, const Draw& draw,
                   std::span<const ScreenTriangle> triangles, Verdict& verdict);
  Framebuffer reference_frame(const Case& c, std::span<const ScreenTriangle> triangles);
  lab::FrameDifference compare(const Case& c, const Framebuffer& expected, const Draw& draw,
                               std::span<const ScreenTriangle> triangles);

  const Judged& judged_;
  std::vector<std::unique_ptr<Backend>> backends_;
  Frontend plain_, candidate_;
  std::vector<ScreenTriangle> expected_list_;
};

}  // namespace edgewise::soak
