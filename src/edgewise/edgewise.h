/* The C interface. It compiles as C11 and as C++.
 *
 * Conventions
 * - Screen: pixel (0, 0) is top left, y points down, and a pixel's only sample lies at its centre, (+0.5,
 * +0.5).
 * - Clip space, which is projection * view * world: x points right, y up. A vertex is visible where |x| <= w,
 *   |y| <= w and 0 <= z <= w; z = 0 is nearest.
 * - The front of a triangle is the side from which its vertices appear clockwise on the screen.
 * - Matrices are 4 x 4 doubles, column by column, as OpenGL stores them.
 * - Colours are 0xAABBGGRR. Depths are integers, smaller is nearer: edgewise_depth01() converts them.
 * - Frames are the caller's memory. Everything else is copied, so no array needs to outlive its call.
 *
 * Errors: functions return a status, and then edgewise_error() tells what was wrong, in the calling thread. A
 * failed call changes nothing, except that edgewise_draw() and edgewise_barycentrics() may leave the caller's
 * planes undefined.
 *
 * Threads: two threads may use two objects at once. Several may draw one scene at once, each with a renderer
 * and a frame of its own, while none changes it. Two must not draw into one frame, not even into different
 * parts of it.
 *
 * Pictures are the same, bit for bit, on every machine, for every backend and number of threads, and in every
 * floating-point state: functions compute in C's default one on each thread that they use, and put back what
 * they found, with the exceptions that had been raised.
 *
 * The process stays as it was, but for idle threads of oneTBB. A child that was forked after a draw on
 * several threads draws on one, whatever `threads` says; it must not use an object that another thread used
 * at the fork. */
#ifndef EDGEWISE_EDGEWISE_H
#define EDGEWISE_EDGEWISE_H

#include <stddef.h>
#include <stdint.h>

/* Raised when a function or a struct changes so that programs must be compiled anew. */
#define EDGEWISE_ABI 3

