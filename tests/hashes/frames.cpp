#include "hashes/frames.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>

#include "conformance/streams.h"
#include "edgewise/builtin.h"
#include "lab/cases/random_cases.h"

namespace edgewise::hashes {

namespace {

constexpr int kFrames = 48;  // of a group
constexpr int kCulls = 3;    // a scene at one time is drawn culling nothing, back faces, front faces
constexpr std::array<std::pair<int, int>, 3> kSizes{{{61, 37}, {127, 71}, {331, 187}}};  // px
constexpr int kRandomGroups = 160;
constexpr std::array kOtherBits{4, 12, 15};  // subpixel bits; 8 otherwise
constexpr int kOneIn = 10;                   // frames has a twin with other subpixel bits
constexpr std::uint64_t kSeed = 47;

struct BuiltIn {
  std::string_view name;
  int groups;    // for each size
  double scale;  // 0: not scalable. A stream does not move: its scale grows, by this much in each step
};
constexpr std::array kBuiltIns = {
    BuiltIn{"cube", 4, 0},       BuiltIn{"cubes", 4, 0},      BuiltIn{"sphere", 2, 0},
    BuiltIn{"torus-knot", 2, 0}, BuiltIn{"terrain", 1, 0},    BuiltIn{"knots", 1, 0.1},
    BuiltIn{"large", 1, 0.01},   BuiltIn{"medium", 1, 0.001}, BuiltIn{"small", 1, 0.0005},
    BuiltIn{"micro", 1, 0.0005}, BuiltIn{"sliver", 1, 0.001}, BuiltIn{"grid4", 1, 0.05},
    BuiltIn{"grid64", 1, 1},     BuiltIn{"quads", 1, 0.1},
};

template <typename... Values>
std::string text(const char* format, Values... values) {
  char line[200];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

Frame frame_of(std::shared_ptr<const Drawable> drawable, int width, int height, int i) {
  Frame frame{.width = width, .height = height, .drawable = std::move(drawable)};
  frame.frontend.width = width;
  frame.frontend.height = height;
  frame.frontend.cull = cull_modes()[static_cast<std::size_t>(i % kCulls)];
  frame.frontend.shade = std::holds_alternative<Scene>(*frame.drawable);
  frame.frontend.payload = i / kCulls % 2 == 0 ? Payload::colour : Payload::id;
  return frame;
}

// Makes each drawable once, for all culling modes.
Group group_of(std::string name, int width, int height, std::function<Drawable(int)> make) {
  return {std::move(name), kFrames, [=, made = std::shared_ptr<const Drawable>(), step = -1](int i) mutable {
            if (step != i / kCulls) made = std::make_shared<const Drawable>(make(step = i / kCulls));
            return frame_of(made, width, height, i);
          }};
}

SceneRequest request_of(const BuiltIn& scene, int width, int height, int step) {
  const bool grows = find_scene(scene.name).stream;
  return {width, height, grows ? 0.0f : 0.625f * static_cast<float>(step),
          scene.scale == 0 ? 1.0 : scene.scale * (grows ? step + 1 : 1)};
}

Group built_in(const BuiltIn& scene, int width, int height, int part) {
  const int first = part * kFrames / kCulls;
  return group_of(text("%s %dx%d %d", scene.name.data(), width, height, part), width, height, [=](int step) {
    return find_scene(scene.name).make(request_of(scene, width, height, first + step));
  });
}

Group with_files(const char* prefix, const FileFormat& format, Group group) {
  group.name = prefix + (" " + group.name);
  group.frame = [frame = group.frame, file = &format](int i) {
    Frame made = frame(i);
    made.file = file;
    return made;
  };
  return group;
}

Group at_bits(int bits, Group group) {
  group.name += text(" at %d bits", bits);
  group.frames = (group.frames + kOneIn - 1) / kOneIn;
  group.frame = [bits, frame = group.frame](int i) {
    Frame made = frame(i * kOneIn);
    made.frontend.subpixel_bits = bits;
    return made;
  };
  return group;
}

// Far from the origin: until doubles are too coarse to hold the scene.
void far_away(Scene& scene, int step) {
  const glm::dvec3 by = std::ldexp(1.0, 3 * step) * glm::dvec3(1.0, -0.75, 0.5);
  scene.camera.position += by;
  for (Instance& instance : scene.instances) instance.translation += by;
}

// A narrow view, until triangles reach beyond the guard band.
void narrow(Scene& scene, int step) {
  scene.camera.fov_y = std::ldexp(1.0f, -step);
}

// The near and the far plane cut the scene.
void sliced(Scene& scene, int step) {
  scene.camera.near_z = 2.0f + 0.25f * static_cast<float>(step);
  scene.camera.far_z = scene.camera.near_z + 0.75f;
}

// With every culling mode, and as .tri files.
Group streams(std::string name, std::vector<TriangleStream> all) {
  const std::size_t modes = cull_modes().size();
  return with_files("tri", kTri, {std::move(name), static_cast<int>(all.size() * modes), [=](int i) {
                                    const auto n = static_cast<std::size_t>(i);
                                    const TriangleStream& stream = all[n / modes];
                                    Frame frame = frame_of(std::make_shared<const Drawable>(stream),
                                                           stream.width, stream.height, 0);
                                    frame.frontend.cull = cull_modes()[n % modes];
                                    frame.frontend.payload = Payload::id;
                                    return frame;
                                  }});
}

void add_conformance_streams(std::vector<Group>& all) {
  using namespace conformance;
  std::vector<TriangleStream> walls{wall(0.0f), wall(-0.0f), wall(1.0f)}, slopes, lists, tiny, anywhere_at;
  for (const float z : kBeyondNearAndFar) walls.push_back(wall(z));
  for (const float start : kSlopeStarts)
    for (const bool falls : {false, true}) slopes.push_back(slope(start, falls));
  Random random(kSeed);
  for (int i = 0; i < 4; ++i) {
    lists.push_back(scattered(random));
    lists.push_back(reversed(lists.back()));
  }
  for (const TinyShape& shape : kTinyShapes) tiny.push_back(tiny_triangles(shape));
  for (int i = 0; i < kFrames; ++i) anywhere_at.push_back(stream_of(anywhere(random)));
  all.push_back(streams("walls", walls));
  all.push_back(streams("slopes", slopes));
  all.push_back(streams("lists", lists));
  all.push_back(streams("tiny triangles", tiny));
  all.push_back(streams("clipped anywhere", anywhere_at));
  for (const Plane& plane : kPlanes) {
    std::vector<TriangleStream> cut;
    for (int i = 0; i < kFrames / 2; ++i) cut.push_back(stream_of(exactly_cut(plane, 1 + i % 2, random)));
    all.push_back(streams(text("clipped %s", plane.name), cut));
  }
}

Frame random_frame(std::uint64_t number, int bits) {
  randomized::Case c = randomized::make_case(kSeed, number, bits);
  Frame frame{c.width, c.height, c.background, std::move(c.triangles), nullptr, c.frontend};
  if (c.drawable) frame.drawable = std::make_shared<const Drawable>(std::move(*c.drawable));
  return frame;
}

}  // namespace

std::vector<Group> groups() {
  std::vector<Group> all;
  for (const BuiltIn& scene : kBuiltIns)
    for (const auto& [width, height] : kSizes)
      for (int part = 0; part < scene.groups; ++part) all.push_back(built_in(scene, width, height, part));

  const std::array<std::pair<const char*, void (*)(Scene&, int)>, 3> kViews{
      {{"far", far_away}, {"narrow", narrow}, {"sliced", sliced}}};
  for (const auto& [view, change] : kViews)
    for (const std::string name : {"cube", "cubes", "torus-knot"})
      all.push_back(group_of(view + (" " + name), 127, 71, [=, move = change](int step) {
        Drawable drawable = find_scene(name).make({.time = 0.25f});
        move(std::get<Scene>(drawable), step);
        return drawable;
      }));

  using namespace conformance;
  for (const double corner : {0.0, 0.5})
    all.push_back(
        {text("fill rules %g", corner), static_cast<int>(kDirections.size() * kSplits.size()), [=](int i) {
           const auto n = static_cast<std::size_t>(i);
           const Split& split = kSplits[n % kSplits.size()];
           const Quad quad = on_lattice(kDirections[n / kSplits.size()], corner);
           Frame frame =
               frame_of(std::make_shared<const Drawable>(stream_of(quad, {split.a, split.b})), 64, 64, 0);
           frame.frontend.payload = Payload::id;
           return frame;
         }});

  for (std::size_t i = 0, end = all.size(); i < end; ++i)
    all.push_back(at_bits(kOtherBits[i % kOtherBits.size()], all[i]));

  const auto add_random = [&](int bits, int groups) {
    for (int part = 0; part < groups; ++part)
      all.push_back(
          {text("random %d", part) + (bits == 8 ? "" : text(" at %d bits", bits)), kFrames,
           [=](int i) { return random_frame(static_cast<std::uint64_t>(part * kFrames + i), bits); }});
  };
  add_random(8, kRandomGroups);
  for (const int bits : kOtherBits) add_random(bits, kRandomGroups / 30);

  const auto [width, height] = kSizes[0];
  all.push_back(with_files("ppm", kPpm, built_in({"cubes", 1, 0}, width, height, 0)));
  all.push_back(with_files("pfm", kPfm, built_in({"cubes", 1, 0}, width, height, 0)));
  add_conformance_streams(all);
  return all;
}

}  // namespace edgewise::hashes
