#include "cli/soak/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string>
#include <utility>

#include "cli/soak/reduce.h"
#include "cli/verify/verify.h"
#include "core/atomic_file.h"
#include "edgewise/tri_file.h"
#include "lab/to_stream.h"
#include "support/process.h"

namespace edgewise::soak {

namespace {

constexpr int kMostAttempts = 500;

// The triangles after writing and reading them as a stream, which rounds depths to floats.
std::vector<ScreenTriangle> replayed(std::span<const ScreenTriangle> triangles, const Case& c) {
  Frontend frontend;
  const auto again = frontend.run(lab::to_stream(triangles, c.width, c.height),
                                  {.width = c.width, .height = c.height, .cull = Cull::none, .shade = false});
  return {again.begin(), again.end()};
}

// As few triangles as still differ: of the file if those differ, otherwise of the frame.
TriangleStream smallest_frame(const Case& c, const Finding& finding, Checker& checker,
                              const std::function<bool()>& stop) {
  const auto fails = [&](const std::vector<ScreenTriangle>& list) {
    return checker.differs(finding, c, list);
  };
  std::vector<ScreenTriangle> list = replayed(finding.triangles, c);
  if (!fails(list)) list = finding.triangles;
  return lab::to_stream(reduce(std::move(list), kMostAttempts, fails, stop), c.width, c.height);
}

TriangleStream smallest_stream(const Case& c, const Finding& finding, TriangleStream stream, Checker& checker,
                               const std::function<bool()>& stop) {
  const int width = stream.width, height = stream.height;
  const auto fails = [&](const std::vector<StreamTriangle>& triangles) {
    return checker.differs(finding, c, TriangleStream{width, height, triangles});
  };
  return {width, height, reduce(std::move(stream.triangles), kMostAttempts, fails, stop)};
}

void write(const std::filesystem::path& path, const TriangleStream& stream) {
  std::filesystem::create_directories(path.parent_path());
  AtomicFile file(path);
  write_tri(file.stream(), stream);
  file.commit();
}

// Whether `verify` reproduces the difference: its configurations are fewer.
bool verify_finds(const std::filesystem::path& path, const Judged& judged) {
  tools::VerifyPlan plan;
  plan.backends = judged.backends;
  return !tools::verify_scene(plan, path.string(), [](double) {}).ok();
}

// Quoted for a shell.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

nlohmann::json description(const Case& c, const Finding& f, const Judged& judged) {
  nlohmann::json json{{"case", c.number},
                      {"family", c.family},
                      {"judge", f.judge},
                      {"backend", f.of_frontend ? "front end" : judged.backends[f.draw.backend].name},
                      {"threads", f.draw.how.execution.threads},
                      {"simd_target", name_of(f.draw.how.execution.target)},
                      {"width", c.width},
                      {"height", c.height}};
  if (f.of_frontend) return json;
  json["input"] = input_of(f.draw);
  json["tile_size"] = f.draw.how.execution.tile_size;
  json["ablation"] = edgewise::describe(f.draw.how.ablation);
  json["row_padding"] = f.draw.layout.padding;
  json["row_offset"] = f.draw.layout.offset;
  json["pixels"] = f.difference.pixels;
  json["first"] = {f.difference.first_x, f.difference.first_y};
  json["written_outside"] = f.difference.outside;
  json["triangles"] = f.triangles.size();
  return json;
}

}  // namespace

nlohmann::json evidence_of(const Evidence& evidence, std::uint64_t seed, const Case& c, const Finding& found,
                           Checker& checker) {
  Finding finding = found;
  nlohmann::json json = description(c, finding, checker.judged());
  json["replay"] = {fmt::format("{} soak --seed {} --case {}", quoted(evidence.program), seed, c.number)};
  const auto* stream = c.drawable ? std::get_if<TriangleStream>(&*c.drawable) : nullptr;
  try {
    // Blames the whole frame only if the front end's triangles, drawn from memory, show no difference.
    finding.draw.whole_frame = false;
    finding.draw.whole_frame = found.draw.whole_frame && !checker.differs(finding, c, finding.triangles);
    if (!finding.of_frontend) json["input"] = input_of(finding.draw);
    const bool of_drawable = finding.of_frontend || finding.draw.whole_frame;
    if (evidence.folder.empty() || (of_drawable && stream == nullptr)) return json;
    const TriangleStream smallest = of_drawable ? smallest_stream(c, finding, *stream, checker, evidence.stop)
                                                : smallest_frame(c, finding, checker, evidence.stop);
    std::string name = fmt::format("seed-{}-case-{}-{}-vs-{}.tri", seed, c.number,
                                   json["backend"].get<std::string>(), finding.judge);
    std::replace(name.begin(), name.end(), ' ', '-');
    const std::filesystem::path path = evidence.folder / name;
    write(path, smallest);
    json["file"] = path.string();
    json["reduced_to"] = smallest.triangles.size();
    if (!evidence.stop() && verify_finds(path, checker.judged()))
      json["replay"].push_back(
          fmt::format("{} verify {}", quoted(evidence.program), quoted(absolute(path).string())));
  } catch (const std::exception& error) {
    json["trouble"] = tools::reason_of(error);
  }
  return json;
}

}  // namespace edgewise::soak