#pragma GCC visibility push(default) /* what a shared library exports */
#ifdef __cplusplus
extern "C" {
#endif

/* The EDGEWISE_ABI that the library was compiled with. */
int edgewise_abi(void);

typedef enum edgewise_status {
  EDGEWISE_OK = 0,
  EDGEWISE_INVALID_ARGUMENT = 1,
  EDGEWISE_OUT_OF_MEMORY = 2,
  EDGEWISE_FAILED = 3 /* anything else, such as threads that do not start */
} edgewise_status;

/* What was wrong with the calling thread's last call that failed; "" if none did. Valid until the thread's
 * next call that fails. */
const char* edgewise_error(void);

/* A scene: meshes, their instances, a camera and a light; or a stream of triangles that are on the screen. */
typedef struct edgewise_scene edgewise_scene;

/* A scene without meshes. Its camera is at the origin. */
edgewise_status edgewise_new_scene(edgewise_scene** scene);
/* Null is allowed. */
void edgewise_free_scene(edgewise_scene* scene);

typedef struct edgewise_mesh {
  const float* positions; /* x, y, z per vertex */
  size_t vertex_count;
  size_t position_stride;    /* bytes from vertex to vertex; 0: 12 */
  const uint32_t* triangles; /* three vertices per triangle */
  size_t triangle_count;
  size_t triangle_stride;  /* bytes from triangle to triangle; 0: 12 */
  const uint32_t* colours; /* one per triangle; null: all are light grey */
  int two_sided;           /* if not 0, no triangle is culled, and each is lit on the side that is seen */
} edgewise_mesh;

/* Adds a mesh, which is drawn only by its instances. `index`, unless null, gets its number. Vertices of any
 * value are allowed: triangles with NaN or infinity are not drawn. Fails if a triangle names a vertex that
 * the mesh lacks. */
edgewise_status edgewise_add_mesh(edgewise_scene* scene, const edgewise_mesh* mesh, size_t* index);
/* The same with positions in double, in place of mesh->positions, which must be null; a position_stride of 0
 * is 24. If floats would lose the shape of a mesh far from 0, it is kept relative to a point near its centre
 * (Mesh::set_positions of scene.h), so that coordinates lose at most 2^-24 of the longest side of its box.
 * Matrices of instances apply to the positions that are given. */
edgewise_status edgewise_add_mesh_f64(edgewise_scene* scene, const edgewise_mesh* mesh,
                                      const double* positions, size_t* index);
/* Moves the vertices of a mesh, as many as it has, in all its instances. `stride`: bytes from vertex to
 * vertex; 0: 12, and 24 in double. */
edgewise_status edgewise_set_positions(edgewise_scene* scene, size_t mesh, const float* positions,
                                       size_t vertex_count, size_t stride);
edgewise_status edgewise_set_positions_f64(edgewise_scene* scene, size_t mesh, const double* positions,
                                           size_t vertex_count, size_t stride);

/* Gives `count` triangles of a mesh, from `first` on, a name, for edgewise_objects(). A name may be given
 * again, and triangles may have several. */
edgewise_status edgewise_name_triangles(edgewise_scene* scene, size_t mesh, size_t first, size_t count,
                                        const char* name);

/* Places a mesh in the world by an affine matrix, whose last row is 0 0 0 1. Null: the identity. `index`,
 * unless null, gets the instance's number. */
edgewise_status edgewise_add_instance(edgewise_scene* scene, size_t mesh, const double matrix[16],
                                      size_t* index);
/* Moves an instance. Null is an error. */
edgewise_status edgewise_set_instance(edgewise_scene* scene, size_t instance, const double matrix[16]);
/* Removes an instance: the numbers of those after it fall by 1. Its mesh stays until the scene is freed. */
edgewise_status edgewise_remove_instance(edgewise_scene* scene, size_t instance);

/* The direction towards the light; finite, and of any length but 0. */
edgewise_status edgewise_set_light(edgewise_scene* scene, const double direction[3]);

/* The camera by its matrices: clip = projection * view * world. Draws fail for matrices that camera.h
 * excludes, such as singular ones. That header also says what clips and what depth means. */
edgewise_status edgewise_set_camera(edgewise_scene* scene, const double view[16],
                                    const double projection[16]);
/* The view of a camera at `position`: yaw 0 and pitch 0 look along -z, positive yaw turns left, positive
 * pitch looks up. Angles in radians. */
edgewise_status edgewise_view(const double position[3], float yaw, float pitch, double view[16]);
/* Projections for edgewise_set_camera(), as camera.h describes them. Distances are along the view direction.
 */
/* x right, y up, looks along -z. fov_y in radians; far_z may be infinite. */
edgewise_status edgewise_perspective(double fov_y, double aspect, double near_z, double far_z,
                                     double projection[16]);
/* The same view space, without perspective. near_z < far_z; left > right or bottom > top mirrors the
 * picture. */
edgewise_status edgewise_orthographic(double left, double right, double bottom, double top, double near_z,
                                      double far_z, double projection[16]);
/* Computer vision: x right, y down, looks along z. `k`: the intrinsics, row by row, in pixels of a width x
 * height image in which the first pixel's centre lies at (first_centre, first_centre): 0 for OpenCV, 0.5 for
 * COLMAP. */
edgewise_status edgewise_intrinsics(const double k[9], int width, int height, double first_centre,
                                    double near_z, double far_z, double projection[16]);
/* Converts a projection for another clip space to ours, in place. Flags are 0 or not: z from -w to w
 * (OpenGL), y down (Vulkan), near where z is largest (reversed depth). */
edgewise_status edgewise_convert_projection(int z_from_minus_w, int y_down, int reversed,
                                            double projection[16]);
/* A camera that sees the whole scene, for images whose width is `aspect` times their height, above 0. */
edgewise_status edgewise_frame_scene(edgewise_scene* scene, double aspect);

/* A stream: triangles that are already on the screen. Its functions are edgewise_draw() and
 * edgewise_free_scene(). */
typedef struct edgewise_stream_triangle {
  float vertex[3][3]; /* x and y in pixels, z in 0 ... 1; smaller z is nearer */
  uint32_t colour;
} edgewise_stream_triangle;
edgewise_status edgewise_new_stream(const edgewise_stream_triangle* triangles, size_t count,
                                    edgewise_scene** stream);

/* A renderer keeps its memory between draws: make it once, draw often. `backend`: "tiled", "scanline",
 * "naive" or a composition of `edgewise list --all`, which draw the same pictures; null: "tiled". */
typedef struct edgewise_renderer edgewise_renderer;
edgewise_status edgewise_new_renderer(const char* backend, edgewise_renderer** renderer);
/* Null is allowed. */
void edgewise_free_renderer(edgewise_renderer* renderer);

/* The caller's memory. Row y begins `stride` pixels after row y - 1. Rows that begin on 64-byte boundaries
 * are written fastest. A draw fails if depth and payload share a pixel's memory. */
typedef struct edgewise_frame {
  uint32_t* depth;
  uint32_t* payload; /* colours or ids; null: only depth is drawn */
  int width, height; /* px, 1 ... 16384 */
  ptrdiff_t stride;  /* px, at least width */
} edgewise_frame;

/* The depth of a pixel that no triangle covers; all others are smaller. */
#define EDGEWISE_DEPTH_CLEAR 0x7FFFFFFFu

enum { EDGEWISE_CULL_NONE, EDGEWISE_CULL_BACK, EDGEWISE_CULL_FRONT, EDGEWISE_CULL_BOTH };

typedef struct edgewise_options {
  int cull; /* EDGEWISE_CULL_NONE ... EDGEWISE_CULL_BOTH: which triangles to drop for their facing */
  int ids;  /* if not 0, payloads are ids: first_id plus a triangle's number in its scene, through the
               instances in order */
  uint32_t first_id; /* 0, or in a draw over others the number of their triangles; with this scene's at
                        most 2^30 */
  int unlit;         /* if not 0, colours are not multiplied by the light */
  int threads;       /* 1 ... 256: at most so many, and at most as many as oneTBB's limit for the process */
  int keep; /* if not 0, draws over what the frame holds, where no depth may exceed EDGEWISE_DEPTH_CLEAR */
  uint32_t background; /* the payload where no triangle is visible, unless `keep` */
  int scissor[4];    /* x, y, width, height: the only pixels that are drawn; the others keep what they hold */
  int subpixel_bits; /* 4 ... 15: x and y of vertices are rounded to 2^-subpixel_bits px */
} edgewise_options;

/* No culling, lit colours, one thread, a frame that is cleared to black, no scissor, 8 subpixel bits. */
edgewise_options edgewise_default_options(void);

/* Draws a frame. `options` may be null: the default. With `keep`, draws add up as if they were one, ids
 * included if first_id is the number of triangles of the scenes before. */
edgewise_status edgewise_draw(edgewise_renderer* renderer, const edgewise_scene* scene,
                              const edgewise_options* options, edgewise_frame frame);

/* Counts of a draw: triangles = whole_mesh + not_finite + outside + not_in_front + those that become pieces,
 * and pieces = culled + zero_area + emitted. */
typedef struct edgewise_stats {
  uint64_t meshes, meshes_culled; /* instances, and those out of view */
  uint64_t triangles;
  uint64_t whole_mesh;   /* dropped with their instance, which is out of view */
  uint64_t not_finite;   /* dropped: a vertex is NaN or infinite */
  uint64_t outside;      /* dropped: out of view */
  uint64_t not_in_front; /* dropped: behind the camera */
  uint64_t clipped, clipped_near, clipped_far, clipped_guard;
  uint64_t pieces;    /* triangles after clipping */
  uint64_t culled;    /* pieces dropped for their facing */
  uint64_t zero_area; /* pieces dropped: no area once vertices are rounded */
  uint64_t emitted;   /* pieces drawn */
} edgewise_stats;

/* The counts of the renderer's last edgewise_draw(); undefined after one that failed. */
edgewise_status edgewise_stats_of(const edgewise_renderer* renderer, edgewise_stats* stats);

/* What a frame of ids shows. All pixels of the frame count, so after a draw with a scissor, pass that part of
 * it. */
/* The ids of visible triangles, ascending: writes the first `capacity`, and to `count` how many there are. */
edgewise_status edgewise_visible_triangles(edgewise_frame ids, uint32_t* visible, size_t capacity,
                                           size_t* count);
/* The number of pixels of each triangle, by id. `triangles`: how many the frame's scenes have; all ids must
 * be below. */
edgewise_status edgewise_pixels_per_triangle(edgewise_frame ids, uint32_t* pixels, size_t triangles);
/* The number of pixels of each instance of a scene, or of all instances of each mesh. `instances`, `meshes`:
 * how many the scene has. The frame must show this scene alone, with a first_id of 0. If it shows several,
 * sum edgewise_pixels_per_triangle() between first ids. */
edgewise_status edgewise_pixels_per_instance(edgewise_frame ids, const edgewise_scene* scene,
                                             uint32_t* pixels, size_t instances);
edgewise_status edgewise_pixels_per_mesh(edgewise_frame ids, const edgewise_scene* scene, uint32_t* pixels,
                                         size_t meshes);
/* The id of each instance's first triangle, less first_id; then the scene's number of triangles. `first` has
 * instances + 1 elements. */
edgewise_status edgewise_first_ids(const edgewise_scene* scene, size_t* first, size_t instances);
/* Calls each(context, name, ids, count) for every name that edgewise_name_triangles() gave, in the order of
 * strcmp(): the ids of its triangles, less first_id, ascending, through all instances. What the call gets
 * lives until it returns. */
edgewise_status edgewise_objects(const edgewise_scene* scene,
                                 void (*each)(void* context, const char* name, const uint32_t* ids,
                                              size_t count),
                                 void* context);
/* Whether a box in world space could be seen in front of what the frame shows. 0: it is certainly hidden. 1:
 * it may be visible. The frame needs no payload. */
edgewise_status edgewise_box_visible(const edgewise_scene* scene, const double low[3], const double high[3],
                                     edgewise_frame depth, int* is_visible);
/* Perspective-correct barycentric coordinates of the second and third vertex, u and v, by pixel; 0 on
 * background. u, v and 1 - u - v are >= 0. `distance`, unless null, is w in clip space, which usual
 * projections make the distance along the view direction; in streams and parallel projections, it is the
 * depth in 0 ... 1; infinite on background. Errors of u and v are below 2^-25 + 2^-47 + e / 2, the relative
 * one of the distance is below 2^-24 + 2^-48 + e: barycentrics.h says what e, the error of w, is. In streams
 * it is 0, and usually it is below 2^-19.
 * Planes must overlap neither each other nor the frame. Strides are in floats, from row to row. `ids` must
 * show this scene alone, drawn with these options, which must not be null and must ask for ids; the scissor
 * does not count. A frame of other subpixel_bits is an error, unless its depths are the same with these. If
 * the frame shows several scenes, pass a copy of its depths in which the pixels of the others are
 * EDGEWISE_DEPTH_CLEAR. */
edgewise_status edgewise_barycentrics(const edgewise_scene* scene, const edgewise_options* options,
                                      edgewise_frame ids, float* uv, ptrdiff_t uv_stride, float* distance,
                                      ptrdiff_t distance_stride);

/* From 0, which is the near plane, to 1, which is the far plane or the background. */
double edgewise_depth01(uint32_t depth);
/* A number that is the same for the same picture, on every machine. */
edgewise_status edgewise_hash(edgewise_frame frame, uint64_t* hash);

#ifdef __cplusplus
}
#endif
#pragma GCC visibility pop
#endif
