#include "viewer/demos.h"

#include <array>
#include <numbers>
#include <string>

#include "core/nearest_name.h"
#include "core/trigonometry.h"
#include "edgewise/builtin.h"
#include "scene/polygon.h"

namespace edgewise::viewer {

namespace {

Scene built_in(std::string_view name) {
  return std::get<Scene>(find_scene(name).make({}));
}

// A cube seen head on, from a little to the left and below: its front face is a square on the screen, and the
// camera is placed so that the face's diagonal runs through pixel centres.
Scene cube_head_on() {
  Scene scene = built_in("cube");
  scene.instances[0].angle = 0.0f;
  scene.camera = {};
  scene.camera.position = {-1.125f, -1.125f, 3.8125f};
  scene.camera.fov_y = 0.5f * std::numbers::pi_v<float>;
  return scene;
}

// Cubes and slabs around the camera: one in the middle of the view and one across each screen edge; the
// lowest one reaches below the camera, through the near plane.
Scene around_the_camera() {
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

// Nine cubes around the camera, a slab below it, and two sheets in front of it that face away: the left sheet
// is one-sided, the right one two-sided.
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
                               .translation = {5.0f * sine(around), 0.0f, -5.0f * cosine(around)}});
  }
  // The slab below the camera reaches through the near plane.
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
    {"k<wireframe>r<2>", "Wireframe: the edges of all twelve triangles of the cube, front and back."},
    {"2<2>", "[2] culls back faces: the vertices of the others go clockwise on the screen."},
    {"21<2>", "[1] culls front faces instead: the far walls are left, as in a diorama."},
    {"<tiled><2>", "[y] fills the triangles: the cube is open towards the camera."},
    {"v<tab>2<wireframe><1>r", "Left, front faces are culled; right, back faces, and only edges are drawn."},
};

constexpr Step kInsideTest[] = {
    {"k<float_le><2>", "Inside test <= 0: both triangles draw their shared edge (double hits)."},
    {"<float_lt><2>", "Inside test < 0: neither triangle draws their shared edge (gaps)."},
    {"v<tab>2<submission_order><2>", "Right, without culling and depth test, the last submitted face wins."},
    {"2<2>", "Right, [2] culls back faces, which suffices for one convex object."},
    {"2<contract31><2>", "Right, [z] a depth buffer suffices for any scene, without culling."},
    {"<submission_order><tab><enter><enter><enter><enter><enter><enter><enter><enter><enter><enter><enter><"
     "2>",
     "Left, the magnifier shows a gap; right, the last face wins at any depth."},
};

constexpr Step kClipping[] = {
    {"<screen_edges><painter_mean><2>",
     "Triangles are clipped at near plane and screen edges, then sorted by depth."},
    {"6<2>", "[6] Outlines: clipping cut the white triangles into several pieces."},
    {"t<1>", "[t] Each vertex shows its number."},
    {"wwwww<1>sssss<1>", "[w] moves forwards, until objects cross the near plane, and [s] back."},
    {"m<space><space><space>dddaaa<shift><shift><shift><1>",
     "[m] moves along the world's axes: space and shift go straight up and down."},
    {"r<1.5>r", "[r] rotates all objects about one axis, (1, 1, 1)."},
    {"0<1>", "[0] resets the view; faces turned from the light keep 0.15 of their colour."},
};

constexpr Step kBackface[] = {
    {"<normal_dot_eye><2>", "A face is kept if its normal's dot product with the view ray is negative."},
    {"2<2>", "[2] draws back faces too: on the left, a sheet that faces away appears."},
    {"27<2>", "[7] shows each face's state as a letter, a capital if the face is two-sided."},
    {"<left><2>", "Objects out of view are culled whole; the sheet stays, as it is two-sided."},
};

constexpr Step kTriad[] = {
    {"<normal_z>k<2>", "A quad is kept if the z of its rotated normal points towards the camera."},
    {"r<2>r", "[r] rotates: about half of a closed object's faces face away at any time."},
    {"0kv<tab>2<2>", "Left drops these faces; right does not: equal pictures."},
    {"<wireframe><tab><wireframe>wwwwwwwwwwwwww<1>",
     "Left, edges of the triangles kept, two per quad; right, of all triangles."},
};

constexpr std::array kDemos{
    Demo{"pico8-culling", "Pico-8 software renderer, culling",
         "front-face and back-face culling, switched separately", [] { return built_in("cube"); }, Cull::none,
         kCulling},
    Demo{"pico8-inside-test", "Pico-8 software renderer, inside test",
         "gaps of a strict inside test, and faces drawn without a depth test", cube_head_on, Cull::back,
         kInsideTest},
    Demo{"p5js-clipping", "p5.js engine, clipping",
         "clipping at the near plane and the screen edges, painted back to front", around_the_camera,
         Cull::back, kClipping, glm::vec3(1.0f)},
    Demo{"realbasic-backface", "REALbasic engine, backface removal",
         "culling of faces and of whole objects, and two-sided faces", ring_of_cubes, Cull::back, kBackface},
    Demo{"outlaw-triad", "Outlaw Triad trainer, hidden face removal",
         "a test of quads' normals, which drops half of them", sphere_of_quads, Cull::back, kTriad},
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
  start.load = [&demo](tools::Size) {
    tools::Shot shot{{std::string(demo.name), demo.scene(), false}, {}};
    shot.frontend.cull = demo.cull;
    return shot;
  };
  start.axis = demo.axis;
  start.folder = ".";
  start.steps = demo.steps;
  return start;
}

}  // namespace edgewise::viewer
