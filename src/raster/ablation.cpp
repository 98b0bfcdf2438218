#include "edgewise/ablation.h"

namespace edgewise {

std::string describe(const Ablation& ideas) {
  std::string text;
  const auto add = [&](bool so, const char* what) {
    if (so) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  add(!ideas.vector_setup, "no vector set-up");
  add(!ideas.prefetch, "no prefetch");
  add(!ideas.patches, "no patches");
  add(!ideas.hierarchical_depth, "no hierarchical depth");
  add(ideas.write_out == WriteOut::through_caches, "written through the caches");
  add(ideas.write_out == WriteOut::past_caches, "written past the caches");
  return text;
}

}  // namespace edgewise
