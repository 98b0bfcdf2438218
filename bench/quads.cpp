#include "quads.h"

#include <algorithm>
#include <cmath>

#include "scene/random.h"

namespace edgewise::bench {

app::Source quads(const SceneRequest& request) {
  Random random(1);
  TriangleStream stream{request.width, request.height, {}};
  for (const int side_px : {16, 32, 64})
    for (int y = 0; y < request.height; y += side_px)
      for (int x = 0; x < request.width; x += side_px) {
        const float z = random.uniform(0.1f, 0.9f);
        const auto corner = [&](int right, int down) {
          return glm::vec3(static_cast<float>(x + right * side_px), static_cast<float>(y + down * side_px),
                           z);
        };
        const glm::vec3 at[4] = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
        const std::uint64_t turn = random.below(2);  // which diagonal
        for (const std::uint64_t first : {turn, turn + 2})
          stream.triangles.push_back({{at[first % 4], at[(first + 1) % 4], at[(first + 2) % 4]},
                                      static_cast<std::uint32_t>(random.below(1u << 24)) | 0xFF000000u});
      }
  for (std::size_t i = stream.triangles.size(); i > 1; --i)
    std::swap(stream.triangles[i - 1], stream.triangles[random.below(i)]);
  const double kept = std::ceil(static_cast<double>(stream.triangles.size()) * std::min(request.scale, 1.0));
  stream.triangles.resize(static_cast<std::size_t>(kept));
  return {kQuadsName, std::move(stream), true};
}

}  // namespace edgewise::bench
