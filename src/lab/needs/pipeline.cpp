#include "lab/needs/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <set>

#include "core/parallel.h"
#include "edgewise/contract.h"
#include "frontend/transform.h"
#include "frontend/view.h"
#include "lab/choice.h"
#include "lab/clipping/truth.h"
#include "lab/view_space.h"
#include "lab/visibility/depth_buffer.h"

namespace edgewise::lab {

namespace {

constexpr std::uint16_t kPlanes[kViewPlanes] = {kNear, kFar, kGuard};
enum PlaneLevel { kNothing, kDrop, kClip };

constexpr const char* kFacingTests[] = {"no test",        "normal_z",   "normal_dot_object",
                                        "normal_dot_eye", "float_area", "snapped_area"};
enum FacingLevel { kNoTest, kFirstNormal, kFloatArea = 4, kSnappedArea };

constexpr const char* kVisibilities[] = {"submission_order", "painter_mean", "painter_farthest",
                                         "depth buffer"};
constexpr int kDepthBuffer = 3;

using Draw = void (*)(const VisibilityScene& scene, VisibilityFrame& frame);
template <int kBits>
void draw_unorm(const VisibilityScene& scene, VisibilityFrame& frame) {
  using Plane = UnormPlane<kBits, std::uint32_t>;
  draw_depth_buffer<Plane, std::uint32_t>(scene, frame, frame.depth32, Plane::kMax);
}
constexpr int kMostDepthBits = 30;  // the lab's planes hold the largest value in 32 bits with a sign
constexpr auto kUnorm = []<int... kBits>(std::integer_sequence<int, kBits...>) {
  return std::array<Draw, sizeof...(kBits)>{draw_unorm<kBits + 1>...};
}
(std::make_integer_sequence<int, kMostDepthBits>());
// The levels above: ours, which is exact, and those that are judged alone.
constexpr const char* kOtherDepths[] = {"contract31", "float_z", "reversed_z"};

Draw draw_of(const Pipeline& pipeline) {
  if (pipeline[kVisibility] != kDepthBuffer)
    return find_visibility_method(kVisibilities[pipeline[kVisibility]]).draw;
  const auto level = static_cast<std::size_t>(pipeline[kDepth]);
  return level < kUnorm.size() ? kUnorm[level]
                               : find_visibility_method(kOtherDepths[level - kUnorm.size()]).draw;
}

// The order in which stages are weakened first.
constexpr Stage kOrder[] = {kVisibility, kDepth, kFacing, kNearPlane, kFarPlane, kGuardBand, kSubpixel};
constexpr int kMostOrders = 120;

Question question(std::string name, std::span<const char* const> levels) {
  Question result{std::move(name), {}};
  for (const char* level : levels) result.answers.push_back({level});
  result.trial = "pixel";
  return result;
}

std::int32_t snap_to(float px, int bits) {
  constexpr float kLimit = contract::kMaxImageSide;
  return edgewise::round_half_even(std::clamp(px, -kLimit, kLimit) * static_cast<float>(1 << bits)) *
         (1 << (contract::kSubBits - bits));
}

double area_px(const VisibilityTriangle& t) {
  const float qx = t.x_px[1] - t.x_px[0], qy = t.y_px[1] - t.y_px[0], rx = t.x_px[2] - t.x_px[0],
              ry = t.y_px[2] - t.y_px[0];
  return double{qx * ry - qy * rx};
}

std::uint32_t id_of(std::uint32_t visible, const VisibilityScene& scene) {
  return visible == kNoTriangle ? kNoTriangle : scene.triangles[visible].screen.payload;
}
std::vector<std::uint32_t> ids_of(std::vector<std::uint32_t> visible, const VisibilityScene& scene) {
  for (std::uint32_t& triangle : visible) triangle = id_of(triangle, scene);
  return visible;
}

// Calls body(i, drawn) for each i below `count`, with one Drawn per thread.
template <typename Drawn, typename Body>
void for_each_task(std::vector<Drawn>& memory, std::size_t count, Body&& body) {
  std::atomic<std::size_t> next = 0;
  const int threads = static_cast<int>(memory.size());
  parallel_for(threads, threads, [&](int thread) {
    for (std::size_t i; (i = next++) < count;) body(i, memory[static_cast<std::size_t>(thread)]);
  });
}

// The triangles that the front end makes of a frame, not culled. Streams have no camera. The result's planes
// are then at 1 and 2, and its distances 1 / (1 - z / 2), which give each vertex its depth z again.
VisibilityScene scene_of(const Drawable& drawable, FrontendOptions options) {
  Frontend frontend;
  options.cull = Cull::none;
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

// Calls add(triangle) for a polygon's triangles, without any that has a coordinate that is not finite.
template <typename Add>
void emit(std::span<const ClipVertex> polygon, std::uint32_t id, const VisibilityScene& scene, Add&& add) {
  const auto finite = [](const ClipVertex& v) { return std::isfinite(x_px(v)) && std::isfinite(y_px(v)); };
  if (!std::all_of(polygon.begin(), polygon.end(), finite)) return;
  const ViewDepth depth(scene.near_z, scene.far_z);
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    VisibilityTriangle t{};
    t.screen.payload = id;
    const std::size_t corners[3] = {0, i - 1, i};
    for (int k = 0; k < 3; ++k) {
      const ClipVertex& v = polygon[corners[k]];
      t.x_px[k] = x_px(v), t.y_px[k] = y_px(v);
      t.screen.x_sub[k] = snap(t.x_px[k]), t.screen.y_sub[k] = snap(t.y_px[k]);
      t.screen.z[k] = depth.units(v.w);
      t.view_z[k] = std::clamp(v.w, scene.near_z, scene.far_z);
    }
    add(t);
  }
}

}  // namespace

void PipelineNeeds::start(const StudiedFrame& frame) {
  if (std::holds_alternative<Scene>(frame.drawable)) {
    constexpr const char* kLevels[] = {"nothing", "drop whole triangles", "clip"};
    for (const Stage plane : {kNearPlane, kFarPlane, kGuardBand}) {
      stages_.push_back(plane);
      alone_[plane] = question(std::string(name_of(static_cast<ViewPlane>(plane))), kLevels);
    }
    if (frame.options.cull == Cull::back) stages_.push_back(kFacing);
  }
  stages_.insert(stages_.end(), {kVisibility, kDepth, kSubpixel});
  alone_[kFacing] = question("facing test", kFacingTests);
  alone_[kVisibility] = question("visibility", kVisibilities);
  alone_[kDepth] = question("depth buffer", {});
  for (int bits = 1; bits <= kMostDepthBits; ++bits) alone_[kDepth].answers.push_back({bits_name(bits)});
  alone_[kDepth].answers.push_back({kOtherDepths[0]});
  float_depth_ = question("float depth buffer", std::span(kOtherDepths).subspan(1));
  alone_[kSubpixel] = question("subpixel bits", {});
  for (int bits = 0; bits <= contract::kSubBits; ++bits)
    alone_[kSubpixel].answers.push_back({bits_name(bits)});
  for (std::size_t s = 0; s < kStages; ++s)
    exact_[s] = std::max(0, static_cast<int>(alone_[s].answers.size()) - 1);
}

void PipelineNeeds::add_scene(const StudiedFrame& frame, Frame& kept) {
  const auto& scene = std::get<Scene>(frame.drawable);
  const auto [width, height] = frame.size();
  const ViewVolume view = view_volume(scene.camera, width, height);
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes.at(instance.mesh);
    const ScreenTransform to_screen(scene.camera, instance, width, height);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Reaching reaching{static_cast<std::uint32_t>(kept.fronts.size()), 0, kInvisible, {}};
      kept.fronts.push_back(mesh.has_flag(i, kTwoSided) ? 1 : 0);
      for (int k = 0; k < 3; ++k) {
        const glm::vec3 p = mesh.positions.at(mesh.triangles[i][k]);
        const std::uint16_t sides = outside_of(as_clip_vertex(transform(to_screen, p)), view);
        reaching.any |= sides, reaching.all &= sides;
        reaching.vertices[k] = to_screen(p);
      }
      if ((reaching.any & kMustClip) != 0 && (reaching.any & kNotFinite) == 0)
        kept.reaching.push_back(reaching);
    }
  }
  if (kept.cull != Cull::back) return;
  const ClippingScene seen = in_view_space(scene, frame.size());
  for (int level = kFirstNormal; level < kFloatArea; ++level) {
    const auto fronts = fronts_of(find_facing_method(kFacingTests[level]), seen);
    for (std::size_t id = 0; id < fronts.size(); ++id)
      if (fronts[id] != 0) kept.fronts[id] |= static_cast<std::uint8_t>(1u << level);
  }
}

