/* Draws two overlapping squares by the C interface, and prints the picture's hash; square.cpp draws the same. */
#include <edgewise/edgewise.h>

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

enum { kWidth = 320, kHeight = 180, kStride = 333 };
static uint32_t depth[kStride * kHeight], payload[kStride * kHeight];

static int check(edgewise_status status) {
  if (status != EDGEWISE_OK) fprintf(stderr, "%s\n", edgewise_error());
  return status != EDGEWISE_OK;
}

int main(void) {
  const float positions[] = {-1, -1, 0, -1, 1, 0, 1, 1, 0, 1, -1, 0};
  const uint32_t triangles[] = {0, 1, 2, 0, 2, 3}, colours[] = {0xFF4639E6, 0xFF57C8FF};
  const edgewise_mesh mesh = {
      .positions = positions, .vertex_count = 4, .triangles = triangles, .triangle_count = 2, .colours = colours};
  const double view[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -3, 1};
  const double moved[16] = {1, 0, .5, 0, .25, 1, 0, 0, 0, 0, 1, 0, .5, .25, -1, 1};
  double projection[16];
  edgewise_scene* scene = NULL;
  edgewise_renderer* renderer = NULL;
  edgewise_options options = edgewise_default_options();
  options.threads = 2;
  const edgewise_frame frame = {depth, payload, kWidth, kHeight, kStride};
  size_t square;
  uint64_t hash;
  if (edgewise_abi() != EDGEWISE_ABI || check(edgewise_new_scene(&scene)) || check(edgewise_add_mesh(scene, &mesh, &square)) ||
      check(edgewise_add_instance(scene, square, NULL, NULL)) ||
      check(edgewise_add_instance(scene, square, moved, NULL)) ||
      check(edgewise_perspective(1.0, (double)kWidth / kHeight, .1, INFINITY, projection)) ||
      check(edgewise_set_camera(scene, view, projection)) || check(edgewise_new_renderer("tiled", &renderer)) ||
      check(edgewise_draw(renderer, scene, &options, frame)) || check(edgewise_hash(frame, &hash)))
    return 1;
  printf("%016" PRIx64 "\n", hash);
  edgewise_free_renderer(renderer);
  edgewise_free_scene(scene);
  /* An error is a status and a text; a null handle is an error. */
  return edgewise_draw(NULL, NULL, NULL, frame) == EDGEWISE_INVALID_ARGUMENT && edgewise_error()[0] != '\0' ? 0 : 1;
}
