// Peers (other projects' rasterizers) in the benchmark draw our scenes, and wrong pictures are found.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

#include "bench/workloads/peers.h"
#include "bench/workloads/stage.h"
#include "core/grid.h"
#include "core/random.h"
#include "edgewise/contract.h"
#include "frontend/view.h"
#include "lab/coverage_support.h"
#include "lab/peers/mesa/gl_context.h"
#include "lab/portable/portable.h"
#include "message_of.h"

namespace edgewise::bench {
namespace {

using contract::kPixel_q15;
using lab::benchmark_peers, lab::peers, lab::start_peers, lab::StartedPeers, lab::use_context;

ScreenTriangle half_square(std::uint32_t z, std::uint32_t id) {
  return {{0, 64 * kPixel_q15, 0}, {0, 0, 64 * kPixel_q15}, {z, z, z}, id};
}

TEST(PeerJudge, AcceptsOnlyDepthTiesWithinTolerance) {
  constexpr std::uint32_t kNear = 1u << 30;
  const auto bound = static_cast<std::uint32_t>(float_plane_error(half_square(kNear, 0), 64, 64));
  ScreenTriangle elsewhere = half_square(kNear, 2);
  for (auto& x : elsewhere.x_q15) x += 40 * kPixel_q15;
  const std::vector triangles{half_square(kNear, 0), half_square(kNear + bound, 1), elsewhere,
                              half_square(kNear + 4 * bound, 3)};
  Framebuffer ours(64, 64);
  backends().front().make()->draw(triangles, ours.view(), {kNoTriangle});
  std::vector<std::uint32_t> theirs = lab::payloads_of(ours);
  EXPECT_EQ(judge(ours, theirs, triangles).different, 0u);
  theirs[1] = 1;
  EXPECT_EQ(judge(ours, theirs, triangles).tie, 1u);
  EXPECT_EQ(judge(ours, theirs, triangles).wrong, 0u);
  theirs[2] = 2;            // misses the pixel
  theirs[3] = 3;            // too far behind
  theirs[5] = kNoTriangle;  // nothing
  theirs[64 * 64 - 1] = 0;  // where ours has nothing
  EXPECT_EQ(judge(ours, theirs, triangles).tie, 1u);
  EXPECT_EQ(judge(ours, theirs, triangles).wrong, 4u);
}

std::shared_ptr<Workload> prepared(int width, int height, Cull cull, std::function<tools::Source()> load,
                                   int subpixel_bits = 8) {
  auto workload = std::make_shared<Workload>(width, height, cull, std::move(load));
  workload->set_subpixel_bits(subpixel_bits);
  workload->prepare(true);
  return workload;
}

std::shared_ptr<Workload> workload_of(const std::string& scene, bool fit = false, int subpixel_bits = 8) {
  const SceneRequest request{320, 180, 0.0f, 0.02};
  const auto load = [=] { return tools::load_source(scene, request, fit); };
  return prepared(request.width, request.height, Cull::back, load, subpixel_bits);
}

std::shared_ptr<Workload> workload_of(const std::string& name, const TriangleStream& stream) {
  return prepared(stream.width, stream.height, Cull::none, [=] { return tools::Source{name, stream, true}; });
}

TEST(PeerScene, GivesEachTriangleItsOwnLastVertex) {
  for (const std::string scene : {"cube", "torus-knot", "sphere"}) {
    const auto workload = workload_of(scene);
    const auto& given = std::get<Scene>(workload->drawable());
    const PeerScene made = peer_scene(*workload, PeerPayload::id);
    ASSERT_EQ(made.meshes.size(), given.instances.size());
    std::uint32_t id = 0;
    for (std::size_t m = 0; m < made.meshes.size(); ++m) {
      const Mesh& mesh = given.meshes[given.instances[m].mesh];
      const PeerMesh& peer = made.meshes[m];
      const ScreenTransform seen({given.camera, made.width, made.height},
                                 model_matrix(mesh, given.instances[m]));
      const auto relative = [&](std::uint32_t vertex) {
        return mesh.positions[vertex] - glm::vec3(seen.origin);
      };
      ASSERT_EQ(peer.indices.size(), 3 * mesh.triangles.size());
      EXPECT_LE(peer.positions.size(), mesh.positions.size() + mesh.triangles.size());
      for (std::size_t i = 0; i < mesh.triangles.size(); ++i, ++id) {
        const auto at = [&](std::size_t k) { return peer.positions[peer.indices[3 * i + k % 3]]; };
        bool turned = false;
        for (std::size_t turn = 0; turn < 3; ++turn)
          turned |= at(turn) == relative(mesh.triangles[i][0]) &&
                    at(turn + 1) == relative(mesh.triangles[i][1]) &&
                    at(turn + 2) == relative(mesh.triangles[i][2]);
        ASSERT_TRUE(turned) << scene << ' ' << i;
        ASSERT_EQ(peer.payloads[peer.indices[3 * i + 2]], id) << scene << ' ' << i;
      }
    }
  }
}

TEST(PeerScene, RoundsAStreamsPositionsAsTheFrontEndDoes) {
  const auto workload = workload_of("small");
  const PeerScene made = peer_scene(*workload, PeerPayload::colour);
  ASSERT_EQ(made.meshes.size(), 1u);
  const auto& positions = made.meshes[0].positions;
  const auto rounded = [](glm::vec3 v) {
    constexpr auto kSub = static_cast<float>(Coarse::kSub);
    return glm::vec3(std::nearbyint(v.x * kSub) / kSub, std::nearbyint(v.y * kSub) / kSub, v.z);
  };
  const auto& given = std::get<TriangleStream>(workload->drawable()).triangles;
  ASSERT_EQ(positions.size(), 3 * given.size());
  std::vector<std::uint32_t> colours(given.size(), 0);  // 0: the front end drops the triangle
  const auto ids = triangles_by_id(*workload);
  for (std::size_t i = 0; i < ids.size(); ++i) colours[ids[i].payload] = workload->triangles()[i].payload;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    ASSERT_EQ(positions[i], rounded(given[i / 3].vertex[i % 3]));
    ASSERT_EQ(made.meshes[0].payloads[i], colours[i / 3]);
  }
}

// A peer that draws with one of our backends, correctly or with a deliberate error.
class Mirror final : public PeerFrame {
 public:
  Mirror(const PeerScene& scene, bool is_wrong)
      : scene_(scene), frame_(scene.width, scene.height), is_wrong_(is_wrong) {}
  void draw() override {
    std::vector<ScreenTriangle> triangles;
    const PeerMesh& mesh = scene_.meshes.at(0);
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
      ScreenTriangle t{{}, {}, {}, mesh.payloads[i + 2]};
      for (std::size_t k = 0; k < 3; ++k) {
        t.x_q15[k] = static_cast<std::int32_t>(std::nearbyint(mesh.positions[i + k].x * Coarse::kSub))
                     << Coarse::kSpareBits;
        t.y_q15[k] = static_cast<std::int32_t>(std::nearbyint(mesh.positions[i + k].y * Coarse::kSub))
                     << Coarse::kSpareBits;
        t.z[k] = static_cast<std::uint32_t>(double{mesh.positions[i + k].z} * contract::kDepthRange) +
                 contract::kDepthHead;
      }
      if (is_wrong_) std::rotate(t.z, t.z + 1, t.z + 3), t.x_q15[0] += kPixel_q15;
      triangles.push_back(t);
    }
    backends().back().make()->draw(triangles, frame_.view(), {scene_.background});
  }
  std::vector<std::uint32_t> read() override { return lab::payloads_of(frame_); }

