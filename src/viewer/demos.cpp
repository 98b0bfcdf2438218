#include "viewer/demos.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/nearest_name.h"
#include "edgewise/builtin.h"
#include "scene/cells.h"

namespace edgewise::viewer {

namespace {

Scene built_in(std::string_view name) {
  return std::get<Scene>(find_scene(name).make({}));
}

// Head on, from a little to the left and below: the face towards the eye is a square on the screen, and its
// diagonal runs through pixel centres, as the eye has moved along it.
Scene cube_head_on() {
  Scene scene = built_in("cube");
  scene.instances[0].angle = 0.0f;
  scene.camera = {};
  scene.camera.position = {-1.125f, -1.125f, 3.8125f};
  scene.camera.fov_y = 0.5f * std::numbers::pi_v<float>;
  return scene;
}

// Cubes and slabs around the eye: one in the middle of the view, one across each edge of the screen, and the
// one below reaches under the eye, through the near plane.
Scene around_the_eye() {
  Scene scene = built_in("cube");
  scene.camera = {};
  scene.to_light = {0.3f, 0.8f, 0.7f};
  scene.instances = {
      {.scale = glm::vec3(0.55f),
       .axis = {1.0f, 1.0f, 1.0f},
       .angle = 0.9f,
       .translation = {0.1f, 0.1f, -4.2f}},
      {.scale = glm::vec3(0.8f), .angle = 0.5f, .translation = {-2.7f, -0.1f, -2.8f}},
      {.scale = glm::vec3(0.8f), .angle = -0.4f, .translation = {2.8f, 0.0f, -3.0f}},
      {.scale = {1.2f, 0.25f, 0.5f}, .angle = 0.2f, .translation = {0.9f, 1.75f, -3.2f}},
      {.scale = {0.7f, 0.1f, 1.6f}, .angle = 0.1f, .translation = {0.0f, -0.9f, -1.2f}},
  };
  return scene;
}

// The sphere's cells as faces of four vertices.
Scene sphere_of_quads() {
  Scene scene = built_in("sphere");
  scene.camera.position = {0.0f, 0.9f, 3.2f};
  scene.camera.look_at({0.0f, 0.25f, 0.0f});
  join_cells(scene);
  return scene;
}

// Nine cubes around the eye, a slab under it, and two sheets before it that turn their backs on it: the left
// one has one side, the right one two.
Scene ring_of_cubes() {
  Scene scene = built_in("cube");
  scene.camera = {};
  scene.camera.position = {0.0f, 0.5f, 0.0f};
  scene.camera.pitch = -0.1f;
  scene.to_light = {0.3f, 0.8f, 0.7f};
  scene.instances.clear();
  constexpr int kCubes = 9;
  for (int i = 0; i < kCubes; ++i) {
    const float around =
        2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(kCubes);
    scene.instances.push_back({.scale = glm::vec3(0.9f),
                               .angle = 0.3f + around,
                               .translation = {5.0f * std::sin(around), 0.0f, -5.0f * std::cos(around)}});
  }
  // What is under the eye reaches through the near plane.
  scene.instances.push_back({.scale = {0.5f, 0.1f, 2.0f}, .translation = {0.0f, -0.6f, 0.0f}});
  for (const float x : {-0.9f, 0.9f}) {
    Mesh sheet{{{x - 0.3f, 0.3f, -2.6f},
                {x + 0.3f, 0.3f, -2.4f},
                {x + 0.3f, -0.4f, -2.4f},
                {x - 0.3f, -0.4f, -2.6f}},
               {},
               {}};
    sheet.add_quad({0, 3, 2, 1}, rgb(230, 230, 230), x > 0.0f);
    scene.instances.push_back({.mesh = scene.meshes.size()});
    scene.meshes.push_back(std::move(sheet));
  }
  return scene;
}

constexpr Step kCulling[] = {
    {"k<wireframe>r<2>",
     "Wireframe: all twelve triangles of the cube, those behind as well as those in front."},
    {"2<2>",
     "[2] Back faces culled: only those survive whose vertices turn clockwise on the screen, where y points "
     "down."},
    {"21<2>", "[1] Front faces culled instead: what is left are the far walls from inside, a diorama."},
    {"<tiled><2>", "[y] Filled: the cube is open towards you, and can be looked into."},
    {"v<tab>2<wireframe><1>r",
     "Culled by winding on the screen alone. Left: front faces culled, a diorama. Right: back faces culled, "
     "and the edges of the faces that survive. [1] and [2] switch each, [tab] changes sides."},
};

constexpr Step kInsideTest[] = {
    {"ok<float_le><2>",
     "Each pixel of the bounding box is tested: inside, or on an edge (<= 0). Pixels on a shared edge are "
     "drawn "
     "twice: the double hits."},
    {"<float_lt><2>",
     "Strictly inside (< 0): nobody draws the pixels on a shared edge, and they stay black. Gaps are "
     "counted."},
    {"v<tab>2<submission_order><2>",
     "Right: no culling and no depth. What is submitted last wins, so faces behind hide those in front."},
    {"2<2>", "Right: [2] back faces culled, the cure for one convex object."},
    {"2<contract31><2>", "Right: [z] a depth buffer, the cure for all; nothing is culled."},
    {"<submission_order><tab><enter><enter><enter><enter><enter><enter><enter><enter><enter><enter><enter><"
     "2>",
     "Left: a strict inside test (< 0) leaves gaps along shared edges; they are counted. Right: both "
     "cullings "
     "off and no depth, so that the last face wins. Culling [2] or depth [z] cures it."},
};

constexpr Step kClipping[] = {
    {"<screen_edges><painter_mean><2>",
     "Triangles are cut by the near plane, then by the four edges of the screen, and painted back to "
     "front by their mean distance."},
    {"6<2>", "[6] Outlines: white ones were cut into several triangles."},
    {"t<1>", "[t] The numbers of the vertices."},
    {"wwwww<1>sssss<1>", "[w] Through the near plane, and back: nothing tears."},
    {"m<space><space><space>dddaaa<shift><shift><shift><1>",
     "[m] Now along the world's axes: space and shift move straight up and down."},
    {"r<1.5>r", "[r] All turn about one axis, (1, 1, 1)."},
    {"0<1>",
     "Cut by the near plane and by the four edges of the screen (white: in several pieces), painted back to "
     "front. A face turned away from the light keeps 0.15 of its colour. [w a s d], space, shift and "
     "dragging "
     "move the eye, [m] along the view or the world; [t] numbers the vertices."},
};

constexpr Step kBackface[] = {
    {"<normal_dot_eye><2>",
     "A face is kept if its normal in the world and the ray from the eye to it point against each other; "
     "that "
     "needs no projection. Objects outside the view as a whole are not looked at any further."},
    {"2<2>",
     "[2] With back faces drawn as well a second sheet shows, on the left, which turns its back on the eye. "
     "The "
     "one on the right is two-sided, and never culled for its facing."},
    {"27<2>",
     "[7] What became of each face: a letter at its centre, if that is on the screen, and in the list, a "
     "word for "
     "each object. Capitals are two-sided."},
    {"<left><2>",
     "Back faces are culled by world-space normal times the ray from the eye; the grey sheet turns its back, "
     "but is two-sided. Objects outside the view are culled whole, and what reaches out of it is clipped: "
     "[7] lists each face."},
};

constexpr Step kTriad[] = {
    {"<normal_z>k<2>",
     "A face of four vertices is kept if the z of its normal, turned with the object, points to the eye."},
    {"r<2>r", "[r] Half of the faces of a closed object are hidden at any time, whichever half it is."},
    {"0kv<tab>2<2>",
     "Left: hidden faces removed so, before they are projected, lit or drawn. Right: the same picture with "
     "all "
     "of them. In the window both times are shown, and how much longer the right side takes."},
    {"<wireframe><tab><wireframe>wwwwwwwwwwwwww<1>",
     "From close by, left: the edges of the triangles that are left (a face of four vertices is two) when "
     "faces "
     "are removed whose normal's z points away. Right: of all, the far side too. In the window both times "
     "are "
     "shown, and how much longer the right side takes."},
};

constexpr std::array kDemos{
    Demo{"pico8-culling", "Pico-8 software renderer, culling", "front and back faces, culled one by one",
         [] { return built_in("cube"); }, Cull::none, kCulling},
    Demo{"pico8-inside-test", "Pico-8 software renderer, inside test",
         "what a strict inside test leaves out, and order without depth", cube_head_on, Cull::back,
         kInsideTest},
    Demo{"p5js-clipping", "p5.js engine, clipping",
         "a walk through near plane and screen edges, painted back to front", around_the_eye, Cull::back,
         kClipping, glm::vec3(1.0f)},
    Demo{"realbasic-backface", "REALbasic engine, backface removal",
         "faces and whole objects that need no drawing, and faces with two sides", ring_of_cubes, Cull::back,
         kBackface},
    Demo{"outlaw-triad", "Outlaw Triad trainer, hidden face removal",
         "faces of four vertices, and what it gains to drop the hidden half", sphere_of_quads, Cull::back,
         kTriad},
};

}  // namespace

std::span<const Demo> demos() {
  return kDemos;
}

const Demo& find_demo(std::string_view name) {
  return find_named("tutorial", name, demos(), &Demo::name);
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
