#include "lab/needs/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "lab/coverage/methods/fixed_edges.h"
#include "lab/visibility/methods/painter.h"

namespace edgewise::lab {

namespace {

using Order = Pipeline::Order;

class Overwrite {
 public:
  Overwrite(const VisibilityScene& scene, VisibilityFrame& frame) : width_(scene.width) {
    clear_visible(scene, frame);
    visible_ = frame.visible.data();
  }
  void start(std::uint32_t id) { id_ = id; }
  void begin() {}
  void pixel(int x, int y) { visible_[std::ptrdiff_t{y} * width_ + x] = id_; }
  void span(int y, int x0, int x1) {
    std::fill(visible_ + std::ptrdiff_t{y} * width_ + x0, visible_ + std::ptrdiff_t{y} * width_ + x1, id_);
  }

 private:
  std::uint32_t* visible_;
  int width_;
  std::uint32_t id_ = kNoTriangle;
};

template <int kBits, typename Word>
class DepthTest {
 public:
  DepthTest(const VisibilityScene& scene, VisibilityFrame& frame, std::vector<Word>& depth) : scene_(scene) {
    clear_visible(scene, frame);
    depth.assign(frame.visible.size(), static_cast<Word>(Plane::kMax));
    visible_ = frame.visible.data(), depth_ = depth.data();
  }
  void start(std::uint32_t id) { id_ = id; }
  void begin() { plane_.emplace(scene_.triangles[id_], scene_); }
  void pixel(int x, int y) { span(y, x, x + 1); }
  void span(int y, int x0, int x1) {
    plane_->row(x0, y);
    const std::ptrdiff_t row = std::ptrdiff_t{y} * scene_.width;
    for (int x = x0; x < x1; ++x) {
      const Word z = plane_->value(x);
      if (!Plane::nearer(z, depth_[row + x])) continue;
      depth_[row + x] = z, visible_[row + x] = id_;
    }
  }

 private:
  using Plane = UnormPlane<kBits, Word>;
  const VisibilityScene& scene_;
  std::uint32_t* visible_;
  Word* depth_;
  std::uint32_t id_ = kNoTriangle;
  std::optional<Plane> plane_;
};

template <class Edges, class Plot>
void cover(const VisibilityScene& scene, std::uint32_t id, Plot& plot) {
  const VisibilityTriangle& t = scene.triangles[id];
  plot.start(id);
  Edges::cover({{t.x_px[0], t.x_px[1], t.x_px[2]}, {t.y_px[0], t.y_px[1], t.y_px[2]}, {}},
               {scene.width, scene.height}, plot);
}

template <class Edges, class Plot>
void cover_all(const VisibilityScene& scene, Plot plot) {
  for (std::uint32_t id = 0; id < scene.triangles.size(); ++id) cover<Edges>(scene, id, plot);
}

template <class Edges>
void cover_sorted(const VisibilityScene& scene, Order order, VisibilityFrame& frame) {
  sort_faces(scene, frame, order == Order::mean ? mean_distance : farthest_distance);
  Overwrite plot(scene, frame);
  for_each_sorted(scene, frame, [&](std::uint32_t id) { cover<Edges>(scene, id, plot); });
}

template <class Edges>
void draw_with_edges(const Pipeline& pipeline, const VisibilityScene& scene, VisibilityFrame& frame) {
  if (pipeline.order == Order::submission) return cover_all<Edges>(scene, Overwrite(scene, frame));
  if (pipeline.order != Order::depth) return cover_sorted<Edges>(scene, pipeline.order, frame);
  switch (pipeline.depth_bits) {
    case 16:
      return cover_all<Edges>(scene, DepthTest<16, std::uint16_t>(scene, frame, frame.depth16));
    case 24:
      return cover_all<Edges>(scene, DepthTest<24, std::uint32_t>(scene, frame, frame.depth32));
    case 30:
      return cover_all<Edges>(scene, DepthTest<30, std::uint32_t>(scene, frame, frame.depth32));
    default:
      throw std::invalid_argument("a pipeline's depth buffer has 16, 24 or 30 bits");
  }
}

template <int kSubpixelBits>
void draw_with_bits(const Pipeline& pipeline, const VisibilityScene& scene, VisibilityFrame& frame) {
  if (pipeline.edge_bits == 32)
    draw_with_edges<FixedEdges<kSubpixelBits, std::int32_t>>(pipeline, scene, frame);
  else
    draw_with_edges<FixedEdges<kSubpixelBits, std::int64_t>>(pipeline, scene, frame);
}

}  // namespace

std::string Pipeline::describe() const {
  const std::string visibility = order == Order::submission ? "submission order"
                                 : order == Order::mean     ? "painter_mean"
                                 : order == Order::farthest ? "painter_farthest"
                                                            : fmt::format("{}-bit depth", depth_bits);
  return fmt::format("{} subpixel bits, {}-bit edges, {}", subpixel_bits, edge_bits, visibility);
}

void draw(const Pipeline& pipeline, const VisibilityScene& scene, VisibilityFrame& frame) {
  switch (pipeline.subpixel_bits) {
    case 0:
      return draw_with_bits<0>(pipeline, scene, frame);
    case 4:
      return draw_with_bits<4>(pipeline, scene, frame);
    case 8:
      return draw_with_bits<8>(pipeline, scene, frame);
    case 16:
      return draw_with_bits<16>(pipeline, scene, frame);
    default:
      throw std::invalid_argument("a pipeline has 0, 4, 8 or 16 subpixel bits");
  }
}

}  // namespace edgewise::lab