 private:
  PeerScene scene_;
  Framebuffer frame_;
  bool is_wrong_;
};

template <bool is_wrong>
PeerInfo mirror() {
  return {.name = "mirror",
          .summary = "our backend",
          .most_threads = 2,
          .exact = true,
          .subpixel_bits = [] { return 8; },
          .version = [] { return std::string("1"); },
          .load = [](const PeerScene& scene,
                     int) { return std::unique_ptr<PeerFrame>(std::make_unique<Mirror>(scene, is_wrong)); }};
}

Row row_of(const PeerInfo& peer, const std::shared_ptr<Workload>& workload, int threads) {
  Row row;
  row.name = std::string(peer.name) + std::to_string(threads);
  row.workload = workload;
  row.timed = Timed::frame;
  row.peer = &peer;
  row.execution.threads = threads;
  return row;
}

TEST(PeerStage, AcceptsACorrectPictureAndRejectsAWrongOne) {
  for (const auto& [exact, bits] : {std::pair{true, 8}, {false, 8}, {false, 4}, {false, 12}}) {
    const auto workload = workload_of("medium", false, bits);
    PeerInfo right = mirror<false>(), wrong = mirror<true>();
    right.exact = wrong.exact = exact || bits != 8;  // of 8 bits, which is judged as another at other bits
    PeerStage stage;
    Row good = row_of(right, workload, 1), bad = row_of(wrong, workload, 2);
    stage.compare(good);
    stage.compare(bad);
    EXPECT_EQ(good.error, "");
    EXPECT_EQ(good.wrong_px.has_value(), !exact);
    EXPECT_NE(bad.error.find(exact ? "triangle or none" : "triangle although they are portable"),
              std::string::npos)
        << bad.error;
  }
}

