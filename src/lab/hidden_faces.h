// What the tutorials' engines do that drop hidden faces before they project anything: a facing test of the
// laboratory's, face by face, and a scene of what it leaves.
#pragma once

#include <cstdint>
#include <vector>

#include "edgewise/scene.h"
#include "lab/facing/facing.h"

namespace edgewise::lab {

class HiddenFaces {
 public:
  // Throws std::invalid_argument for a method that asks more of the view than its direction, and
  // std::out_of_range for an instance that names a mesh the scene lacks.
  HiddenFaces(const Scene& scene, const FacingMethod& method);

  // Of the same scene; its camera and its instances may have moved since. Judges each face of each instance
  // once, by its first three vertices, on the calling thread. Instances must not be flat. Two-sided faces
  // stay. What is left keeps its order; valid until the next call, which like this one allocates nothing.
  const Drawable& drop(const Scene& scene);
  const FacingMethod& method() const { return *method_; }

 private:
  // In the mesh's own space, where nothing moves: it is the view that is turned into it.
  struct Faces {
    FacingScene scene;
    std::vector<std::uint8_t> front;
  };
  const FacingMethod* method_;
  std::vector<Faces> faces_;  // one a mesh
  Drawable left_;             // a scene of one mesh an instance
};

}  // namespace edgewise::lab
