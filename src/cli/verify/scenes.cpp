#include "cli/verify/verify.h"

#include <algorithm>
#include <cmath>

namespace edgewise::tools {

namespace {

// Odd and prime sides: no tile, vector or cell size divides them.
constexpr Size kQuickSize{509, 283}, kFullSize{1920, 1080}, kOracleSize{61, 37};
constexpr double kQuickScale = 0.02, kQuickMeshScale = 0.1;
constexpr double kEnoughTriangles = 400;
constexpr double kOracleBudget =
    7.5e6;  // pixels times triangles for each culling mode, a quarter of a second

const TriangleStream* stream_of(const Shot& shot) {
  return std::get_if<TriangleStream>(&shot.source.drawable);
}

Shot load(const VerifyPlan& plan, const std::string& name, std::optional<Size> size,
          std::optional<double> scale) {
  SceneOptions options;
  options.size = size;
  options.scale = scale;
  options.fit = plan.fit;
  options.subpixel_bits = plan.subpixel_bits;
  return load_shot(name, options, 0.0);
}

// A built-in stream of about `wanted` triangles or a bit more, at most its full number.
Shot load_thinned(const VerifyPlan& plan, const std::string& name, Size size, double scale, double wanted) {
  Shot shot = load(plan, name, size, scale);
  const auto count = static_cast<double>(stream_of(shot)->triangles.size());
  if (count >= wanted) return shot;
  return load(plan, name, size, std::min(1.0, scale * wanted / count));
}

bool is_affordable(const TriangleStream& stream) {
  return static_cast<double>(stream.size()) * stream.width * stream.height <= kOracleBudget;
}

// Every n-th triangle of a file's stream, scaled to a smaller image.
TriangleStream shrunk(const TriangleStream& stream, Size size, std::size_t most) {
  const std::size_t step = (stream.size() + most - 1) / most;
  const glm::vec3 factor(static_cast<float>(size.width) / static_cast<float>(stream.width),
                         static_cast<float>(size.height) / static_cast<float>(stream.height), 1.0f);
  TriangleStream small{size.width, size.height, {}};
  const auto append = [&](const auto& list, auto& to) {
    for (std::size_t i = 0; i < list.size(); i += step)
      for (auto& vertex : to.emplace_back(list[i]).vertex) vertex *= factor;
  };
  append(stream.triangles, small.triangles), append(stream.exact, small.exact);
  return small;
}

// The image size at which a scene's triangles fit the oracle's budget. A smaller image also has fewer
// triangles.
Size affordable_size(const Shot& shot) {
  Frontend frontend;
  FrontendOptions options = shot.frontend;
  options.cull = Cull::none;
  for (;;) {
    const auto triangles = static_cast<double>(frontend.run(shot.source.drawable, options).size());
    const double cost = triangles * options.width * options.height;
    if (cost <= kOracleBudget || options.width * options.height == 1) return {options.width, options.height};
    const double factor = std::min(0.9, std::sqrt(kOracleBudget / cost));
    const auto smaller = [&](int side) { return std::max(1, static_cast<int>(side * factor) - 1) | 1; };
    options.width = std::min(options.width, smaller(options.width));
    options.height = std::min(options.height, smaller(options.height));
  }
}

}  // namespace

bool covers_each_pixel_once(const Source& source) {
  return source.built_in != nullptr && source.stream && source.name.starts_with("grid");
}

Shot shot_for_comparison(const VerifyPlan& plan, const std::string& name) {
  const SceneInfo* const built_in = is_file_path(name) ? nullptr : &find_scene(name);
  const Size size = plan.size.value_or(plan.full ? kFullSize : kQuickSize);
  const bool scaled = built_in != nullptr && built_in->scalable && !plan.full;
  if (scaled && !built_in->stream) return load(plan, name, size, kQuickMeshScale);
  if (scaled && !name.starts_with("grid"))  // a grid's triangle count depends on the image size
    return load_thinned(plan, name, size, kQuickScale, kEnoughTriangles);
  const bool own_size = !plan.size && is_stream_file(name);
  return load(plan, name, own_size ? std::nullopt : std::optional(size), std::nullopt);
}

Shot shot_for_oracle(const VerifyPlan& plan, const std::string& name) {
  constexpr double kScale = 1e-3;
  const SceneInfo* const built_in = is_file_path(name) ? nullptr : &find_scene(name);
  const bool built_in_stream = built_in != nullptr && built_in->stream;
  const bool scaled_mesh = built_in != nullptr && built_in->scalable && !built_in->stream;
  Shot shot = built_in_stream
                  ? load_thinned(plan, name, kOracleSize, kScale, kEnoughTriangles)
                  : load(plan, name, kOracleSize, scaled_mesh ? std::optional(kScale) : std::nullopt);
  if (const TriangleStream* stream = stream_of(shot); stream != nullptr && !built_in_stream) {
    if (is_affordable(*stream)) {  // keep a counterexample unchanged
      shot.frontend.width = stream->width;
      shot.frontend.height = stream->height;
    } else {
      shot.source.drawable = shrunk(*stream, kOracleSize, static_cast<std::size_t>(kEnoughTriangles));
    }
  }
  const Size size = affordable_size(shot);
  shot.frontend.width = size.width;
  shot.frontend.height = size.height;
  return shot;
}

}  // namespace edgewise::tools
