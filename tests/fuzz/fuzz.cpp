#include "fuzz.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <vector>

#include "edgewise/contract.h"
#include "edgewise/draw.h"
#include "frontend/mesh_clusters.h"
#include "lab/cases/backend_comparison.h"
#include "lab/truth/oracle.h"

namespace edgewise::fuzz {

void fail(const std::string& what) {
  std::fprintf(stderr, "FOUND: %s\n", what.c_str());
  std::abort();
}

MemoryFile::MemoryFile(const std::uint8_t* data, std::size_t size)
    : descriptor_(memfd_create("edgewise-fuzz", MFD_CLOEXEC)) {
  // Lack of memory is not an error that the fuzzer should report.
  if (descriptor_ < 0 || write(descriptor_, data, size) != static_cast<ssize_t>(size)) std::exit(2);
  path_ = "/proc/self/fd/" + std::to_string(descriptor_);
}

MemoryFile::~MemoryFile() {
  close(descriptor_);
}

namespace {

constexpr std::uint32_t kBackground = 0xABCD1234, kCanary = 0xDEADBEEF;

std::string describe(const BackendInfo& backend, const lab::DrawOptions& how) {
  const Execution& e = how.execution;
  return std::string(backend.name) + ", " + std::string(name_of(e.target)) + ", " +
         std::to_string(e.threads) + " threads, tile " + std::to_string(e.tile_size) + ", " +
         lab::describe(how.tiles);
}

// A plane of pixels in an allocation of exactly its size, so that a sanitizer detects accesses outside it.
class Plane {
 public:
  explicit Plane(const Placement& p)
      : p_(p),
        stride_(p.width + p.padding),
        pixels_(static_cast<std::size_t>(p.start + stride_ * (p.height - 1) + p.width), kCanary) {}

  std::uint32_t* data() { return pixels_.data() + p_.start; }
  int stride() const { return stride_; }

  // Requires `expected(x, y)` in the frame and canaries outside it.
  template <typename Expected>
  void check(const Expected& expected, const std::string& what) const {
    for (int i = 0; i < static_cast<int>(pixels_.size()); ++i) {
      const int x = (i - p_.start) % stride_, y = (i - p_.start) / stride_;
      const bool beside = i < p_.start || x >= p_.width;
      if (pixels_[static_cast<std::size_t>(i)] != (beside ? kCanary : expected(x, y)))
        fail(what + (beside ? ": wrote outside the frame at (" : ": wrong at (") + std::to_string(x) + ", " +
             std::to_string(y) + ")");
    }
  }

 private:
  Placement p_;
  int stride_;
  std::vector<std::uint32_t> pixels_;
};

// The picture that every backend must draw.
Framebuffer reference(std::span<const ScreenTriangle> triangles, int width, int height) {
  constexpr std::size_t kOracleWork = 20'000;  // pixels times triangles
  Framebuffer frame(width, height);
  if (triangles.size() * static_cast<std::size_t>(width * height) <= kOracleWork)
    lab::draw_oracle(triangles, frame, kBackground);
  else
    backends()[0].make()->draw(triangles, frame.view(), {kBackground}, {1, 64, SimdTarget::scalar});
  return frame;
}

// Calls draw(backend, frame, execution) for every backend and SIMD target, and requires the expected picture.
template <typename Draw>
void check_pictures(const Framebuffer& expected, const Placement& p, lab::DrawOptions how,
                    const std::string& what, const Draw& draw) {
  for (const BackendInfo& info : backends())
    for (const SimdTarget target : supported_targets()) {
      how.execution.target = target;
      Plane depth(p), payload(p);
      draw(*lab::make(info, how.tiles),
           FrameView{depth.data(), payload.data(), p.width, p.height, depth.stride()}, how.execution);
      const std::string where = what + describe(info, how);
      depth.check([&](int x, int y) { return expected.depth_row(y)[x]; }, where + ", depth");
      payload.check([&](int x, int y) { return expected.payload_row(y)[x]; }, where + ", payload");
    }
}

auto draw_triangles(std::span<const ScreenTriangle> triangles) {
  return [triangles](Backend& backend, const FrameView& frame, const Execution& execution) {
    backend.draw(triangles, frame, {kBackground}, execution);
  };
}

}  // namespace

void check_backends(std::span<const ScreenTriangle> triangles, const Placement& p, lab::DrawOptions how) {
  check_pictures(reference(triangles, p.width, p.height), p, how, "", draw_triangles(triangles));
}

namespace {

void check_ranges(std::span<const ScreenTriangle> triangles) {
  for (const ScreenTriangle& t : triangles)
    for (int i = 0; i < 3; ++i) {
      const auto in_band = [](std::int32_t c) {
        return c >= -contract::kGuard_q15 && c <= contract::kGuard_q15;
      };
      require(in_band(t.x_q15[i]) && in_band(t.y_q15[i]), "the front end left the guard band");
      require(t.z[i] >= contract::kDepthHead && t.z[i] <= contract::kDepthHead + contract::kDepthRange,
              "the front end left the depth range");
    }
}

// None if the front end rejects its input.
std::optional<std::span<const ScreenTriangle>> run(Frontend& frontend, const Drawable& drawable,
                                                   const FrontendOptions& options, SimdTarget target) {
  try {
    return frontend.run(drawable, options, {.target = target});
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

}  // namespace

void check_frontend(const Drawable& drawable, int width, int height) {
  constexpr int kLargestSide = 64;
  FrontendOptions options;
  options.width = std::min(width, kLargestSide);
  options.height = std::min(height, kLargestSide);
  Drawable in_clusters = drawable;
  make_clusters(in_clusters);
  static Frontend scalar, vectors;  // reused for all inputs, as programs reuse them for all frames
  options.shade = std::holds_alternative<Scene>(drawable);
  for (const Cull cull : {Cull::none, Cull::back}) {
    options.cull = cull;
    const auto expected = run(scalar, drawable, options, SimdTarget::scalar);
    for (const SimdTarget target : supported_targets())
      for (const bool clustered : {false, true}) {
        if (target == SimdTarget::scalar && !clustered) continue;  // that is `expected`
        const auto actual = run(vectors, clustered ? in_clusters : drawable, options, target);
        const std::string name = std::string(name_of(target)) + (clustered ? " with clusters" : "");
        require(expected.has_value() == actual.has_value(),
                "only one of scalar and " + name + " rejects the input");
        if (!expected) continue;
        require(expected->size() == actual->size() &&
                    (expected->empty() ||
                     std::memcmp(expected->data(), actual->data(), expected->size_bytes()) == 0),
                "the front end's triangles differ from scalar to " + name);
      }
    if (!expected) return;
    check_ranges(*expected);
    if (cull != Cull::none) continue;
    const Placement placement{options.width, options.height, 0, 0};
    const Framebuffer picture = reference(*expected, options.width, options.height);
    check_pictures(picture, placement, {}, "", draw_triangles(*expected));
    check_pictures(picture, placement, {}, "whole frame, ",
                   [&](Backend& backend, const FrameView& frame, const Execution& execution) {
                     draw(in_clusters, vectors, options, backend, frame, {kBackground}, execution);
                   });
  }
}

}  // namespace edgewise::fuzz
