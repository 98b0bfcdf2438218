// One case through every backend, SIMD target and two thread counts, and its verdict.
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

// What is judged. The first backend, on one thread and the scalar target, is the reference of all frames, and
// is judged by the oracle itself; the front end's reference is the front end that takes one triangle at a
// time, without vectors and threads.
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
};

// The first frame, or list of the front end, of a case that differs.
struct Finding {
  std::string judge;  // the reference's name, "oracle" or "one triangle at a time"
  bool of_frontend;   // then only target and threads of `draw` mean anything
  Draw draw;
  lab::FrameDifference difference;        // none for the front end
  std::vector<ScreenTriangle> triangles;  // the frame's
};

struct Verdict {
  Tally tally;
  std::vector<Finding> findings;  // at most one of each judge and backend
};

// Keeps its memory between cases; one object must not work on two threads at once.
class Checker {
 public:
  explicit Checker(const Judged& judged);

  Verdict check(const Case& c);

  // Does the draw of these triangles differ from its judge's? Of a fault that comes and goes with the
  // threads' luck, several attempts are made.
  bool differs(const Finding& finding, const Case& c, std::span<const ScreenTriangle> triangles);
  // The same for the front end, on any target and thread count.
  bool frontend_differs(const Case& c, const Drawable& drawable);

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