bool PipelineNeeds::is_two_sided(const Frame& frame, const VisibilityTriangle& t) {
  return !frame.fronts.empty() && (frame.fronts[t.screen.payload] & 1u) != 0;
}

void PipelineNeeds::assemble(const Frame& frame, const Pipeline& pipeline, VisibilityScene& scene) {
  scene = {frame.all.width, frame.all.height, frame.all.near_z, frame.all.far_z, {}, {}};
  const auto is_kept = [&](const VisibilityTriangle& t) {
    const std::int64_t area = contract::signed_area(t.screen);
    const int sign = (area > 0) - (area < 0), level = pipeline[kFacing];
    if (is_two_sided(frame, t)) return true;
    if (frame.cull != Cull::back || level == kSnappedArea) return keeps(frame.cull, sign);
    return level == kNoTest ||
           (level == kFloatArea ? area_px(t) > 0.0 : (frame.fronts[t.screen.payload] >> level & 1u) != 0);
  };
  const auto add = [&](VisibilityTriangle t) {
    if (const int bits = pipeline[kSubpixel]; bits < contract::kSubBits)
      for (int k = 0; k < 3; ++k)
        t.screen.x_sub[k] = snap_to(t.x_px[k], bits), t.screen.y_sub[k] = snap_to(t.y_px[k], bits);
    if (contract::pixel_box(t.screen, scene.width, scene.height).empty() || !is_kept(t)) return;
    scene.faces.push_back({static_cast<std::uint32_t>(scene.triangles.size()), 1});
    scene.triangles.push_back(t);
  };
  const ViewVolume view{static_cast<double>(scene.width), static_cast<double>(scene.height), scene.near_z,
                        scene.far_z};
  Clipper clipper;
  auto next = frame.all.triangles.begin();
  const auto end = frame.all.triangles.end();
  // The weaker planes' triangles take the places of the front end's.
  for (const Reaching& r : frame.reaching) {
    std::uint16_t planes = r.any & kMustClip, all = r.all;
    bool weakened = false;
    for (std::size_t i = 0; i < kViewPlanes; ++i) {
      if ((r.any & kPlanes[i]) == 0 || pipeline[i] == kClip) continue;
      weakened = true;
      if (pipeline[i] == kNothing) all = 0;
      // Clipping at the sides would hide the lack of a near plane: a point between two of them has w >= 0.
      planes &= kPlanes[i] == kNear ? 0 : static_cast<std::uint16_t>(~kPlanes[i]);
    }
    if (!weakened) continue;
    for (; next != end && next->screen.payload < r.id; ++next) add(*next);
    while (next != end && next->screen.payload == r.id) ++next;
    if (all != 0) continue;
    emit(planes == 0 ? std::span<const ClipVertex>(r.vertices) : clipper.clip(r.vertices, planes, view), r.id,
         scene, add);
  }
  for (; next != end; ++next) add(*next);
}

