"""The conventions, against matrices of pyrr: what is drawn lies where they say."""
import numpy as np
import pytest

import edgewise
from support import ASPECT, SIZE, in_pixels

FOV_Y = 50  # degrees
NEAR, FAR = 0.5, 20.0
EYES = [((0, 0, 5), (0, 0, 0), (0, 1, 0)), ((3, 2, -4), (0.3, 0, 0.1), (0.2, 1, 0)), ((-1, 5, 0.5), (0, 0, 0), (0, 0, -1))]
LEFT, RIGHT, BOTTOM, TOP = -2.5, 3.0, -1.5, 1.75


def pyrr_matrices(eye, target, up, parallel):
    matrix44 = pytest.importorskip("pyrr").matrix44  # of row vectors
    view = matrix44.create_look_at(np.array(eye, float), np.array(target, float), np.array(up, float)).T
    projection = (matrix44.create_orthogonal_projection(LEFT, RIGHT, BOTTOM, TOP, NEAR, FAR) if parallel else
                  matrix44.create_perspective_projection(FOV_Y, ASPECT, NEAR, FAR)).T
    return view, projection


def check_triangle(camera, corners, pixels, depth):
    """Draws a triangle, which must cover `pixels`, shape (3, 2), and have these depths in 0 ... 1 at them."""
    (x0, y0), (x1, y1), (x2, y2) = pixels
    twice_area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)  # positive: clockwise, since y points down
    order = [0, 1, 2] if twice_area > 0 else [0, 2, 1]
    ring = pixels[order]
    centres = np.stack(np.meshgrid(np.arange(SIZE[0]) + 0.5, np.arange(SIZE[1]) + 0.5), axis=-1)
    from_edges = []  # px, positive inside
    for p, q in zip(ring, np.roll(ring, -1, axis=0)):
        along = (q - p) / np.linalg.norm(q - p)
        from_edges.append(along[0] * (centres[..., 1] - p[1]) - along[1] * (centres[..., 0] - p[0]))
    inside = np.min(from_edges, axis=0)

    ids, depths = edgewise.draw(corners, [[0, 1, 2]], camera, SIZE)
    drawn = ids == 0
    assert drawn[inside > 1 / 64].all() and not drawn[inside < -1 / 64].any()
    assert (ids[~drawn] == edgewise.BACKGROUND_ID).all() and (depths[~drawn] == edgewise.DEPTH_CLEAR).all()
    plane = np.linalg.solve(np.column_stack([pixels, np.ones(3)]), depth)  # depth is linear on the screen
    expected = centres @ plane[:2] + plane[2]
    slope = np.abs(plane[:2]).sum()  # vertices are snapped
    assert np.allclose(edgewise.depth01(depths)[drawn], expected[drawn], rtol=0, atol=1e-6 + slope / 128)

    front = edgewise.draw(corners, [[0, 1, 2]], camera, SIZE, cull="back").payload == 0
    assert np.array_equal(front, drawn if twice_area > 0 else np.zeros_like(drawn))
    return drawn.sum()


@pytest.mark.parametrize("parallel", [False, True])
@pytest.mark.parametrize("eye", EYES)
def test_triangles_lie_where_pyrrs_matrices_say(eye, parallel):
    view, projection = pyrr_matrices(*eye, parallel)
    camera = edgewise.Camera(view, edgewise.projection_from(projection, z_from_minus_w=True))
    random = np.random.default_rng(7)
    pixels_drawn = 0
    for corners in random.uniform(-1, 1, (20, 3, 3)).astype(np.float32):
        pixels, z = in_pixels(projection @ view, corners.astype(float))
        assert (np.abs(z) < 1).all()
        pixels_drawn += check_triangle(camera, corners, pixels, (z + 1) / 2)
    assert pixels_drawn > 500


@pytest.mark.parametrize("eye", EYES)
def test_helpers_give_pyrrs_matrices(eye):
    view, projection = pyrr_matrices(*eye, False)
    assert np.allclose(edgewise.look_at(*eye), view, rtol=0, atol=1e-14)
    for of_peer, ours in ((projection, edgewise.perspective(np.radians(FOV_Y), ASPECT, NEAR, FAR)),
                          (pyrr_matrices(*eye, True)[1], edgewise.orthographic(LEFT, RIGHT, BOTTOM, TOP, NEAR, FAR))):
        assert np.allclose(edgewise.projection_from(of_peer, z_from_minus_w=True), ours, rtol=1e-14, atol=1e-16)


@pytest.mark.parametrize("first_centre", [0.0, 0.5])
def test_intrinsics_put_a_point_at_k_times_its_coordinates(first_centre):
    k = np.array([[90, 2, 45], [0, 110, 33], [0, 0, 1.0]])
    world_to_camera = np.array([[0.8, 0, 0.6, 0.1], [0, 1, 0, -0.2], [-0.6, 0, 0.8, 4], [0, 0, 0, 1]])
    camera = edgewise.Camera(world_to_camera, edgewise.intrinsics(k, *SIZE, NEAR, FAR, first_centre=first_centre))
    random = np.random.default_rng(8)
    for corners in random.uniform(-1, 1, (20, 3, 3)).astype(np.float32):
        seen = corners @ world_to_camera[:3, :3].T + world_to_camera[:3, 3]
        image = seen @ k.T
        pixels = image[:, :2] / image[:, 2:] + (0.5 - first_centre)
        check_triangle(camera, corners, pixels, FAR / (FAR - NEAR) * (1 - NEAR / seen[:, 2]))


def test_a_view_needs_a_direction():
    for eye, target, up in (((1, 1, 1), (1, 1, 1), (0, 1, 0)), ((0, 2, 0), (0, 0, 0), (0, 1, 0)), ((np.nan, 0, 0), (1, 1, 1), (0, 1, 0)),
                            ((0.1, 0.2, 0.3), (0, 0, 0), (0.3, 0.6, 0.9))):
        with pytest.raises(ValueError, match="direction"):
            edgewise.look_at(eye, target, up)
