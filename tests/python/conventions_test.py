"""The conventions of matrices, against those of pyrr and of K. frames_test.py tests that pixels lie where the matrices say."""
import numpy as np
import pytest

import edgewise
from support import ASPECT, SIZE, in_pixels

FOV_Y = 50  # degrees
NEAR, FAR = 0.5, 20.0
EYES = [((0, 0, 5), (0, 0, 0), (0, 1, 0)), ((3, 2, -4), (0.3, 0, 0.1), (0.2, 1, 0)), ((-1, 5, 0.5), (0, 0, 0), (0, 0, -1))]
LEFT, RIGHT, BOTTOM, TOP = -2.5, 3.0, -1.5, 1.75


@pytest.mark.parametrize("eye", EYES)
def test_helpers_give_pyrrs_matrices(eye):
    matrix44 = pytest.importorskip("pyrr").matrix44  # of row vectors
    view = matrix44.create_look_at(*(np.array(part, float) for part in eye)).T
    assert np.allclose(edgewise.look_at(*eye), view, rtol=0, atol=1e-14)
    for theirs, ours in (
            (matrix44.create_perspective_projection(FOV_Y, ASPECT, NEAR, FAR), edgewise.perspective(np.radians(FOV_Y), ASPECT, NEAR, FAR)),
            (matrix44.create_orthogonal_projection(LEFT, RIGHT, BOTTOM, TOP, NEAR, FAR),
             edgewise.orthographic(LEFT, RIGHT, BOTTOM, TOP, NEAR, FAR))):
        assert np.allclose(edgewise.projection_from(theirs.T, z_from_minus_w=True), ours, rtol=1e-14, atol=1e-16)


@pytest.mark.parametrize("first_centre", [0.0, 0.5])
def test_intrinsics_put_a_point_at_k_times_its_coordinates(first_centre):
    k = np.array([[90, 2, 45], [0, 110, 33], [0, 0, 1.0]])
    points = np.random.default_rng(8).uniform((-1, -1, 3), (1, 1, 5), (60, 3))
    pixels, depth = in_pixels(edgewise.intrinsics(k, *SIZE, NEAR, FAR, first_centre=first_centre), points)
    image = points @ k.T
    assert np.allclose(pixels, image[:, :2] / image[:, 2:] + (0.5 - first_centre), atol=1e-9)
    assert np.allclose(depth, FAR / (FAR - NEAR) * (1 - NEAR / points[:, 2]), atol=1e-12)


def test_a_view_needs_a_direction():
    for eye, target, up in (((1, 1, 1), (1, 1, 1), (0, 1, 0)), ((0, 2, 0), (0, 0, 0), (0, 1, 0)), ((np.nan, 0, 0), (1, 1, 1), (0, 1, 0)),
                            ((0.1, 0.2, 0.3), (0, 0, 0), (0.3, 0.6, 0.9))):
        with pytest.raises(ValueError, match="direction"):
            edgewise.look_at(eye, target, up)