bool runs_here(const PeerInfo& peer) {
  try {
    peer.version();
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

class AllPeers : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::ranges::none_of(peers(), runs_here)) GTEST_SKIP() << "no peer runs here";
  }
};

// The benchmark's peers draw our pictures, of hard triangle families and of whole scenes.
class BuiltPeer : public AllPeers, public ::testing::WithParamInterface<std::string> {};

// The others reach beyond 8192 px, where llvmpipe clips.
constexpr std::array<std::string_view, 9> kNearFamilies{
    "uniform", "slivers", "lattice", "pixel-centres", "grid", "ties", "steep", "cloud", "degenerate"};

std::shared_ptr<Workload> hard_workload(const std::string& family, std::uint64_t seed = 7) {
  TriangleStream stream{192, 128, {}};
  for (const ScreenTriangle& t : testing::adversarial(family, 400, stream.width, stream.height, seed)) {
    StreamTriangle& out = stream.triangles.emplace_back(StreamTriangle{{}, t.payload});
    for (int k = 0; k < 3; ++k)
      out.vertex[k] = {static_cast<float>(t.x_q15[k]) / kPixel_q15,
                       static_cast<float>(t.y_q15[k]) / kPixel_q15,
                       static_cast<float>(t.z[k]) / static_cast<float>(contract::kDepthClear)};
  }
  return workload_of(family, stream);
}

std::shared_ptr<Workload> named_workload(const std::string& name) {
  const bool family = std::ranges::find(kNearFamilies, name) != kNearFamilies.end();
  return family ? hard_workload(name) : workload_of(name);
}

// Beside NVIDIA's driver, EGL gave its OpenGL when asked for softpipe. The first use was refused, but the
// context stayed current, and the second use passed.
struct FakeContext {
  std::string name;
  bool current = false;

  bool is_current() const { return current; }
  bool make_current() { return current = true; }
  void release() { current = false; }
  std::string renderer() const { return name; }
};

TEST(GlContext, IsCheckedAtEachUse) {
  FakeContext wrong{"NVIDIA H200/PCIe/SSE2"};
  for (int use = 1; use <= 2; ++use) {
    EXPECT_EQ(message_of([&] { use_context(wrong, "softpipe"); }), "EGL gives NVIDIA H200/PCIe/SSE2 instead");
    EXPECT_FALSE(wrong.is_current()) << use;
  }
  FakeContext right{"softpipe"};
  for (int use = 1; use <= 2; ++use) EXPECT_NO_THROW(use_context(right, "softpipe"));
  EXPECT_TRUE(right.is_current());
}

