#include "lab/choice/choice.h"

#include <algorithm>

#include "edgewise/builtin.h"
#include "edgewise/draw.h"
#include "lab/projection/truth.h"

namespace edgewise::lab {

namespace {

constexpr std::string_view kOurs = "tiled";
constexpr std::string_view kOthers[] = {"float_lt", "float_le", "float_top_left", "double_top_left",
                                        "fixed_4",  "llvmpipe", "swiftshader"};

Drawable moved(Drawable drawable, float dx_px, float dy_px) {
  for (StreamTriangle& t : std::get<TriangleStream>(drawable).triangles)
    for (glm::vec3& v : t.vertex) v.x += dx_px, v.y += dy_px;
  return drawable;
}

FrontendOptions options_of(const Drawable& drawable, int width, int height) {
  const bool stream = std::holds_alternative<TriangleStream>(drawable);
  return {.width = width, .height = height, .cull = stream ? Cull::none : Cull::back, .shade = !stream};
}

}  // namespace

std::vector<ChoiceScene> choice_scenes(bool quick) {
  const Size size = quick ? Size{480, 270} : Size{1920, 1080};
  const int frames = quick ? 6 : 24;
  const auto built_in = [size](std::string_view name, double scale, float time) {
    return find_scene(name).make({size.width, size.height, time, scale});
  };
  // By distances that no number of subpixel bits holds.
  const auto panned = [built_in](std::string_view name, double scale) {
    return [=](int frame) {
      const auto n = static_cast<float>(frame);
      return moved(built_in(name, scale, 0.0f), 0.37f * n, 0.23f * n);
    };
  };
  return {{"torus-knot", "Mesh: torus-knot, 49,152 triangles, turning", size, frames,
           [=](int frame) { return built_in("torus-knot", 1.0, static_cast<float>(frame) / 60.0f); }},
          {"quads", "User interface: corners on pixel centres, whole-pixel steps", size, frames,
           [=](int frame) {
             const float at_px = 0.5f + static_cast<float>(frame);
             return moved(built_in("quads", 1.0, 0.0f), at_px, at_px);
           }},
          {"large", "Large triangles: 250 of 45,000 px that overlap, moving", size, frames,
           panned("large", 0.25)},
          {"sliver", "Slivers: 2,000 of 500 x 0.5 px, moving", size, frames, panned("sliver", 0.02)}};
}

std::vector<ChoiceMethod> choice_methods(std::span<const CoverageMethod* const> methods) {
  std::vector<ChoiceMethod> list;
  for (const CoverageMethod* method : methods) {
    const std::string name(method->info.name);
    if (name == kOurs)
      for (const int bits : kShownBits) list.push_back({name + "_" + std::to_string(bits), method, bits});
    else if (std::ranges::find(kOthers, name) != std::end(kOthers))
      list.push_back({name, method, 8});
  }
  return list;
}

FrontendOptions FrameDrawer::frontend_options(const Drawable& drawable, const ChoiceMethod& method,
                                              Payload payload) const {
  FrontendOptions options = options_of(drawable, canvas_.frame.width(), canvas_.frame.height());
  options.payload = payload;
  options.first_id = 1;
  options.subpixel_bits = method.subpixel_bits;
  return options;
}

void FrameDrawer::draw(const Drawable& drawable, const ChoiceMethod& method, Payload payload,
                       const Execution& execution) {
  FrontendOptions options = frontend_options(drawable, method, payload);
  if (method.method->backend) {
    const BackendInfo& info = find_backend(method.method->info.name);
    return edgewise::draw(drawable, frontend_, options, canvas_.backend(info.name, info.make),
                          canvas_.frame.view(), {0}, execution);
  }
  options.keep_unsnapped = true;
  const auto screen = frontend_.run(drawable, options, execution);
  const auto unsnapped = frontend_.unsnapped();
  snapped_.assign(screen.begin(), screen.end());
  floats_.resize(screen.size());
  for (std::size_t i = 0; i < floats_.size(); ++i) floats_[i] = {unsnapped[i], screen[i].payload};
  method.method->draw({floats_, snapped_}, canvas_, execution);
}

void FrameDrawer::redraw(const Drawable& drawable, const ChoiceMethod& method, Payload payload) {
  if (method.method->backend) return draw(drawable, method, payload);
  frontend_.run(drawable, frontend_options(drawable, method, payload));
  method.method->draw({floats_, snapped_}, canvas_, {});
}

ChoiceJudge::ChoiceJudge(const Drawable& drawable, Size size, int threads)
    : drawable_(drawable), size_(size) {
  if (const auto* scene = std::get_if<Scene>(&drawable)) {
    source_ = std::make_unique<SceneTruth>(*scene, size, options_of(drawable, 0, 0).cull);
  } else {
    floats_ = float_triangles(std::get<TriangleStream>(drawable));
    source_ = std::make_unique<FloatSource>(floats_);
  }
  exact_ = source_->visible_triangles({size.width, size.height}, threads);
}

bool ChoiceJudge::is_hole(int x, int y, std::uint32_t shown) const {
  const std::uint32_t lost = exact_.triangle_at(x, y);
  if (lost == kNoTriangle) return false;
  const auto touching = [&](std::uint32_t a, std::uint32_t b) {
    return a == b ||
           (a != kNoTriangle && b != kNoTriangle && touch(source_->outline(a), source_->outline(b)));
  };
  for (int py = std::max(0, y - 1); py < std::min(size_.height, y + 2); ++py)
    for (int px = std::max(0, x - 1); px < std::min(size_.width, x + 2); ++px)
      if (!touching(exact_.triangle_at(px, py), lost) || touching(exact_.triangle_at(px, py), shown))
        return false;
  return true;
}

template <typename Shown>
ChoiceCounts ChoiceJudge::count_of(Shown&& shown) const {
  ChoiceCounts counts;
  for (int y = 0; y < size_.height; ++y)
    for (int x = 0; x < size_.width; ++x) {
      const std::uint32_t triangle = shown(x, y);
      if (triangle == exact_.triangle_at(x, y)) continue;
      ++counts.wrong;
      counts.holes += is_hole(x, y, triangle);
    }
  return counts;
}

ChoiceCounts ChoiceJudge::count(const Framebuffer& drawn) const {
  return count_of([&](int x, int y) { return drawn.payload_row(y)[x] - 1; });  // 0 becomes kNoTriangle
}

std::optional<ChoiceCounts> ChoiceJudge::of_float_projection(int threads) const {
  if (std::holds_alternative<TriangleStream>(drawable_)) return {};
  const CoverageScene scene = coverage_scene(drawable_, options_of(drawable_, size_.width, size_.height));
  const auto seen = exact_visible_triangles(std::span(scene.floats), scene.window(), threads);
  return count_of([&](int x, int y) {
    const std::uint32_t at = seen.triangle_at(x, y);
    return at == kNoTriangle ? at : scene.sources[at];
  });
}

}  // namespace edgewise::lab
