// Sessions on small scenes, without files.
#pragma once

#include <algorithm>
#include <string_view>
#include <utility>

#include "edgewise/builtin.h"
#include "viewer/session.h"

namespace edgewise::viewer {

inline constexpr tools::Size kTestSize{240, 160};

// A box to the right of the line of sight: its left side is visible, although the z of that side's normal is
// 0.
inline Scene box_aside() {
  Scene scene = std::get<Scene>(find_scene("cube").make({}));
  scene.instances[0] = {.scale = glm::vec3(0.5f), .translation = {2.0f, 0.0f, -4.0f}};
  scene.camera = {};
  return scene;
}

inline Start start_with(Drawable drawable, Cull cull) {
  Start start;
  start.load = [drawable = std::move(drawable), cull](tools::Size) {
    tools::Shot shot{{"test", drawable, std::holds_alternative<TriangleStream>(drawable), nullptr}, {}};
    shot.frontend.cull = cull;
    shot.frontend.shade = !shot.source.stream;
    return shot;
  };
  return start;
}
inline Session session_of(Drawable drawable, Cull cull = Cull::back) {
  return Session(start_with(std::move(drawable), cull));
}
inline Session session_of(std::string_view scene) {
  const SceneInfo& info = find_scene(scene);
  return session_of(info.make({kTestSize.width, kTestSize.height, 0.0f, 1.0}),
                    info.stream ? Cull::none : Cull::back);
}

// Types keys as --keys takes them.
inline const Screen& type(Session& session, std::string_view keys, tools::Size size = kTestSize) {
  session.draw(size);
  session.type(parse_keys(keys));
  return session.draw(size);
}

// How many labels have these words.
inline auto labels(const Screen& screen, std::string_view words) {
  return std::count_if(screen.labels.begin(), screen.labels.end(),
                       [&](const Label& label) { return label.words == words; });
}

}  // namespace edgewise::viewer
