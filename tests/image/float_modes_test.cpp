// What is read of files, and differences of pictures, in other floating-point states; tests/guest has the
// rest.
#include "float_modes.h"

#include "edgewise/image.h"
#include "edgewise/obj_file.h"
#include "temp_dir.h"

namespace edgewise {
namespace {

using testing::bits, testing::bits_of;

TEST(FloatModeOfFiles, ChangesNothingThatIsRead) {
  const TempDir folder;
  const auto png = folder.path() / "picture.png", pfm = folder.path() / "depth.pfm";
  const auto obj =
      folder.write("mesh.obj",
                   "v 1000000.1 0.3 0.7 .11 .57 .93\nv 1000001.3 0 .1 .3 .7 .9\nv 1000000.9 1.7 .3 .1 .7 .3\n"
                   "v 1000000.2 1.9 1e-42 1 .3 .1\nf 1 2 3 4\n");
  Framebuffer frame(9, 7);
  for (int i = 0; i < 7 * static_cast<int>(frame.stride()); ++i) {
    frame.view().depth[i] = 123456789u * static_cast<unsigned>(i) >> 1;
    frame.view().payload[i] = 987654321u * static_cast<unsigned>(i);
  }
  const DepthMap other{9, 7, std::vector<float>(63, 0.3f)};
  testing::expect_same_in_every_float_mode([&](int) {
    const Scene scene = read_obj(obj);
    const Mesh& mesh = scene.meshes[0];
    const DepthMap depth = to_depth_map(frame);
    write_pfm(pfm, depth), write_image(png, to_image(frame));
    const Difference found = difference(depth, other);
    return testing::Bits{bits_of(mesh.positions),
                         bits_of(mesh.normals),
                         bits_of(mesh.colours),
                         bits(scene.instances[0].translation),
                         bits(scene.camera.position),
                         bits_of(depth.depth01),
                         bits(found.largest),
                         bits_of(found.picture.pixels),
                         bits(difference(read_pfm(pfm), depth).largest),
                         bits(difference(read_image(png), to_image(frame)).largest)};
  });
}

}  // namespace
}  // namespace edgewise
