#include "properties/property.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <stdexcept>

#include "edgewise/tri_file.h"
#include "support.h"

namespace edgewise::testing {

namespace {

constexpr int kFullFactor = 25;

// A property that throws counts as violated.
Verdict judge(const Property& property, const TriangleStream& stream) {
  try {
    return property(stream);
  } catch (const std::exception& error) {
    return {1, std::string("exception: ") + error.what(), {stream}};
  }
}

std::filesystem::path write(const TriangleStream& stream, const std::filesystem::path& path) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  write_tri(out, stream);
  if (!out.flush()) throw std::runtime_error(path.string() + ": cannot be written");
  return path;
}

}  // namespace

Counterexample smallest(const rc::Shrinkable<TriangleStream>& stream, const Property& property) {
  const auto [value, shrinks] = rc::shrinkable::findLocalMin(
      stream, [&](const TriangleStream& smaller) { return !judge(property, smaller).wrong.empty(); });
  return {judge(property, value), shrinks};
}

SearchResult search(const rc::Gen<TriangleStream>& streams, int cases, const Property& property) {
  rc::Random random(static_cast<std::uint64_t>(GTEST_FLAG_GET(random_seed)));
  SearchResult result;
  for (int i = 0; i < cases && !result.found; ++i) {
    const auto stream = streams(random.split(), 1 + i * rc::kNominalSize / cases);
    const Verdict verdict = judge(property, stream.value());
    ++result.cases;
    result.comparisons += verdict.comparisons;
    if (!verdict.wrong.empty()) result.found = smallest(stream, property);
  }
  return result;
}

std::string report(const Counterexample& found, const std::filesystem::path& folder,
                   const std::string& name) {
  const Verdict& verdict = found.verdict;
  std::string files, counts;
  for (const TriangleStream& stream : verdict.replay) {
    const std::string number = files.empty() ? "" : '-' + std::to_string(&stream - verdict.replay.data() + 1);
    if (!files.empty()) counts += " and ";
    counts += std::to_string(stream.triangles.size());
    files +=
        " '" + write(stream, std::filesystem::absolute(folder) / (name + number + ".tri")).string() + "'";
  }
  return verdict.wrong + "\nSmallest case, after " + std::to_string(found.shrinks) + " shrinks: " + counts +
         " triangle(s). To see it again:\n  '" EDGEWISE_PROGRAM "' verify" + files + "\n";
}

void fail(const Counterexample& found) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "." + test->name();
  std::replace(name.begin(), name.end(), '/', '-');  // of parameterised tests
  ADD_FAILURE() << report(found, std::filesystem::path(EDGEWISE_PROGRAM).parent_path() / "property-failures",
                          name);
}

void check(const rc::Gen<TriangleStream>& streams, int cases, const Property& property) {
  const SearchResult result = search(streams, full_size() ? cases * kFullFactor : cases, property);
  ::testing::Test::RecordProperty("cases", std::to_string(result.cases));
  ::testing::Test::RecordProperty("comparisons", std::to_string(result.comparisons));
  if (result.found) fail(*result.found);
}

}  // namespace edgewise::testing
