// Facing sweeps: the tilt of the rays to the faces, and how near the faces are to edge-on.
#include <numbers>

#include "core/random.h"
#include "edgewise/contract.h"
#include "lab/coverage/cracks.h"
#include "lab/facing/facing.h"
#include "lab/sweeps/sweeps.h"

namespace edgewise::lab {

namespace {

// Ours with more bits, whose front end projects in double.
struct Fine {
  std::string_view name;
  int bits;
};
constexpr Fine kFine[] = {{"snapped_area_12", 12}, {"snapped_area_15", 15}};

bool is_front(const FacingScene& scene, const Face& face, int bits) {
  const FacingView& view = scene.view;
  ScreenTriangle t{};
  for (unsigned i = 0; i < 3; ++i) {
    const glm::dvec3 ray = glm::dvec3(scene.positions[face.first + i]) - glm::dvec3(view.eye);
    const double scale =
        double{view.focal_px} / (view.perspective ? glm::dot(glm::dvec3(view.forward), ray) : 1.0);
    const auto snap = [&](int size, glm::vec3 axis) {
      const double px = 0.5 * size + scale * glm::dot(glm::dvec3(axis), ray);
      return static_cast<std::int32_t>(rounded_to(px, bits) * contract::kPixel_q15);
    };
    t.x_q15[i] = snap(view.size.width, view.right), t.y_q15[i] = snap(view.size.height, view.down);
  }
  return contract::signed_area(t) > 0;
}

Measured measure_scene(const FacingScene& scene) {
  const auto facts = facing_facts(scene);
  Measured result = measured(facing_methods(), [&](const FacingMethod& method) {
    const FacingScore s = score(method, scene, facts).source;
    return Tally{s.misclassified, s.faces};
  });
  for (const Fine& fine : kFine) {
    Tally& tally = result.methods.emplace_back();
    for (std::size_t i = 0; i < facts.size(); ++i)
      if (facts[i].source.covers_sample)
        tally += {is_front(scene, scene.faces[i], fine.bits) != facts[i].source.front, 1};
  }
  return result;
}

Measured measure_tilt(double degrees, bool perspective, std::uint64_t seed) {
  return measure_scene(tilted_faces(degrees * std::numbers::pi / 180, perspective, 2000, seed));
}

// Triangles about 80 px long and `height_px` high on the screen, at random distances and positions, each with
// a sample inside or on an edge.
Measured measure_edge_on(double height_px, std::uint64_t seed) {
  FacingScene scene;
  const FacingView& view = scene.view;
  Random random(seed);
  for (int i = 0; i < 2000; ++i) {
    const auto sample_px = [&] { return static_cast<float>(random.below(128)) - 63.5f; };
    const float sample_y = sample_px();
    const glm::vec2 sample(sample_px(), sample_y), along = random.direction(), across(-along.y, along.x);
    const auto height = static_cast<float>(height_px) * (random.below(2) == 0 ? 1.0f : -1.0f);
    const auto add = [&](float along_px, float across_px) {
      const float w = random.uniform(1.0f, 4.0f);
      scene.positions.emplace_back((sample + along_px * along + across_px * across) * (w / view.focal_px), w);
    };
    add(random.uniform(-60, -20), -0.25f * height);
    add(random.uniform(20, 60), -0.25f * height);
    add(random.uniform(-20, 20), 0.75f * height);
    scene.add_face(scene.positions.size() - 3);
  }
  return measure_scene(scene);
}

std::vector<double> every_other(std::vector<double> positions) {
  std::vector<double> kept;
  for (std::size_t i = 0; i < positions.size(); i += 2) kept.push_back(positions[i]);
  return kept;
}

}  // namespace

std::vector<MethodInfo> swept_facing_methods() {
  std::vector<MethodInfo> list = methods_of(Family::facing);
  for (const Fine& fine : kFine) {
    list.push_back(list.front());
    list.back().name = fine.name;
  }
  return list;
}

std::vector<Sweep> facing_sweeps() {
  return {{"tilt_perspective",
           Family::facing,
           "faces of random directions off the axis, under perspective",
           {"tilt of the ray to the faces", "degrees"},
           {0, 5, 10, 20, 40, 80},
           [](double degrees, std::uint64_t seed) { return measure_tilt(degrees, true, seed); }},
          {"tilt_orthographic",
           Family::facing,
           "the same under an orthographic camera",
           {"tilt of the ray to the faces", "degrees"},
           {0, 5, 10, 20, 40, 80},
           [](double degrees, std::uint64_t seed) { return measure_tilt(degrees, false, seed); }},
          {"edge_on",
           Family::facing,
           "triangles that are nearly edge-on and still cover a sample",
           {"height on the screen", "px"},
           every_other(powers_of_two(3, -21)),
           measure_edge_on,
           "a face thinner than a step of the grid may turn over: 1/256 px at 8 bits, 1/32768 px at 15"}};
}

}  // namespace edgewise::lab
