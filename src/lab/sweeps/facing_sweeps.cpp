// Facing sweeps: the tilt of the rays to the faces, and how near the faces are to edge-on.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "lab/facing/facing.h"
#include "lab/sweeps/sweeps.h"

namespace edgewise::lab {

namespace {

constexpr YAxis kMisjudged{"misjudged faces, %", false, 100};

Measured measure_scene(const FacingScene& scene) {
  const auto methods = facing_methods();
  const auto facts = facing_facts(scene);
  Measured result(methods.size());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const FacingScore s = score(methods[i], scene, facts).source;
    result.methods[i] = {s.misclassified, s.faces};
  }
  return result;
}

Measured measure_tilt(double degrees, bool perspective, bool quick) {
  return measure_scene(tilted_faces(degrees * std::numbers::pi / 180, perspective, quick ? 2000 : 40000, 1));
}

// Triangles about 80 px long and `height_px` high on the screen, at random distances and positions, each with
// a sample inside or on an edge.
Measured measure_edge_on(double height_px, bool quick, int) {
  FacingScene scene;
  const FacingView& view = scene.view;
  Random random(3);
  for (int i = 0; i < (quick ? 1000 : 10000); ++i) {
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

std::vector<double> tilts() {
  std::vector<double> degrees;
  for (int i = 0; i <= 80; i += 5) degrees.push_back(i);
  return degrees;
}

}  // namespace

std::vector<Sweep> facing_sweeps() {
  return {{"tilt_perspective",
           Family::facing,
           "faces of random directions off the axis, under perspective",
           {"tilt of the ray to the faces", "degrees", false},
           kMisjudged,
           10,
           tilts(),
           [](double degrees, bool quick, int) { return measure_tilt(degrees, true, quick); }},
          {"tilt_orthographic",
           Family::facing,
           "the same under an orthographic camera",
           {"tilt of the ray to the faces", "degrees", false},
           kMisjudged,
           6,
           tilts(),
           [](double degrees, bool quick, int) { return measure_tilt(degrees, false, quick); }},
          {"edge_on",
           Family::facing,
           "triangles that are nearly edge-on and still cover a sample",
           {"height on the screen", "px", true},
           kMisjudged,
           11,
           powers_of_two(3, -20),
           measure_edge_on}};
}

}  // namespace edgewise::lab
