#include "viewer/demos.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "edgewise/builtin.h"
#include "nearest_name.h"

namespace edgewise::viewer {

namespace {

Scene built_in(std::string_view name) {
  return std::get<Scene>(find_scene(name).make({}));
}

// Head on from a little to the right and above: the face towards the eye is a square on the screen, and its
// diagonal runs through pixel centres, since the eye has moved along it.
Scene cube_head_on() {
  Scene scene = built_in("cube");
  scene.instances[0].angle = 0.0f;
  scene.camera = {};
  scene.camera.position = {1.5f, 1.5f, 4.0f};
  scene.camera.fov_y = 0.5f * std::numbers::pi_v<float>;
  return scene;
}

constexpr Step kCulling[] = {
    {"r<2>", "Wireframe: all twelve triangles of the cube."},
};

constexpr Step kInsideTest[] = {
    {"<float_lt>e", "float_lt"},
};

constexpr Step kClipping[] = {
    {"<screen_edges><painter_mean>", "p5"},
};

constexpr Step kBackface[] = {
    {"<normal_dot_eye>", "rb"},
};

constexpr Step kTriad[] = {
    {"<normal_z>", "triad"},
};

constexpr std::array kDemos{
    Demo{"pico8-culling", "Pico-8 software renderer, culling", "front and back faces, culled one by one",
         [] { return built_in("cube"); }, Cull::none, kCulling},
    Demo{"pico8-inside-test", "Pico-8 software renderer, inside test",
         "what a strict inside test leaves out, and order without depth", cube_head_on, Cull::back,
         kInsideTest},
    Demo{"p5js-clipping", "p5.js engine, clipping",
         "a walk through near plane and screen edges, painted back to front",
         [] { return built_in("cubes"); }, Cull::back, kClipping},
    Demo{"realbasic-backface", "REALbasic engine, backface removal",
         "faces and whole objects that need no drawing, each with its state",
         [] { return built_in("cubes"); }, Cull::back, kBackface},
    Demo{"outlaw-triad", "Outlaw Triad trainer, hidden face removal",
         "faces of four vertices, and what it gains to drop the hidden half",
         [] { return built_in("sphere"); }, Cull::back, kTriad},
};

}  // namespace

std::span<const Demo> demos() {
  return kDemos;
}

const Demo& find_demo(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Demo& demo : demos()) {
    if (demo.name == name) return demo;
    known.push_back(demo.name);
  }
  throw std::invalid_argument(unknown_name("tutorial", name, known));
}

Start start_of(const Demo& demo) {
  Start start;
  start.load = [&demo](app::Size) {
    app::Shot shot{{std::string(demo.name), demo.scene(), false}, {}};
    shot.frontend.cull = demo.cull;
    return shot;
  };
  start.axis = demo.axis;
  start.folder = ".";
  start.steps = demo.steps;
  return start;
}

}  // namespace edgewise::viewer
