// Cameras: a position and two angles, or any view and projection as matrices, with helpers for the
// conventions of other programs. Frontend::run() and draw() check matrices; the helpers check numbers.
//
// World space is right-handed: x points right, y up, and z backwards for a camera of yaw 0 and pitch 0, which
// looks along -z. Angles are in radians, lengths in world units.
//
// Matrices multiply column vectors, clip = projection · view · position, and glm names elements
// m[column][row]. There is one clip space: x points right, y up, z away from the camera. A point is visible
// where |x| <= w, |y| <= w and 0 <= z <= w. In an image of `width` x `height` pixels it lies at
//   x_px = width (x / w + 1) / 2,  y_px = height (1 - y / w) / 2
// So y_px points down. Pixel (0, 0) is top left, and its centre lies at (0.5, 0.5). The front of a triangle
// is the side whose vertices appear clockwise in the image. Depth is 0 at the near plane and 1 at the far
// plane; the smaller depth is nearer.
#pragma once

#include "edgewise/cxx20.h"

#include <glm/glm.hpp>

#pragma GCC visibility push(default)
namespace edgewise {

struct Camera {
  glm::dvec3 position{0.0};
  float yaw = 0.0f;     // radians about +y; positive turns left
  float pitch = 0.0f;   // radians; positive looks up. At ±pi/2, yaw still turns the image
  float fov_y = 1.0f;   // vertical field of view in radians, 0 < fov_y < pi
  float near_z = 0.1f;  // distances along the view direction, 0 < near_z < far_z
  float far_z = 100.0f;

