#include "core/nearest_name.h"

#include <algorithm>
#include <numeric>

namespace edgewise {

namespace {

// Levenshtein, "Binary codes capable of correcting deletions, insertions, and reversals", 1966.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string did_you_mean(std::string_view name, std::span<const std::string_view> known) {
  const auto nearest = std::ranges::min_element(known, {}, [&](auto k) { return edit_distance(name, k); });
  return nearest == known.end() ? "" : "; did you mean '" + std::string(*nearest) + "'?";
}

std::string unknown_name(std::string_view kind, std::string_view name,
                         std::span<const std::string_view> known) {
  std::string text = "unknown " + std::string(kind) + " '" + std::string(name) + "'";
  text += did_you_mean(name, known) + " (known:";
  for (const auto k : known) text.append(" ").append(k);
  return text += ')';
}

}  // namespace edgewise