void PipelineNeeds::draw(const Frame& frame, const Pipeline& pipeline, Drawn& drawn) {
  std::pair key(&frame, pipeline);
  key.second[kVisibility] = key.second[kDepth] = 0;
  if (std::exchange(drawn.of, key) != key) assemble(frame, pipeline, drawn.scene);
  draw_of(pipeline)(drawn.scene, drawn.frame);
}

bool PipelineNeeds::is_right(const Frame& frame, const Pipeline& pipeline, Drawn& drawn) {
  draw(frame, pipeline, drawn);
  auto pixel = drawn.frame.visible.begin();
  return std::all_of(frame.right.begin(), frame.right.end(), [&](const auto& run) {
    const auto end = drawn.frame.visible.begin() + static_cast<std::ptrdiff_t>(run.second);
    while (pixel != end) {
      const std::uint32_t triangle = *pixel;
      if (id_of(triangle, drawn.scene) != run.first) return false;
      pixel = std::find_if(pixel, end, [&](std::uint32_t other) { return other != triangle; });
    }
    return true;
  });
}

void PipelineNeeds::compare(const Frame& frame, const Pipeline& pipeline, Answer& answer, Drawn& memory) {
  if (is_right(frame, pipeline, memory)) return;
  const auto drawn = ids_of(memory.frame.visible, memory.scene);
  std::vector<std::uint32_t> right;
  for (const auto& [id, end] : frame.right) right.resize(end, id);
  const auto ids = [](std::uint32_t id) {
    return id == kNoTriangle ? std::vector<std::uint32_t>{} : std::vector{id};
  };
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (right[i] == drawn[i]) continue;
    const int x = static_cast<int>(i) % frame.size.width, y = static_cast<int>(i) / frame.size.width;
    if (++answer.wrong_px == 1) answer.witness = Witness{frame.index, x, y, ids(right[i]), ids(drawn[i])};
  }
  if (answer.witness && frame.keep_pictures)
    answer.picture = mark_visible_triangles(right, drawn, {frame.size.width, frame.size.height});
}

