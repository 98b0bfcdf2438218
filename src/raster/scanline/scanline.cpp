// The backend `scanline`, the reference: walks a triangle's edges row by row and fills the spans between them
// in the frame itself, band by band (scanline_band-inl.h).
#include "raster/ablation.h"
#include "raster/bands.h"

namespace edgewise {

extern const std::string_view summary_scanline;
const std::string_view summary_scanline =
    "walks the edges row by row and fills the spans between them; the reference";
std::unique_ptr<Backend> make_scanline(const Ablation& ablation) {
  return std::make_unique<BandBackend>(scanline_kernel, ablation);
}
std::unique_ptr<Backend> make_scanline() {
  return make_scanline(Ablation{});
}

}  // namespace edgewise
