#include "bench/workloads/methods.h"

namespace edgewise::bench {

namespace {

constexpr Execution kPlainest{.threads = 1, .target = SimdTarget::scalar};

std::vector<Execution> forms_of(const lab::CoverageMethod& method) {
  const SimdTarget best = resolve(SimdTarget::best);
  std::vector<SimdTarget> targets{SimdTarget::scalar};
  if (method.simd && best != SimdTarget::scalar) targets.push_back(best);
  std::vector<Execution> list;
  for (const SimdTarget target : targets)
    for (int threads = 1; threads <= (method.threaded ? 2 : 1); ++threads)
      list.push_back({.threads = threads, .target = target});
  return list;
}

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;  // clang 14 needs it

}  // namespace

void MethodScene::load() {
  if (scene_) return;
  scene_ = info_.make();
  if (info_.family == lab::Family::coverage) canvas.emplace(size().width, size().height);
  if (info_.family == lab::Family::clipping) clipped.emplace(size());
  front.resize(triangles());
}

lab::Size MethodScene::size() const {
  return std::visit(
      Overloaded{[](const lab::VisibilityScene& s) {
                   return lab::Size{s.width, s.height};
                 },
                 [](const lab::FacingScene& s) { return s.view.size; }, [](const auto& s) { return s.size; }},
      *scene_);
}

std::size_t MethodScene::triangles() const {
  return std::visit(Overloaded{[](const lab::CoverageScene& s) { return s.floats.size(); },
                               [](const lab::VisibilityScene& s) { return s.triangles.size(); },
                               [](const lab::FacingScene& s) { return s.faces.size(); },
                               [](const lab::ClippingScene& s) { return s.mesh().triangles.size(); },
                               [](const lab::ProjectionScene&) { return std::size_t{0}; }},
                    *scene_);
}

std::string_view MethodDraw::name() const {
  return std::visit([](const auto* of) { return of->info.name; }, method);
}

std::function<void()> MethodDraw::prepare(std::string& error) const {
  scene->load();
  MethodScene& at = *scene;
  const auto coverage = [&](const lab::CoverageMethod* of) -> std::function<void()> {
    const lab::CoverageInput input = std::get<lab::CoverageScene>(at.scene()).input();
    if (execution.threads != kPlainest.threads || execution.target != kPlainest.target) {
      lab::Canvas plain(at.size().width, at.size().height), other(at.size().width, at.size().height);
      of->draw(input, plain, kPlainest);
      of->draw(input, other, execution);
      if (!lab::same_picture(*of, plain, other))
        error = "draws other pixels than its scalar form on one thread";
    }
    return [&at, of, input, how = execution] { of->draw(input, *at.canvas, how); };
  };
  return std::visit(
      Overloaded{coverage,
                 [&](const lab::VisibilityMethod* of) -> std::function<void()> {
                   return [&at, of] { of->draw(std::get<lab::VisibilityScene>(at.scene()), at.visible); };
                 },
                 [&](const lab::FacingMethod* of) -> std::function<void()> {
                   return [&at, of] { of->classify(std::get<lab::FacingScene>(at.scene()), at.front); };
                 },
                 [&](const lab::ClippingMethod* of) -> std::function<void()> {
                   return [&at, of] { of->draw(std::get<lab::ClippingScene>(at.scene()), *at.clipped); };
                 }},
      method);
}

std::vector<MethodDraw> method_draws(lab::LabScene info) {
  const auto scene = std::make_shared<MethodScene>(std::move(info));
  std::vector<MethodDraw> draws;
  const auto add_all = [&](const auto& methods) {
    for (const auto& method : methods) draws.push_back({scene, &method, kPlainest});
  };
  switch (scene->info().family) {
    case lab::Family::coverage:
      for (const lab::CoverageMethod& method : lab::coverage_methods())
        for (const Execution& form : forms_of(method)) draws.push_back({scene, &method, form});
      break;
    case lab::Family::visibility:
      add_all(lab::visibility_methods());
      break;
    case lab::Family::facing:
      add_all(lab::facing_methods());
      break;
    case lab::Family::clipping:
      add_all(lab::clipping_methods());
      break;
    case lab::Family::projection:  // references, not optimized
      break;
  }
  return draws;
}

}  // namespace edgewise::bench