TEST(Peers, ThatCannotStartAreNamedAndLeftOut) {
  const PeerInfo works{.name = "works", .version = [] { return std::string("2.0"); }};
  const PeerInfo broken{.name = "broken", .version = []() -> std::string {
                          throw std::runtime_error("broken: EGL gives another");
                        }};
  const StartedPeers some = start_peers(std::vector{broken, works});
  ASSERT_EQ(some.peers.size(), 1u);
  EXPECT_EQ(some.peers[0].second, "2.0");
  EXPECT_EQ(some.left_out, std::vector<std::string>{"broken: EGL gives another"});
  EXPECT_NO_THROW(some.require_one());
  const StartedPeers none = start_peers(std::vector{broken});
  EXPECT_EQ(message_of([&] { none.require_one(); }), "--peers: none starts: broken: EGL gives another");
  EXPECT_NE(message_of([&] { start_peers({}).require_one(); }).find("--peers: there is none"),
            std::string::npos);
}

// Against the mask of a rasterizer with so many subpixel bits, with a picture that lies too far to the right.
PeerJudgement judged_portable(const Workload& workload, const PeerInfo& peer, int subpixel_bits,
                              float moved_px = 0.0f) {
  PeerScene scene = peer_scene(workload, PeerPayload::id);
  for (PeerMesh& mesh : scene.meshes)
    mesh.to_screen = glm::translate(glm::mat4(1), {moved_px, 0, 0}) * mesh.to_screen;
  const auto frame = peer.load(scene, 1);
  frame->draw();
  return judge_portable(workload, frame->read(), subpixel_bits);
}

// Fails if a peer that runs here differs from us in a portable pixel.
void expect_portable(const Workload& workload, const std::string& name) {
  for (const PeerInfo& peer : peers())
    if (runs_here(peer)) {
      EXPECT_EQ(judged_portable(workload, peer, peer.subpixel_bits()).wrong, 0u) << peer.name << ' ' << name;
    }
}

// llvmpipe and lavapipe have 8 subpixel bits. softpipe claims 4, and computes edges in floats.
TEST_P(BuiltPeer, DrawsOurPictures) {
  const auto workload = named_workload(GetParam());
  expect_portable(*workload, GetParam());
  for (const PeerInfo& peer : benchmark_peers())
    for (int threads = 1; threads <= (runs_here(peer) ? peer.most_threads : 0); ++threads) {
      Row row = row_of(peer, workload, threads);
      PeerStage().compare(row);
      EXPECT_EQ(row.error, "") << peer.name << ", threads " << threads;
    }
}

// Triangles of every size and distance. About a third of them cross the near or far plane.
std::shared_ptr<Workload> random_mesh(std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  scene.instances.resize(1);
  scene.camera.near_z = random.uniform(0.05f, 1.0f);
  scene.camera.far_z = random.uniform(5.0f, 50.0f);
  for (unsigned i = 0; i < 60; ++i) {
    const float distance = random.uniform(0.0f, 1.2f) * scene.camera.far_z;
    const float size = std::exp2(random.uniform(-6.0f, 1.0f)) * (distance + 1.0f);
    const float x = random.uniform(-1.0f, 1.0f) * distance, y = random.uniform(-0.6f, 0.6f) * distance;
    for (int k = 0; k < 3; ++k) {
      glm::vec3 at(x, y, -distance);
      for (int axis = 0; axis < 3; ++axis) at[axis] += random.uniform(-size, size);
      mesh.positions.push_back(at);
    }
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    mesh.colours.push_back(0);
  }
  return prepared(192, 128, seed % 2 == 0 ? Cull::none : Cull::back, [=] {
    return tools::Source{"random", scene, false};
  });
}

