"""What a frame shows: barycentrics, visible triangles, pixels, boxes."""
import numpy as np
import pytest

import edgewise
from support import ASPECT, CAMERA, MOVED, SIZE, in_pixels, scene, stream, triangles

WIDTH, HEIGHT = SIZE
CENTRES = np.stack(np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5), axis=-1)
PARALLEL = edgewise.Camera(edgewise.look_at((1, 1, 4), (0, 0, 0)), edgewise.orthographic(-2, 2, -1.5, 1.5, 0.5, 9))
MATRICES = (np.eye(4), MOVED, np.diag([0.5, -0.5, 0.5, 1]))


def corners_by_id():
    """World-space corners of scene()'s triangles, shape (140, 3, 3)."""
    (a, a_indices, _), (b, b_indices, _) = triangles(60, 1), triangles(20, 2)
    meshes = a[a_indices], b[b_indices], a[a_indices]
    return np.concatenate([corners.astype(float) @ m[:3, :3].T + m[:3, 3] for corners, m in zip(meshes, MATRICES)])


def interpolated(uv, values):
    u, v = np.moveaxis(uv.astype(float), -1, 0)
    return sum(w[:, None] * values[:, i] for i, w in enumerate((1 - u - v, u, v)))


@pytest.mark.parametrize("camera", [CAMERA, PARALLEL], ids=["perspective", "parallel"])
def test_interpolated_positions_lie_at_the_pixels_centre(camera):
    frame = scene().draw(camera, SIZE, ids=True)
    uv, distance = scene().barycentrics(frame, camera, threads=2)
    assert uv.shape == (HEIGHT, WIDTH, 2) and uv.dtype == distance.dtype == np.float32
    drawn = frame.depth < edgewise.DEPTH_CLEAR
    assert drawn.any() and not uv[~drawn].any() and np.isinf(distance[~drawn]).all()
    u, v = np.moveaxis(uv[drawn], -1, 0)
    assert (u >= 0).all() and (v >= 0).all() and (1 - u - v >= 0).all()
    points = interpolated(uv[drawn], corners_by_id()[frame.payload[drawn]])
    pixels, z = in_pixels(camera.projection @ camera.view, points)
    assert np.abs(pixels - CENTRES[drawn]).max() < 1 / 64  # corners are snapped to 1/256 px
    if camera is CAMERA:
        ahead = -(points @ camera.view[2, :3] + camera.view[2, 3])
        assert np.allclose(distance[drawn], ahead, rtol=1e-4)
    else:
        assert np.allclose(distance[drawn], edgewise.depth01(frame.depth)[drawn], atol=1e-6)
    assert np.allclose(z, edgewise.depth01(frame.depth)[drawn], atol=1e-2)


def test_barycentrics_of_a_stream():
    drawn = stream()
    frame = drawn.draw(ids=True)
    uv, depth = drawn.barycentrics(frame)
    seen = frame.depth < edgewise.DEPTH_CLEAR
    assert np.allclose(depth[seen], edgewise.depth01(frame.depth)[seen], atol=1e-6)
    assert uv[seen].max() <= 1


def test_visible_triangles_are_the_unique_ids():
    cameras = [CAMERA, PARALLEL, edgewise.Camera(edgewise.look_at((0, 0, 40), (0, 0, 50)), CAMERA.projection)]
    frame = scene().draw(cameras, SIZE, ids=True)
    flat, offsets = edgewise.visible_triangles(frame)
    assert flat.dtype == np.uint32 and list(offsets[:1]) == [0] and offsets[-1] == len(flat)
    for i, view in enumerate(frame.payload):
        unique = np.unique(view[view != edgewise.BACKGROUND_ID])
        assert np.array_equal(flat[offsets[i]:offsets[i + 1]], unique)
    assert offsets[3] == offsets[2]  # nothing is behind the scene
    one, of_one = edgewise.visible_triangles(edgewise.Frame(frame.payload[0], frame.depth[0]))
    assert np.array_equal(one, flat[:offsets[1]]) and list(of_one) == [0, offsets[1]]


def test_pixels_of_triangles_instances_and_meshes():
    drawn = scene()
    assert list(drawn.first_ids()) == [0, 60, 80, 140]
    frame = drawn.draw([CAMERA, PARALLEL], SIZE, ids=True)
    counts = drawn.pixels_per_triangle(frame)
    assert counts.shape == (2, 140)
    for view, of_view in zip(frame.payload, counts):
        assert np.array_equal(np.bincount(view[view != edgewise.BACKGROUND_ID], minlength=140), of_view)
    instances = np.add.reduceat(counts, [0, 60, 80], axis=1)
    assert np.array_equal(drawn.pixels_per_instance(frame), instances)
    assert np.array_equal(drawn.pixels_per_mesh(frame), np.stack([instances[:, 0] + instances[:, 2], instances[:, 1]], axis=1))
    one = edgewise.Frame(frame.payload[0], frame.depth[0])
    assert np.array_equal(drawn.pixels_per_instance(one), instances[0])
    of_stream = stream()
    ids = of_stream.draw(ids=True)
    assert of_stream.pixels_per_triangle(ids).sum() == (ids.payload != edgewise.BACKGROUND_ID).sum()


def test_a_hidden_box_would_not_be_drawn():
    wall = edgewise.Scene([[-9, -9, 0], [-9, 9, 0], [9, 9, 0], [9, -9, 0]], [[0, 1, 2], [0, 2, 3]])
    camera = edgewise.Camera(edgewise.look_at((0, 0, 4), (0, 0, 0)), edgewise.perspective(1, ASPECT, 0.1, 50))
    frame = wall.draw(camera, SIZE)
    assert wall.visible((-1, -1, 1), (1, 1, 2), camera, frame) is True
    assert wall.visible((-1, -1, -2), (1, 1, -1), camera, frame) is False
    lows = np.array([[-1, -1, 1], [-1, -1, -2], [-1, -1, -1], [99, 0, 0.0]])
    seen = wall.visible(lows, lows + [2, 2, 1], camera, edgewise.Frame(None, frame.depth))
    assert seen.dtype == bool and list(seen) == [True, False, seen[2], False]


def test_depth01_reaches_from_near_to_background():
    depth = np.array([0, edgewise.DEPTH_CLEAR, 128], np.uint32)
    assert list(edgewise.depth01(depth)) == [0, 1, 0]
