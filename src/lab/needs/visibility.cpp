#include "lab/needs/needs.h"

#include <array>
#include <utility>

#include "core/parallel.h"
#include "lab/choice.h"
#include "lab/visibility/depth_buffer.h"

namespace edgewise::lab {

namespace {

using Draw = void (*)(const VisibilityScene& scene, VisibilityFrame& frame);

template <int kBits>
void draw_unorm(const VisibilityScene& scene, VisibilityFrame& frame) {
  using Plane = UnormPlane<kBits, std::uint32_t>;
  draw_depth_buffer<Plane, std::uint32_t>(scene, frame, frame.depth32, Plane::kMax);
}

constexpr int kMostBits = 30;  // the lab's planes hold the largest value in 32 bits with a sign
constexpr auto kUnorm = []<int... kBits>(std::integer_sequence<int, kBits...>) {
  return std::array<Draw, sizeof...(kBits)>{draw_unorm<kBits + 1>...};
}
(std::make_integer_sequence<int, kMostBits>());
constexpr const char* kInOrder[] = {"submission_order", "painter_mean", "painter_farthest"};
constexpr const char* kOtherFormats[] = {"float_z", "reversed_z", "contract31"};

std::vector<std::uint32_t> ids_of(std::span<const std::uint32_t> visible, const VisibilityScene& scene) {
  std::vector<std::uint32_t> ids(visible.begin(), visible.end());
  for (std::uint32_t& id : ids)
    if (id != kNoTriangle) id = scene.triangles[id].screen.payload;
  return ids;
}

}  // namespace

VisibilityNeeds::VisibilityNeeds() : method_{"visibility", {}}, bits_{"depth buffer", {}} {
  for (const char* name : kInOrder) method_.answers.push_back({name});
  method_.answers.push_back({"depth buffer"});
  for (int bits = 1; bits <= kMostBits; ++bits) bits_.answers.push_back({bits_name(bits)});
  for (const char* name : kOtherFormats) bits_.answers.push_back({name});
  method_.trial = bits_.trial = "pixel";
}

void VisibilityNeeds::add(const StudiedFrame& frame, const VisibilityScene& scene, int threads) {
  const auto right = ids_of(snapped_visible_triangles(scene), scene);
  std::vector<std::pair<Answer*, Draw>> trials;
  for (std::size_t i = 0; i + 1 < method_.answers.size(); ++i)
    trials.emplace_back(&method_.answers[i], find_visibility_method(method_.answers[i].name).draw);
  for (std::size_t i = 0; i < bits_.answers.size(); ++i)
    trials.emplace_back(&bits_.answers[i],
                        i < kUnorm.size() ? kUnorm[i] : find_visibility_method(bits_.answers[i].name).draw);
  std::erase_if(trials, [](const auto& trial) { return !trial.first->enough(); });
  parallel_for(threads, static_cast<int>(trials.size()), [&](int i) {
    const auto& [answer, draw] = trials[static_cast<std::size_t>(i)];
    VisibilityFrame drawn;
    draw(scene, drawn);
    compare_pictures(right, ids_of(drawn.visible, scene), frame, *answer);
  });
  method_.trials += frame.pixels(), bits_.trials += frame.pixels();
  // A depth buffer is enough if any format is. If none is, its witness is that of the last, ours.
  if (bits_.cheapest() == nullptr && method_.answers.back().enough())
    method_.answers.back() = {
        "depth buffer", bits_.answers.back().witness, bits_.answers.back().wrong_px, {}};
}

VisibilityScene visibility_scene(const Drawable& drawable, FrontendOptions options) {
  Frontend frontend;
  options.payload = Payload::id;
  options.keep_unsnapped = true;
  const auto triangles = frontend.run(drawable, options);
  const Size size{options.width, options.height};
  if (const auto* scene = std::get_if<Scene>(&drawable))
    return visibility_scene(triangles, frontend.unsnapped(), *scene, size);
  VisibilityScene result{size.width, size.height, 1.0, 2.0, {}, {}};
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const UnsnappedTriangle& at = frontend.unsnapped()[i];
    VisibilityTriangle t{triangles[i], {}, {}, {}};
    for (int k = 0; k < 3; ++k)
      t.x_px[k] = at.x_px[k], t.y_px[k] = at.y_px[k], t.view_z[k] = 1.0 / (1.0 - double{at.z01[k]} / 2.0);
    result.faces.push_back({static_cast<std::uint32_t>(i), 1});
    result.triangles.push_back(t);
  }
  return result;
}

}  // namespace edgewise::lab
