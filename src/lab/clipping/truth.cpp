#include "lab/clipping/truth.h"

#include <algorithm>
#include <numeric>

#include "core/parallel.h"
#include "frontend/view.h"

namespace edgewise::lab {

namespace {

constexpr int kTile = 4;  // px

}  // namespace

ClippingOracle::ClippingOracle(const Scene& scene, Size size, Cull cull)
    : truth_(scene, size, cull), tiles_x_((size.width + kTile - 1) / kTile) {
  const int tiles_y = (size.height + kTile - 1) / kTile;
  in_tile_.resize(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y));
  std::vector<std::uint32_t> all(truth_.size());
  std::iota(all.begin(), all.end(), 0u);
  std::erase_if(all, [&](std::uint32_t i) { return truth_.facing(i) == 0; });
  int tiles = 1;
  while (tiles < std::max(tiles_x_, tiles_y)) tiles *= 2;
  sort_into_tiles(0, 0, tiles, all);
}

void ClippingOracle::sort_into_tiles(int tile_x, int tile_y, int tiles,
                                     std::span<const std::uint32_t> candidates) {
  const int tiles_y = static_cast<int>(in_tile_.size()) / tiles_x_;
  if (tile_x >= tiles_x_ || tile_y >= tiles_y) return;
  const Box box{double{kTile} * tile_x, double{kTile} * tile_y, double{kTile} * (tile_x + tiles),
                double{kTile} * (tile_y + tiles)};
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t i : candidates)
    if (!truth_.misses(i, box)) kept.push_back(i);
  if (tiles == 1) {
    in_tile_[static_cast<std::size_t>(tile_y * tiles_x_ + tile_x)] = std::move(kept);
    return;
  }
  const int half = tiles / 2;
  for (const int right : {0, half})
    for (const int below : {0, half}) sort_into_tiles(tile_x + right, tile_y + below, half, kept);
}

std::uint32_t ClippingOracle::visible_at(double x_px, double y_px) const {
  const auto tile =
      static_cast<std::size_t>(static_cast<int>(y_px) / kTile * tiles_x_ + static_cast<int>(x_px) / kTile);
  std::uint32_t visible_id = kNoTriangle;
  for (const std::uint32_t i : in_tile_[tile])
    if (covers(i, x_px, y_px) && (visible_id == kNoTriangle || truth_.nearer(i, visible_id, x_px, y_px)))
      visible_id = i;
  return visible_id;
}

bool ClippingOracle::shows(std::uint32_t triangle, std::uint32_t other, double x_px, double y_px) const {
  if (triangle != kNoTriangle && !covers(triangle, x_px, y_px)) return false;
  if (other != kNoTriangle && covers(other, x_px, y_px) &&
      (triangle == kNoTriangle || truth_.nearer(other, triangle, x_px, y_px)))
    return false;
  return visible_at(x_px, y_px) == triangle;
}

ClippingTruth clipping_truth(const ClippingScene& scene, int threads) {
  camera_of(scene.scene);  // clipping methods know only cameras
  const auto width = static_cast<std::size_t>(scene.size.width);
  const Cull cull = scene.cull_back ? Cull::back : Cull::none;
  ClippingTruth truth{{}, std::make_shared<ClippingOracle>(scene.scene, scene.size, cull)};
  truth.visible.resize(width * static_cast<std::size_t>(scene.size.height));
  parallel_for(threads, scene.size.height, [&](int y) {
    for (int x = 0; x < scene.size.width; ++x)
      truth.visible[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] =
          truth.oracle->visible_at(x + 0.5, y + 0.5);
  });
  return truth;
}

}  // namespace edgewise::lab
