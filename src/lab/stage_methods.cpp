#include "lab/stage_methods.h"

#include <algorithm>

#include "core/nearest_name.h"

namespace edgewise::lab {

namespace {

template <typename Method>
const Method* found_in(std::span<const Method> methods, std::string_view name) {
  const auto found =
      std::find_if(methods.begin(), methods.end(), [&](const Method& m) { return m.info.name == name; });
  return found == methods.end() ? nullptr : &*found;
}

template <typename Method>
const Method& find(std::span<const Method> methods, std::string_view kind, std::string_view name) {
  return find_named(kind, name, methods, [](const Method& method) { return method.info.name; });
}

}  // namespace

const ClippingMethod& find_clipping_method(std::string_view name) {
  return find(clipping_methods(), "clipping method", name);
}

const VisibilityMethod& find_visibility_method(std::string_view name) {
  return find(visibility_methods(), "visibility method", name);
}

const FacingMethod& find_facing_method(std::string_view name) {
  return find(facing_methods(), "facing test", name);
}

StageMethods our_choice(std::string_view backend) {
  return {&find_drawing_method(find_backend(backend).name)};
}

bool put(std::string_view method, StageMethods& choice) {
  const auto put_at = [&](auto methods, auto& stage) {
    const auto* const found = found_in(methods, method);
    if (found != nullptr) stage = found;
    return found != nullptr;
  };
  return put_at(drawing_methods(), choice.coverage) || put_at(clipping_methods(), choice.clipping) ||
         put_at(visibility_methods(), choice.visibility) || put_at(facing_methods(), choice.facing);
}

Drawn drawable_part(const StageMethods& choice, bool stream) {
  if (stream) {
    const StageMethods only_coverage{choice.coverage};
    if (choice == only_coverage) return {choice, {}};
    return {only_coverage, "a stream has no camera: clipping, visibility and facing stay ours"};
  }
  if (choice.our_visibility() || (choice.our_coverage() && choice.fills())) return {choice, {}};
  Drawn drawn{choice, std::string(choice.visibility->info.name) + " covers exactly by itself: no " +
                          std::string(choice.coverage->info.name)};
  drawn.choice.coverage = our_choice(backends().front().name).coverage;
  return drawn;
}

std::string describe(const StageMethods& choice) {
  std::string names;
  const auto add = [&](bool shown, const MethodInfo& info) {
    if (!shown) return;
    if (!names.empty()) names += " + ";
    names += info.name;
  };
  add(!choice.our_facing(), choice.facing->info);
  add(!choice.our_clipping(), choice.clipping->info);
  add(!choice.our_coverage() || choice.ours(), choice.coverage->info);
  add(!choice.our_visibility(), choice.visibility->info);
  return names;
}

}  // namespace edgewise::lab
