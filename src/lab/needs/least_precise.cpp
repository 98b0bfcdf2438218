#include "lab/needs/least_precise.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <set>

#include "core/parallel.h"
#include "lab/clipping/truth.h"

namespace edgewise::lab {

namespace {

// The order in which stages are weakened first.
constexpr Stage kOrder[] = {kVisibility, kDepth, kFacing, kNearPlane, kFarPlane, kGuardBand, kSubpixel};
constexpr int kMostOrders = 120;

// Calls body(i, memory) for each i below `count`, with one memory per thread.
template <typename Body>
void for_each_task(std::vector<PipelineMemory>& memory, std::size_t count, Body&& body) {
  std::atomic<std::size_t> next = 0;
  const int threads = static_cast<int>(memory.size());
  parallel_for(threads, threads, [&](int thread) {
    for (std::size_t i; (i = next++) < count;) body(i, memory[static_cast<std::size_t>(thread)]);
  });
}

}  // namespace

void PipelineNeeds::start(const StudiedFrame& frame) {
  if (std::holds_alternative<Scene>(frame.drawable)) {
    stages_ = {kNearPlane, kFarPlane, kGuardBand};
    if (frame.options.cull == Cull::back) stages_.push_back(kFacing);
  }
  stages_.insert(stages_.end(), {kVisibility, kDepth, kSubpixel});
  for (const Stage stage : stages_) alone_[stage] = levels_of(stage);
  float_depth_ = float_depths();
}

bool PipelineNeeds::is_right(const Frame& frame, const Pipeline& pipeline, PipelineMemory& memory) {
  frame.frame.draw(pipeline, memory);
  const std::vector<std::uint32_t>& visible = memory.frame.visible;
  auto pixel = visible.begin();
  return std::all_of(frame.right.begin(), frame.right.end(), [&](const auto& run) {
    const auto end = visible.begin() + static_cast<std::ptrdiff_t>(run.second);
    while (pixel != end) {
      const std::uint32_t triangle = *pixel;
      if ((triangle == kNoTriangle ? kNoTriangle : memory.scene.triangles[triangle].screen.payload) !=
          run.first)
        return false;
      pixel = std::find_if(pixel, end, [&](std::uint32_t other) { return other != triangle; });
    }
    return true;
  });
}

void PipelineNeeds::compare(const Frame& frame, const Pipeline& pipeline, Answer& answer,
                            PipelineMemory& memory) {
  if (is_right(frame, pipeline, memory)) return;
  const auto drawn = memory.picture();
  const Size size = frame.frame.size();
  std::vector<std::uint32_t> right;
  for (const auto& [id, end] : frame.right) right.resize(end, id);
  const auto ids = [](std::uint32_t id) {
    return id == kNoTriangle ? std::vector<std::uint32_t>{} : std::vector{id};
  };
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (right[i] == drawn[i]) continue;
    const int x = static_cast<int>(i) % size.width, y = static_cast<int>(i) / size.width;
    if (++answer.wrong_px == 1) answer.witness = Witness{frame.index, x, y, ids(right[i]), ids(drawn[i])};
  }
  if (answer.witness && frame.keep_pictures)
    answer.picture = mark_visible_triangles(right, drawn, {size.width, size.height});
}

void PipelineNeeds::add(const StudiedFrame& studied, const std::array<Reach, kViewPlanes>& reach,
                        int threads) {
  if (frames_.empty()) start(studied);
  Frame& frame = frames_.emplace_back(
      Frame{studied.index, studied.keep_pictures, PipelineFrame(studied.drawable, studied.options), {}});
  const std::vector<std::uint32_t> right = frame.frame.right();
  if (const auto* scene = std::get_if<Scene>(&studied.drawable)) {
    std::vector<std::uint32_t> corrected = right;
    unlike_scene_ += correct(corrected, studied.size(),
                             ClippingOracle(*scene, studied.size(), studied.options.cull), threads);
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
  std::vector<PipelineMemory> memory(static_cast<std::size_t>(threads));
  for_each_task(memory, trials.size(), [&](std::size_t i, PipelineMemory& own) {
    const auto& [answer, pipeline] = trials[i];
    compare(frame, pipeline, *answer, own);
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
    for_each_task(memory_, unknown.size() * frames, [&](std::size_t task, PipelineMemory& memory) {
      const std::size_t i = task / frames, frame = task % frames;
      if (frame > first[i] || is_right(needs_.frames_[frame], unknown[i], memory)) return;
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
  std::vector<PipelineMemory> memory_;
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
    PipelineMemory memory;
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
      PipelineMemory memory;
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