  // Turns the camera towards a point. Straight up and straight down, yaw becomes 0: the image's top then
  // points along +z (up) or -z (down). Does nothing if the point is the camera's own position.
  void look_at(glm::dvec3 target);
};

// Any view and projection that have an inverse, see at least one point, and are finite. What clips, and what
// depth means, depends on the projection:
// - Usual perspective: the view is affine (its last row is 0 0 0 1), and the projection's rows are
//     x: (·, ·, ·, 0)   y: (·, ·, ·, 0)   z: (0, 0, ·, ·)   w: (0, 0, ·, 0)
//   w is the distance along the view direction, or a multiple of it, and w clips: near and far are the values
//   of w where z = 0 and z = w. Far may be infinite. Depth is z / w, computed from w (rule 6 of contract.h).
//   z / w must grow with w: see ClipSpace::reversed. This is as precise as a Camera.
// - All others: z clips, and depth is z / w. A perspective projection becomes one of these if it is already
//   multiplied with the view. Positions stay precise, but far points get coarser depths. Reversed depth is
//   not noticed here: projection_from() converts it.
// Rule 10, below, says how precise positions and depths are, also far from the world's origin.
struct CameraMatrices {
  glm::dmat4 view{1.0};        // world space → view space, in which any direction may be forward
  glm::dmat4 projection{1.0};  // view space → clip space
};

// What a camera sees, as matrices. `aspect` is the image's width divided by its height. Throws
// std::invalid_argument if a value is out of range.
CameraMatrices matrices_of(const Camera& camera, double aspect);

// A perspective projection from a view space in which x points right, y up, and z backwards (OpenGL, glTF):
// `fov_y` is the vertical field of view in radians, `aspect` the image's width divided by its height. near_z
// and far_z are distances along the view direction; far_z may be infinite. Throws std::invalid_argument
// unless 0 < fov_y < pi, 0 < aspect and 0 < near_z < far_z.
glm::dmat4 perspective_projection(double fov_y, double aspect, double near_z, double far_z);

// A parallel projection from the same view space. It shows left … right, bottom … top, and distances
// near_z … far_z along the view direction, which may be negative. left > right or bottom > top mirrors the
// picture. Throws std::invalid_argument for a value that is not finite, for an empty range, and unless near_z
// < far_z: projection_from() converts reversed depth.
glm::dmat4 orthographic_projection(double left, double right, double bottom, double top, double near_z,
                                   double far_z);

// Computer vision: the projection of a pinhole camera with intrinsics `k`, whose last row is 0 0 1: as
// for all glm matrices, k[2] is the last column. In its
// view space, x points right, y down, and z forward, so its view is the usual world-to-camera matrix. k gives
// positions in an image of `width` x `height` pixels, in which the centre of the first pixel lies at
// (first_centre, first_centre): 0 for OpenCV, 0.5 for COLMAP. Distances are those of
// perspective_projection(). Throws std::invalid_argument for a value out of range.
glm::dmat4 intrinsics_projection(const glm::dmat3& k, int width, int height, double first_centre,
                                 double near_z, double far_z);

// How another program's clip space differs from this one.
struct ClipSpace {
  bool z_from_minus_w = false;  // visible where -w <= z <= w
  bool y_down = false;
  bool reversed = false;  // the near plane is where z is largest
};
inline constexpr ClipSpace kOpenGl{.z_from_minus_w = true}, kDirect3d{}, kVulkan{.y_down = true};

// Converts a projection for another clip space to ours; the picture stays the same. Direct3D multiplies row
// vectors and stores rows: copy its 16 numbers unchanged into a glm matrix.
glm::dmat4 projection_from(ClipSpace space, const glm::dmat4& projection);

namespace contract {

// Rule 10 of the contract, positions of a scene's vertices before they are snapped (rule 2). Their truth is
// the exact product of the vertex and the matrices of the instance and the camera, whose elements are
// doubles: sines and tangents before them belong to the camera's statement. A point o, for a Camera its
// position, is subtracted from a vertex before anything else is rounded.
//
// With up to 8 subpixel bits, floats transform vertices. Let d be the vertex minus the camera's position in
// model space rounded to float; doubles transform what that rounding leaves. With f = height / (2 tan(fov_y /
// 2)), for an unscaled instance, each row of
//   x w = f x' + width / 2 w,  y w = f y' + height / 2 w,  w
// has coefficients of length at most f + width (1 for w), and four terms that are rounded six times in float:
// d, coefficient, product, three sums. Let D be the vertex' distance from the camera. The first three terms
// add up to at most sqrt(3) D times that length. So does the fourth, if the camera is at most 2^24 D away
// from the model's origin. Six roundings of 2^-24 and the division give, for a vertex in view,
//   |error of x, y| < 2^-19 (f + 2 max(width, height)) D / w px
// which is under 4 sub-units in 1920 x 1080 px at 45 degrees. A vertex counts as nearer than the near plane,
// or as beyond another one, by its rounded coordinates, so it may be 2^-19 D off.
//
// Triangles that planes cut are transformed and cut in double, from their own vertices. Where w is the new
// vertex' and D the distance of the farthest corner, the error of x and y is below
//   2^-10 + 2^-50 (f + width) D / w px
// where 2^-10 px is a float's rounding at the guard band. A corner that is not cut off keeps its rounded
// position, as in the neighbouring triangles.
//
// With matrices, the point o that is subtracted depends on the projection:
// - Usual perspective: the camera's position.
// - Parallel, where w is the same everywhere: the point nearest to the instance's origin on the axis from the
//   middle of the near plane to that of the far plane. Only z changes along this axis.
// - Others: a point of the view volume where w is smallest.
// Let D be the vertex' distance from o, `side` the larger of width and height, and L, Lz and Lw the lengths
// of the coefficients of x w or y w, of z, and of w. The fourth term is now at most `side` w larger, so
//   |error of x, y| < 2^-19 ((L + side Lw) D / w + side) px
// for a vertex in view of an unscaled instance whose origin is at most 2^24 D away from o. Depth uses z and w
// computed in double. Only the rounding of d remains:
//   |error of depth| < 2^-23 (Lz + Lw) D / w, and 1 unit
// An instance's matrix whose columns are nearly dependent, but not orthogonal, is less precise: o is not
// subtracted before its products are rounded.
//
// With more than 8 subpixel bits, doubles transform vertices. The product of the matrices is computed with
// twice as many bits, and its elements and o are rounded once. With L for the longer row of x w and y w,
// and in units of 2^-53:
//   first three terms of x w: d, coefficient, product, three sums   6 L D
//   fourth: coefficient, sum                                        2 side w
//   the same of w, times |x|                                        6 |x| Lw D + 2 |x| w
//   1 / w, and product with it                                      2 |x| w
// So for a vertex in view of an unscaled instance whose origin is at most 2^24 D away from o,
//   |error of x, y| < 2^-50 ((L + side Lw) D / w + side) px
// and in the guard band with 2^15 px in place of `side`. There D / w is below 1 + 2^15.1 / f in a usual
// perspective, and L < f + 2^13. So the error is under 2^-17 px for 1/4 px < f < 2^32 px, as it is in a
// parallel projection for L D / w < 2^32 px.
//
// A vertex that planes cut off is interpolated in double too. Each of up to six planes adds 5 L D, for the D
// of the farthest corner: a new vertex lies on an edge whose error is below
//   2^-47 (L + 2^14 Lw) D / w px
// That is under 2^-17 px while D < 2^15 w in an image of less than 2^13 px with f < 2^14 px. Along its edge,
// a new vertex is where the rounded distances from the plane place it.
inline constexpr double kPositionError = 0x1p-19;
inline constexpr double kFinePositionError = 0x1p-50;

}  // namespace contract

}  // namespace edgewise
#pragma GCC visibility pop