void PipelineNeeds::add(const StudiedFrame& studied, const std::array<Reach, kViewPlanes>& reach,
                        int threads) {
  if (frames_.empty()) start(studied);
  Frame& frame = frames_.emplace_back(Frame{studied.index,
                                            studied.size(),
                                            studied.options.cull,
                                            studied.keep_pictures,
                                            scene_of(studied.drawable, studied.options),
                                            {},
                                            {},
                                            {}});
  const auto* scene = std::get_if<Scene>(&studied.drawable);
  if (scene != nullptr) add_scene(studied, frame);

  // By the truths' own arithmetic; faces are for painters only.
  VisibilityScene seen = frame.all;
  seen.faces.clear();
  std::erase_if(seen.triangles, [&](const VisibilityTriangle& t) {
    return !is_two_sided(frame, t) && !keeps(frame.cull, SnappedTruth(t.screen).facing());
  });
  auto right = ids_of(snapped_visible_triangles(seen), seen);
  if (scene != nullptr) {
    std::vector<std::uint32_t> corrected = right;
    unlike_scene_ += correct(corrected, frame.size, ClippingOracle(*scene, frame.size, frame.cull), threads);
  }
  for (std::size_t i = 0; i < right.size(); ++i)
    if (i + 1 == right.size() || right[i] != right[i + 1]) frame.right.emplace_back(right[i], i + 1);

  std::vector<std::pair<Answer*, Pipeline>> trials;
  for (const Stage stage : stages_) {
    alone_[stage].trials += studied.pixels();
    for (int level = 0; level <= exact_[stage]; ++level) {
      Answer& answer = alone_[stage].answers[static_cast<std::size_t>(level)];
      // Of a plane that no triangle reaches, or that none crosses, weaker levels draw the same triangles.
      const bool same = stage < kViewPlanes && level < kClip &&
                        (level == kNothing ? reach[stage].beyond : reach[stage].crossing) == 0;
      if (!answer.enough() || same) continue;
      trials.emplace_back(&answer, exact_).second[stage] = level;
    }
  }
  float_depth_.trials += studied.pixels();
  for (int level = exact_[kDepth]; Answer & answer : float_depth_.answers) {
    ++level;
    if (answer.enough()) trials.emplace_back(&answer, exact_).second[kDepth] = level;
  }
  std::vector<Drawn> memory(static_cast<std::size_t>(threads));
  for_each_task(memory, trials.size(), [&](std::size_t i, Drawn& drawn) {
    const auto& [answer, pipeline] = trials[i];
    compare(frame, pipeline, *answer, drawn);
  });
}

