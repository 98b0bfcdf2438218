// A property is a claim about every triangle stream. RapidCheck generates streams and shrinks a
// counterexample, which is written as .tri files that the program replays.
#pragma once

#include <rapidcheck.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "edgewise/scene.h"

namespace edgewise::testing {

// The result of a property for one stream.
struct Verdict {
  std::uint64_t comparisons = 0;  // of pictures, or of planes of counts
  std::string wrong = {};         // the first difference; empty if the property holds
  std::vector<TriangleStream>
      replay;  // the streams to draw to see it: this one, and what it was compared with

  // Counts a comparison; `difference` is empty if it found none.
  void compare(const std::string& difference, const std::string& what) {
    ++comparisons;
    if (wrong.empty() && !difference.empty()) wrong = what + ": " + difference;
  }
};

using Property = std::function<Verdict(const TriangleStream&)>;

struct Counterexample {
  Verdict verdict;  // of the smallest stream
  std::size_t shrinks;
};

// Shrinks a stream that breaks the property, as far as the search succeeds.
Counterexample smallest(const rc::Shrinkable<TriangleStream>& stream, const Property& property);

struct SearchResult {
  std::uint64_t cases = 0, comparisons = 0;
  std::optional<Counterexample> found;
};

// Tries `cases` streams of growing size, up to the first that breaks the property.
SearchResult search(const rc::Gen<TriangleStream>& streams, int cases, const Property& property);

// Writes the streams to replay as FOLDER/NAME.tri, NAME-2.tri … and returns the message: the difference, the
// files, and the command that reproduces it.
std::string report(const Counterexample& found, const std::filesystem::path& folder, const std::string& name);

// Fails the current test with a report. Its files are named after the test, in property-failures beside the
// program.
void fail(const Counterexample& found);

// Searches, and fails if there is a counterexample. `cases` is the default number; the full size tries
// 25 times as many. --gtest_random_seed=N tries others. Records "cases" and "comparisons".
void check(const rc::Gen<TriangleStream>& streams, int cases, const Property& property);

}  // namespace edgewise::testing
