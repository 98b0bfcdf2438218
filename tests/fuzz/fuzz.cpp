#include "fuzz.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <utility>

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

constexpr std::uint32_t kBackground = 0xABCD1234;

std::string describe(const BackendInfo& backend, const lab::DrawOptions& how) {
  const Execution& e = how.execution;
  return std::string(backend.name) + ", " + std::string(name_of(e.target)) + ", " +
         std::to_string(e.threads) + " threads, tile " + std::to_string(e.tile_size) + ", " +
         lab::describe(how.tiles);
}

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

// Calls draw(backend, frame, execution) for every backend and SIMD target, and requires the expected picture
// and nothing written outside it.
template <typename Draw>
void check_pictures(const Framebuffer& expected, lab::GuardedFrame::Layout layout, lab::DrawOptions how,
                    const std::string& what, const Draw& draw) {
  for (const BackendInfo& info : backends())
    for (const SimdTarget target : supported_targets()) {
      how.execution.target = target;
      lab::GuardedFrame frame(expected.width(), expected.height(), layout);
      draw(*lab::make(info, how.tiles), frame.view(), how.execution);
      const lab::FrameDifference found = lab::compare(expected, frame);
      if (found.any())
        fail(what + describe(info, how) + ": " + std::to_string(found.outside) +
             " words outside the frame, wrong at (" + std::to_string(found.first_x) + ", " +
             std::to_string(found.first_y) + ")");
    }
}

auto draw_triangles(std::span<const ScreenTriangle> triangles) {
  return [triangles](Backend& backend, const FrameView& frame, const Execution& execution) {
    backend.draw(triangles, frame, {kBackground}, execution);
  };
}

}  // namespace

void check_backends(std::span<const ScreenTriangle> triangles, int width, int height,
                    lab::GuardedFrame::Layout layout, const lab::DrawOptions& how) {
  check_pictures(reference(triangles, width, height), layout, how, "", draw_triangles(triangles));
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
  for (const auto& [cull, bits] :
       {std::pair{Cull::none, 8}, {Cull::back, 8}, {Cull::none, kMaxSubpixelBits}}) {
    options.cull = cull, options.subpixel_bits = bits;
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
    const auto layout = lab::GuardedFrame::aligned(options.width);
    const Framebuffer picture = reference(*expected, options.width, options.height);
    check_pictures(picture, layout, {}, "", draw_triangles(*expected));
    check_pictures(picture, layout, {}, "whole frame, ",
                   [&](Backend& backend, const FrameView& frame, const Execution& execution) {
                     draw(in_clusters, vectors, options, backend, frame, {kBackground}, execution);
                   });
  }
}

}  // namespace edgewise::fuzz