std::string PipelineNeeds::proof(Stage stage, const Ranges& ranges, bool drop) const {
  if (stage >= kViewPlanes) return {};
  const auto plane = static_cast<ViewPlane>(stage);
  const Reach& reach = ranges.reach(plane);
  if (reach.beyond == 0) return ranges.describe(plane);
  if (reach.crossing != 0 || !drop) return {};
  return fmt::format("of the {} triangles that reach beyond it, each lies outside one side of the view",
                     reach.beyond);
}

std::vector<Question> PipelineNeeds::alone(const Ranges& ranges) const {
  std::vector<Question> questions;
  for (const Stage stage : stages_) {
    questions.push_back(alone_[stage]);
    questions.back().proof = proof(stage, ranges, !alone_[stage].answers.front().enough());
  }
  questions.push_back(float_depth_);
  return questions;
}

// Judges pipelines on all frames, each once.
class PipelineNeeds::Search {
 public:
  Search(const PipelineNeeds& needs, const Pipeline& start, int threads,
         const std::function<void(std::size_t)>& judged)
      : needs_(needs), start_(start), judged_(judged), memory_(static_cast<std::size_t>(threads)) {}

  // The first frame that is wrong; null if none is.
  const Frame* first_wrong(const Pipeline& pipeline) {
    judge({&pipeline, 1});
    const std::size_t first = wrong_.at(pipeline);
    return first == needs_.frames_.size() ? nullptr : &needs_.frames_[first];
  }

  // The first wrong one of the pipeline and those that differ from it in one or two stages, which are more
  // precise; null if there is none.
  std::optional<Pipeline> refutation(const Pipeline& pipeline) {
    if (first_wrong(pipeline) != nullptr) return pipeline;
    std::set<Pipeline> more;
    for (const Stage a : needs_.stages_)
      for (const Stage b : needs_.stages_) {
        Pipeline raised = pipeline;
        for (raised[a] = pipeline[a]; a < b && raised[a] <= start_[a]; ++raised[a])
          for (raised[b] = pipeline[b]; raised[b] <= start_[b]; ++raised[b]) more.insert(canonical(raised));
      }
    const std::vector<Pipeline> all(more.begin(), more.end());
    judge(all);
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Pipeline& p) { return first_wrong(p) != nullptr; });
    return found == all.end() ? std::nullopt : std::optional(*found);
  }

  // The same pipeline with a stage one level down.
  Pipeline weaker(Pipeline pipeline, Stage stage) const {
    --pipeline[stage];
    return canonical(pipeline);
  }
  bool has_weaker(const Pipeline& pipeline, Stage stage) const {
    return pipeline[stage] > 0 && (stage != kDepth || pipeline[kVisibility] == kDepthBuffer);
  }

  // Weakens in this order until no stage can be.
  Pipeline weaken(std::span<const Stage> order) {
    Pipeline pipeline = start_;
    for (bool changed = true; std::exchange(changed, false);)
      for (const Stage stage : order)
        while (has_weaker(pipeline, stage) && !refutation(weaker(pipeline, stage)))
          pipeline = weaker(pipeline, stage), changed = true;
    return pipeline;
  }

 private:
  // Without a depth buffer, its bits change nothing.
  Pipeline canonical(Pipeline pipeline) const {
    if (pipeline[kVisibility] != kDepthBuffer) pipeline[kDepth] = start_[kDepth];
    return pipeline;
  }

  void judge(std::span<const Pipeline> pipelines) {
    const std::size_t frames = needs_.frames_.size();
    std::vector<Pipeline> unknown;
    std::copy_if(pipelines.begin(), pipelines.end(), std::back_inserter(unknown),
                 [&](const Pipeline& p) { return !wrong_.contains(p); });
    std::vector<std::atomic<std::size_t>> first(unknown.size());
    for (auto& frame : first) frame = frames;
    for_each_task(memory_, unknown.size() * frames, [&](std::size_t task, Drawn& drawn) {
      const std::size_t i = task / frames, frame = task % frames;
      if (frame > first[i] || is_right(needs_.frames_[frame], unknown[i], drawn)) return;
      std::size_t before = first[i];
      while (frame < before && !first[i].compare_exchange_weak(before, frame)) {
      }
    });
    for (std::size_t i = 0; i < unknown.size(); ++i) wrong_[unknown[i]] = first[i];
    judged_(wrong_.size());
  }

  const PipelineNeeds& needs_;
  Pipeline start_;
  const std::function<void(std::size_t)>& judged_;
  std::vector<Drawn> memory_;
  std::map<Pipeline, std::size_t> wrong_;  // the first wrong frame; their number if none is
};

