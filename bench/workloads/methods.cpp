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

}  // namespace

std::function<void()> MethodDraw::prepare(std::string& error) const {
  MethodScene& at = *scene;
  if (!at.scene) {
    at.scene = std::get<lab::CoverageScene>(at.info.make());
    at.canvas.emplace(at.scene->size.width, at.scene->size.height);
  }
  const lab::CoverageInput input = at.scene->input();
  if (execution.threads != kPlainest.threads || execution.target != kPlainest.target) {
    const auto [width, height] = at.scene->size;
    lab::Canvas plain(width, height), other(width, height);
    method->draw(input, plain, kPlainest);
    method->draw(input, other, execution);
    if (!lab::same_picture(*method, plain, other))
      error = "draws other pixels than its scalar form on one thread";
  }
  return [&at, of = method, input, how = execution] { of->draw(input, *at.canvas, how); };
}

std::vector<MethodDraw> method_draws(lab::LabScene info) {
  const auto scene = std::make_shared<MethodScene>(MethodScene{std::move(info)});
  std::vector<MethodDraw> draws;
  for (const lab::CoverageMethod& method : lab::coverage_methods())
    for (const Execution& form : forms_of(method)) draws.push_back({scene, &method, form});
  return draws;
}

}  // namespace edgewise::bench
