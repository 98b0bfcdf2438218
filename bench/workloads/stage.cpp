#include "bench/workloads/stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <numeric>

#include "lab/cases/backend_comparison.h"
#include "lab/engine/engine.h"

namespace edgewise::bench {

namespace {

std::uint64_t pixels_of_another_colour(const Framebuffer& a, const Framebuffer& b) {
  const auto one = lab::payloads_of(a), other = lab::payloads_of(b);
  return std::transform_reduce(one.begin(), one.end(), other.begin(), std::uint64_t{0}, std::plus<>(),
                               std::not_equal_to<>());
}

}  // namespace

bool Stage::renew_memory(const Row& row) {
  if (!row.arithmetic) return false;
  engines_.clear();
  return true;
}

Framebuffer& Stage::frame(const Row& row) {
  const int width = row.workload->width(), height = row.workload->height();
  return frames_.try_emplace({width, height}, width, height).first->second;
}

Backend& Stage::backend(const Row& row) {
  if (!row.arithmetic) return backends_.get(*row.backend, {});
  auto& engine = engines_[*row.arithmetic];
  if (!engine) engine = lab::make_engine(*row.arithmetic);
  return *engine;
}

void Stage::work(const Row& row) {
  if (!row.workload) return draws_.at(row.name)();
  if (row.peer != nullptr) return peers_.work(row);
  Workload& workload = *row.workload;
  if (row.timed == Timed::frame && !row.arithmetic)
    return workload.draw(frontend_, backend(row), frame(row).view(), row.execution);
  auto triangles = workload.triangles();
  if (row.timed != Timed::raster) triangles = workload.run(frontend_, row.execution);
  if (row.timed != Timed::frontend)
    backend(row).draw(triangles, frame(row).view(), {kBackground}, row.execution);
}

double Stage::timed_work_s(const Row& row) {
  const auto begin = std::chrono::steady_clock::now();
  work(row);
  return row.device_clock ? peers_.device_s(row)
                          : std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void Stage::compare_ours(Row& row) {
  // The frame still holds the previous row's picture, which may be the same.
  if (row.timed != Timed::frontend) lab::poison(frame(row));
  row.once_s = timed_work_s(row);
  if (row.timed == Timed::frontend) {
    const auto expected = row.workload->triangles();
    const auto actual = row.workload->run(frontend_, row.execution);
    if (actual.size() != expected.size() ||
        std::memcmp(actual.data(), expected.data(), expected.size_bytes()) != 0)
      row.error = fmt::format("emits other triangles than on 1 thread ({} instead of {})", actual.size(),
                              expected.size());
  } else if (row.arithmetic.value_or(lab::EngineArithmetic::exact) != lab::EngineArithmetic::exact) {
    row.wrong_px = pixels_of_another_colour(row.workload->reference(), frame(row));
  } else {
    const auto difference = lab::compare(row.workload->reference(), frame(row));
    if (difference.pixels != 0)
      row.error =
          fmt::format("{} pixels differ from {} on 1 thread, the first at ({}, {})", difference.pixels,
                      backends().front().name, difference.first_x, difference.first_y);
  }
}

void Stage::compare(Row& row) {
  if (!row.workload) {
    draws_[row.name] = row.prepare(row);
    row.once_s = timed_work_s(row);
  } else if (row.peer != nullptr) {
    peers_.compare(row);
    row.once_s = timed_work_s(row);
  } else {
    compare_ours(row);
  }
  // The first draw also allocates memory. Later draws time the row, and short rows are drawn more often.
  for (const double limit_s : {kTooSlowToDrawTwice_s, 0.1, 0.1})
    if (row.once_s < limit_s) row.once_s = std::min(row.once_s, timed_work_s(row));
}

}  // namespace edgewise::bench
