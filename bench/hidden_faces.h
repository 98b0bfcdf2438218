// What the tutorials' engines do that drop hidden faces before they project anything: a facing test of the
// laboratory's, face by face, and a scene of what it leaves.
#pragma once

#include <cstdint>
#include <vector>

#include "edgewise/scene.h"
#include "lab/facing.h"

namespace edgewise::bench {

class HiddenFaces {
 public:
  // `method` must ask of the view nothing but its direction, as normal_z does. Instances must not be flat.
  // Throws std::out_of_range for one that names a mesh the scene lacks.
  HiddenFaces(Scene scene, const lab::FacingMethod& method);

  // Judges each face of each instance once, by its first three vertices, on the calling thread. Two-sided
  // faces stay. What is left keeps its order; valid until the next call, which like this one allocates
  // nothing.
  const Drawable& drop();

 private:
  // In the mesh's own space, where nothing moves: it is the view that is turned into it.
  struct Faces {
    lab::FacingScene scene;
    std::vector<std::uint8_t> front;
  };
  void look_at(const Instance& instance, lab::FacingView& view) const;

  Scene all_;
  const lab::FacingMethod& method_;
  std::vector<Faces> faces_;  // one a mesh
  Drawable left_;             // a scene of one mesh an instance
};

}  // namespace edgewise::bench
