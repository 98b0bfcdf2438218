#include "cli/verify/random_cases.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "edgewise/contract.h"
#include "lab/hard_triangles.h"

namespace edgewise::randomized {

namespace {

// Hashes seed and number, so that cases are independent. Generator states one step apart would give shifted
// copies of one sequence.
Random random_of(std::uint64_t seed, std::uint64_t number) {
  return Random(Random(Random(seed).next() ^ number).next());
}

// Mostly small images, because many errors occur at image edges; some as large as the contract allows.
std::pair<int, int> random_size(Random& random) {
  const auto up_to = [&](int most) {
    return 1 + static_cast<int>(random.below(static_cast<unsigned>(most)));
  };
  if (random.below(100) == 0) {
    const int width = up_to(1000);
    return {width, up_to(1000)};
  }
  constexpr std::array kLargestSides{4, 20, 80, 80, 150, 150, 300};
  const auto kind = random.below(kLargestSides.size() + 1);
  if (kind < kLargestSides.size()) {
    const int width = up_to(kLargestSides[kind]);
    return {width, up_to(kLargestSides[kind])};
  }
  const int along = up_to(random.below(8) == 0 ? contract::kMaxImageSide : 2048), across = up_to(8);
  return random.below(2) == 0 ? std::pair{along, across} : std::pair{across, along};
}

// Drops triangles once the pixels of all bounding boxes exceed a case's time budget.
void cut_to_budget(std::vector<ScreenTriangle>& triangles, int width, int height) {
  constexpr std::int64_t kBudget = 1'000'000;  // px
  std::int64_t cost = 0;
  const auto beyond = [&](const ScreenTriangle& t) {
    const contract::PixelBox box = contract::pixel_box(t, width, height);
    if (!box.empty()) cost += std::int64_t{box.x1 - box.x0} * (box.y1 - box.y0);
    return cost > kBudget;
  };
  triangles.erase(std::find_if(triangles.begin() + 1, triangles.end(), beyond), triangles.end());
}

}  // namespace

Case make_case(std::uint64_t seed, std::uint64_t number) {
  Random random = random_of(seed, number);
  Case c;
  c.number = number;
  std::tie(c.width, c.height) = random_size(random);
  c.background = static_cast<std::uint32_t>(random.next() >> 32);
  constexpr std::array kThreads{2, 2, 2, 3, 3, 4, 5, 8};
  c.threads = kThreads[random.below(kThreads.size())];
  c.large_oracle_budget = random.below(16) == 0;
  c.draws_seed = random.next();

  const auto lists = lab::triangle_families();
  const auto scenes = scene_families();
  const auto kind = random.below(lists.size() + scenes.size());
  if (kind < lists.size()) {
    c.family = lists[kind];
    // Several chunks, sometimes.
    const auto count = random.below(100) == 0 ? 8000 + random.below(12'000) : 1 + random.below(300);
    c.triangles = lab::adversarial(c.family, static_cast<int>(count), c.width, c.height, random.next());
    cut_to_budget(c.triangles, c.width, c.height);
    return c;
  }
  const SceneFamily& scene = scenes[kind - lists.size()];
  c.family = scene.name;
  constexpr std::array kCulls{Cull::none, Cull::none,  Cull::none,  Cull::back,
                              Cull::back, Cull::front, Cull::front, Cull::both};
  c.frontend.width = c.width;
  c.frontend.height = c.height;
  c.frontend.cull = kCulls[random.below(kCulls.size())];
  c.frontend.shade = random.below(2) == 0;
  c.frontend.payload = random.below(2) == 0 ? Payload::colour : Payload::id;
  c.drawable = scene.make(random, c.width, c.height);
  return c;
}

}  // namespace edgewise::randomized
