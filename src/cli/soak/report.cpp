#include "cli/soak/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "support/printable.h"

namespace edgewise::soak {

namespace {

using tools::printable;
using tools::printable_within;

std::string with_commas(std::uint64_t n) {
  std::string text = std::to_string(n);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), 1, ',');
  return text;
}

std::string duration(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  return whole < 3600 ? fmt::format("{}:{:02} min", whole / 60, whole % 60)
                      : fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

std::string table(const Tally& tally, const std::string& category, const char* title) {
  const auto found = tally.by.find(category);
  if (found == tally.by.end()) return {};
  std::string text = fmt::format("{:<32} {:>15} {:>9}\n", title, "compared", "differ");
  for (const auto& [label, count] : found->second)
    text += fmt::format("  {:<30} {:>15} {:>9}\n", printable_within(label, 30), with_commas(count.compared),
                        with_commas(count.differ));
  return text;
}

std::string text_of(const nlohmann::json& json, const char* key) {
  if (!json.contains(key)) return "?";
  return printable(json[key].is_string() ? json[key].get<std::string>() : json[key].dump());
}

// Checks every key, because findings may come from an edited file.
std::string explain(const nlohmann::json& f) {
  std::string text =
      fmt::format("case {} ({}, {}x{}): {} differs from {}\n", text_of(f, "case"), text_of(f, "family"),
                  text_of(f, "width"), text_of(f, "height"), text_of(f, "backend"), text_of(f, "judge"));
  text += fmt::format("  {} threads, {}", text_of(f, "threads"), text_of(f, "simd_target"));
  if (f.contains("pixels"))
    text += fmt::format(
        ", {}, tile {}, ablation: '{}', row padding {} px, first row {} px off a cache line\n"
        "  in {} pixels, the first at {}; words written beside the image: {}",
        text_of(f, "input"), text_of(f, "tile_size"), text_of(f, "ablation"), text_of(f, "row_padding"),
        text_of(f, "row_offset"), text_of(f, "pixels"), text_of(f, "first"), text_of(f, "written_outside"));
  text += '\n';
  if (f.contains("file"))
    text += fmt::format("  reduced to {} of {} triangles: {}\n", text_of(f, "reduced_to"),
                        text_of(f, "triangles"), text_of(f, "file"));
  if (f.contains("trouble")) text += fmt::format("  no file: {}\n", text_of(f, "trouble"));
  if (f.contains("replay") && f["replay"].is_array())
    for (const auto& command : f["replay"])
      if (command.is_string())
        text += fmt::format("  reproduce: {}\n", printable(command.get<std::string>()));
  return text;
}

std::string shards_of(const Record& r) {
  if (r.shards.size() != 1) return fmt::format("{} shards", r.shards.size());
  return fmt::format("shard {}/{}", r.shards[0].index, r.shards[0].of);
}

std::string bounds(const Tally& t) {
  return fmt::format(
      "With 95 % confidence fewer than {:.2g} of all frames and {:.2g} of all pixels differ, if these fail\n"
      "independently (3/n for none in n trials). Cases are independent: fewer than {:.2g} of them differ.\n",
      bound_on(t.frames), bound_on(t.pixels), bound_on(t.cases));
}

}  // namespace

std::string report(const Record& r) {
  const Tally& t = r.tally;
  std::string text = table(t, "family", "family of pictures");
  text += table(t, "backend_simd_target", "backend and SIMD target");
  text += table(t, "frontend_simd_target", "front end and SIMD target");
  for (const auto& finding : r.findings) text += explain(finding);
  text += fmt::format("Seed {}, {}: {} cases in {}.\n", r.seed, shards_of(r), with_commas(t.cases),
                      duration(r.seconds));
  text += fmt::format("{} frames ({} triangles and {} pixels in all) were compared bit for bit with {}\n",
                      with_commas(t.frames), with_commas(t.triangles), with_commas(t.pixels),
                      printable(r.backends.front()));
  text += fmt::format("or, {} of them, with the oracle; also {} triangle lists of the front end: ",
                      with_commas(t.oracle_frames), with_commas(t.frontend_lists));
  if (t.differences() != 0) return text + fmt::format("{} DIFFER.\n", with_commas(t.differences()));
  text += "no bit differs.\n";
  return t.cases == 0 ? text : text + bounds(t);
}

}  // namespace edgewise::soak
