#include "lab/engine/engine.h"

#include "raster/traversals.h"

namespace edgewise::lab {

std::unique_ptr<Backend> make_engine(EngineArithmetic arithmetic) {
  return tile_backend([arithmetic](SimdTarget target) { return engine_kernel(arithmetic, target); },
                      {.coverage_masks = false});
}

}  // namespace edgewise::lab