LeastPrecise PipelineNeeds::least_precise(const Ranges& ranges, int threads,
                                          const std::function<void(std::size_t)>& judged) const {
  Pipeline start = exact_;
  for (std::size_t i = 0; i < kViewPlanes; ++i) {
    const Reach& reach = ranges.reach(static_cast<ViewPlane>(i));
    start[i] = reach.beyond == 0 ? kNothing : reach.crossing == 0 ? kDrop : kClip;
  }
  Search search(*this, start, threads, judged);
  LeastPrecise result;
  if (const Frame* frame = search.first_wrong(start)) {
    result.stages = {{"pipeline", {{"the exact one"}}}};
    Drawn memory;
    compare(*frame, start, result.stages.front().answers.front(), memory);
    return result;
  }

  // Stages that cannot be weakened even alone come last; they need no other orders.
  std::vector<Stage> order;
  std::copy_if(std::begin(kOrder), std::end(kOrder), std::back_inserter(order), [&](Stage stage) {
    return std::find(stages_.begin(), stages_.end(), stage) != stages_.end();
  });
  const auto movable = std::stable_partition(order.begin(), order.end(), [&](Stage stage) {
    return start[stage] > 0 && search.first_wrong(search.weaker(start, stage)) == nullptr;
  });
  std::vector<std::size_t> turn(static_cast<std::size_t>(movable - order.begin()));
  std::iota(turn.begin(), turn.end(), 0u);
  std::vector<Pipeline> found;
  do {
    std::vector<Stage> stages = order;
    for (std::size_t i = 0; i < turn.size(); ++i) stages[i] = order[turn[i]];
    const Pipeline pipeline = search.weaken(stages);
    if (std::find(found.begin(), found.end(), pipeline) == found.end()) found.push_back(pipeline);
  } while (++result.orders < kMostOrders && std::next_permutation(turn.begin(), turn.end()));

  const auto level_of = [&](const Pipeline& pipeline, Stage stage) {
    return alone_[stage].answers[static_cast<std::size_t>(pipeline[stage])].name;
  };
  const Pipeline& least = found.front();
  for (const Stage stage : stages_) {
    if (stage == kDepth && least[kVisibility] != kDepthBuffer) continue;
    Question question{alone_[stage].name, {}};
    question.proof = proof(stage, ranges, least[stage] == kDrop);
    question.trials = alone_[stage].trials, question.trial = alone_[stage].trial;
    if (search.has_weaker(least, stage)) {
      const Pipeline weaker = search.weaker(least, stage), wrong = *search.refutation(weaker);
      Answer& answer = question.answers.emplace_back(Answer{level_of(weaker, stage)});
      for (const Stage other : stages_)
        if (wrong[other] != weaker[other])
          answer.name += fmt::format(", {} {}", alone_[other].name, level_of(wrong, other));
      Drawn memory;
      compare(*search.first_wrong(wrong), wrong, answer, memory);
    }
    for (int level = least[stage]; level <= exact_[stage]; ++level)
      question.answers.push_back({alone_[stage].answers[static_cast<std::size_t>(level)].name});
    result.stages.push_back(std::move(question));
  }
  for (std::size_t i = 1; i < found.size(); ++i) {
    auto& other = result.others.emplace_back();
    for (const Stage stage : stages_)
      if (stage != kDepth || found[i][kVisibility] == kDepthBuffer)
        other[alone_[stage].name] = level_of(found[i], stage);
  }
  return result;
}

}  // namespace edgewise::lab
