#include "lab/needs/needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/parallel.h"
#include "lab/coverage/cracks.h"
#include "lab/coverage/fixed_edges.h"
#include "lab/error_marks.h"

namespace edgewise::lab {

namespace {

template <int kBits>
void record(std::span<const FloatTriangle> triangles, Window window, std::vector<Run>& runs) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    RunRecorder plot(static_cast<std::uint32_t>(i), runs);
    FixedEdges<kBits, std::int64_t>::cover(triangles[i].at, window, plot);
  }
}
using Record = void (*)(std::span<const FloatTriangle>, Window, std::vector<Run>&);
constexpr auto kRecord = []<int... kBits>(std::integer_sequence<int, kBits...>) {
  return std::array<Record, sizeof...(kBits)>{record<kBits>...};
}
(std::make_integer_sequence<int, kMostSubpixelBits + 1>());

constexpr const char* kFloatMethods[] = {"float_lt", "float_le", "float_top_left", "double_top_left"};

// The ids of the triangles that cover a pixel.
std::vector<std::uint32_t> triangles_at(std::span<const Run> runs, int x, int y, const CoverageScene& scene) {
  std::vector<std::uint32_t> ids;
  for (const Run& run : runs)
    if (run.y == y && run.x0 <= x && x < run.x1)
      ids.push_back(scene.truth ? run.triangle : scene.floats[run.triangle].payload);
  return ids;
}

// Makes the first pixel with one of these marks the witness.
void add_witness(const MarkedPicture& marked, std::span<const Mark> kinds, const StudiedFrame& frame,
                 const CoverageScene& scene, std::span<const Run> truth, std::span<const Run> runs,
                 std::uint64_t wrong_px, Answer& answer) {
  const auto at = std::find_first_of(marked.marks.begin(), marked.marks.end(), kinds.begin(), kinds.end());
  if (at == marked.marks.end()) return;
  const int i = static_cast<int>(at - marked.marks.begin()), x = i % scene.size.width,
            y = i / scene.size.width;
  answer.witness =
      Witness{frame.index, x, y, triangles_at(truth, x, y, scene), triangles_at(runs, x, y, scene)};
  answer.wrong_px = wrong_px;
}

}  // namespace

CoverageNeeds::CoverageNeeds(std::optional<double> displacement) : displacement_(displacement) {
  for (int bits = 0; bits <= kMostSubpixelBits; ++bits) {
    const std::string name = bits_name(bits);
    bits_.push_back({{name}, {name}});
  }
  for (const char* name : kFloatMethods) floats_.push_back({{name}, {name}});
}

void CoverageNeeds::add(const StudiedFrame& frame, const CoverageScene& scene, int threads) {
  constexpr Mark kCracks[] = {Mark::gap, Mark::twice};
  constexpr Mark kAny[] = {Mark::gap, Mark::twice, Mark::missing, Mark::extra};
  const Window window = scene.window();
  const SourceJudge source(scene, threads);
  crossings_ += edge_crossings(source.source(), window);
  const CrackJudge judge(scene.floats, source.floats());
  shared_crossings_ += judge.surface().crossings(window);
  const int fixed = static_cast<int>(bits_.size());
  parallel_for(threads, fixed + static_cast<int>(floats_.size()), [&](int i) {
    const auto n = static_cast<std::size_t>(i < fixed ? i : i - fixed);
    Tried& tried = i < fixed ? bits_[n] : floats_[n];
    std::vector<Run> runs;
    if (i < fixed)
      kRecord[n](scene.floats, window, runs);
    else
      find_drawing_method(tried.cracks.name).runs(scene.input(), window, runs);
    const DrawnRuns drawn(std::move(runs), window);
    const CoverageScore score = source.score(drawn);
    const Cracks cracks = judge.find(drawn, i < fixed ? std::optional(i) : std::nullopt);
    tried.wrong += score.errors();
    const std::uint64_t cracked = cracks.at_shared_edges() + cracks.at_t_junctions() + cracks.folds.size();
    const bool new_crack = cracked != 0 && tried.cracks.enough(),
               new_error = score.errors() != 0 && tried.displaced.enough();
    if (!new_crack && !new_error) return;
    const DrawnRuns of_sources = source.of_sources(drawn);
    const MarkedPicture marked = mark_coverage(source.truth(), of_sources, cracks, source.source());
    if (new_crack)
      add_witness(marked, kCracks, frame, scene, source.truth().runs, of_sources.runs, cracked, tried.cracks);
    if (new_error)
      add_witness(marked, kAny, frame, scene, source.truth().runs, of_sources.runs, score.errors(),
                  tried.displaced);
  });
}

std::uint64_t CoverageNeeds::allowed() const {
  if (!displacement_) return bits_[8].wrong;
  return static_cast<std::uint64_t>(*displacement_ * static_cast<double>(crossings_) / 1e6);
}

Question CoverageNeeds::cracks(const char* name, const std::vector<Tried>& all) const {
  Question question{name, {}, {}, shared_crossings_, "shared-edge crossing", "crack"};
  for (const Tried& tried : all) question.answers.push_back(tried.cracks);
  return question;
}

Question CoverageNeeds::displaced() const {
  const std::string limit =
      displacement_ ? fmt::format("at most {:g} per 10^6", *displacement_) : "no worse than 8 bits";
  Question question{"subpixel bits, " + limit, {}, {}, crossings_, "edge crossing", "displaced pixel"};
  for (const Tried& tried : bits_) {
    question.answers.push_back(tried.displaced);
    if (tried.wrong <= allowed()) question.answers.back() = {tried.displaced.name};
  }
  return question;
}

std::vector<Question> CoverageNeeds::questions() const {
  if (shared_crossings_ == 0) return {displaced()};
  return {cracks("subpixel bits: no crack, no fold", bits_), displaced(),
          cracks("float edges without a crack", floats_)};
}

}  // namespace edgewise::lab