TEST_F(AllPeers, DifferFromUsOnlyInPixelsOfRandomTrianglesThatAreNotPortable) {
  const std::size_t scenes = testing::full_size() ? 1000 : 24;
  for (std::size_t i = 0; i < scenes; ++i) {
    const std::string family(testing::kFamilies[i % testing::kFamilies.size()]);
    expect_portable(*random_mesh(i), std::to_string(i));
    expect_portable(*hard_workload(family, 1000 + i), family + " " + std::to_string(i));
  }
  // Of this one, beyond the guard band, llvmpipe draws nothing.
  TriangleStream far{96, 64, {}};
  far.triangles.push_back(
      {{{59.98f, 22.47f, 0.5f}, {-6323.7f, -3842.6f, 0.5f}, {-1129.1f, -2980.9f, 0.5f}}, 1});
  expect_portable(*workload_of("far", far), "far");
}

// Any .obj files, from the folder that EDGEWISE_MESHES names. The project ships none.
TEST_F(AllPeers, DifferFromUsOnlyInPixelsOfYourMeshesThatAreNotPortable) {
  const char* folder = getenv("EDGEWISE_MESHES");
  if (folder == nullptr) GTEST_SKIP() << "EDGEWISE_MESHES names no folder of .obj files";
  int meshes = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".obj") continue;
    ++meshes;
    expect_portable(*workload_of(file.path().string(), true), file.path().string());
  }
  ASSERT_GT(meshes, 0) << "no .obj file in " << folder;
}

// Otherwise the tests above would pass for any mask.
TEST_F(AllPeers, ShowAMaskThatIsTooSmall) {
  const auto softpipe = std::ranges::find(peers(), "softpipe", &PeerInfo::name);
  if (softpipe == peers().end() || !runs_here(*softpipe))
    GTEST_SKIP() << "softpipe was not built or does not run";
  EXPECT_GT(judged_portable(*workload_of("torus-knot"), *softpipe, 8, 0.0625f).wrong, 0u);
  EXPECT_GT(judged_portable(*workload_of("quads"), *softpipe, 8).tie, 0u);
}

// All are loaded at once.
TEST_F(AllPeers, HaveContextsOfTheirOwn) {
  const auto workload = workload_of("medium");
  std::vector<std::pair<const PeerInfo*, std::unique_ptr<PeerFrame>>> frames;
  for (const PeerInfo& peer : peers())
    if (runs_here(peer))
      for (int threads = 1; threads <= peer.most_threads; ++threads)
        frames.emplace_back(&peer, peer.load(peer_scene(*workload, PeerPayload::id), threads));
  for (const auto& [peer, frame] : frames) frame->draw();
  for (const auto& [peer, frame] : frames)
    EXPECT_EQ(judge_portable(*workload, frame->read(), peer->subpixel_bits()).wrong, 0u) << peer->name;
}

// lavapipe stands for a GPU.
TEST(Gpu, IsTimedByItsOwnClock) {
  setenv("EDGEWISE_GPU", "llvmpipe", 1);
  const auto gpu = std::ranges::find(peers(), "gpu", &PeerInfo::name);
  if (gpu == peers().end() || !runs_here(*gpu)) GTEST_SKIP() << "Vulkan was not built, or finds no llvmpipe";
  ASSERT_TRUE(gpu->own_clock);
  Row row = row_of(*gpu, workload_of("medium"), 1);
  row.device_clock = true;
  Stage stage;
  stage.compare(row);
  EXPECT_EQ(row.error, "");
  EXPECT_TRUE(row.wrong_px.has_value());
  const auto begin = std::chrono::steady_clock::now();
  const double device_s = stage.timed_work_s(row);
  EXPECT_GT(device_s, 0.0);
  EXPECT_LT(device_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  unsetenv("EDGEWISE_GPU");
}

std::vector<std::string> compared_names() {
  std::vector<std::string> names;
  for (const auto& scene : builtin_scenes()) names.emplace_back(scene.name);
  for (const auto family : kNearFamilies) names.emplace_back(family);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, BuiltPeer, ::testing::ValuesIn(compared_names()),
                         [](const auto& test) { return testing::test_name(test); });

}  // namespace
}  // namespace edgewise::bench
