"""What frames show of instances, in world units, and of attributes; beside slow computations, pixel by pixel."""
import numpy as np
import pytest

import edgewise
from support import ASPECT, CAMERA, MOVED, SIZE, in_pixels, scene, stream, triangles

WIDTH, HEIGHT = SIZE
K = [[90, 2, 45], [0, 110, 33], [0, 0, 1.0]]
TO_CAMERA = np.array([[0.8, 0, 0.6, 0.1], [0, 1, 0, -0.2], [-0.6, 0, 0.8, 4], [0, 0, 0, 1]])
SCALED = edgewise.Camera(np.diag([3, 3, 3, 1.0]) @ CAMERA.view, edgewise.perspective(0.8, ASPECT, 0.3, 150))
CAMERAS = {
    "perspective": CAMERA,
    "to infinity": edgewise.Camera(CAMERA.view, edgewise.perspective(0.8, ASPECT, 0.5)),
    "intrinsics": edgewise.Camera(TO_CAMERA, edgewise.intrinsics(K, *SIZE, 0.5, 20)),
    "view in other units": SCALED,
    "multiplied": edgewise.Camera(np.eye(4), CAMERA.projection @ CAMERA.view),
    "parallel": edgewise.Camera(edgewise.look_at((1, 1, 4), (0, 0, 0)), edgewise.orthographic(-2, 2, -1.5, 1.5, 0.5, 9)),
    "parallel in other units": edgewise.Camera(np.diag([3, 3, 3, 1.0]) @ edgewise.look_at((1, 1, 4), (0, 0, 0)),
                                               3 * edgewise.orthographic(-6, 6, -4.5, 4.5, -3, 27)),
}
# The camera's position, and its direction, in the world.
EYES = {"intrinsics": (np.linalg.inv(TO_CAMERA)[:3, 3], TO_CAMERA[2, :3])}


def eye_of(name):
    camera = CAMERAS["perspective" if name == "multiplied" else name]
    inverse = np.linalg.inv(camera.view)
    return EYES.get(name, (inverse[:3, 3], -camera.view[2, :3] / np.linalg.norm(camera.view[2, :3])))


def corners_by_id(drawn):
    """World-space corners of a scene's triangles, shape (n, 3, 3)."""
    corners = [drawn.meshes[mesh].positions.astype(float)[drawn.meshes[mesh].triangles] @ matrix[:3, :3].T + matrix[:3, 3]
               for mesh, matrix in drawn.instances]
    return np.concatenate(corners)


def weights_at(camera, corners, x, y):
    """The barycentric coordinates of the point of a triangle that a pixel's centre shows, by a 4 x 4 system in clip space."""
    clip = np.column_stack([corners, np.ones(3)]) @ (camera.projection @ camera.view).T
    ndc = 2 * (x + 0.5) / WIDTH - 1, 1 - 2 * (y + 0.5) / HEIGHT
    # sum of weights 1; x - ndc_x w = 0; y - ndc_y w = 0
    system = np.array([np.ones(3), clip[:, 0] - ndc[0] * clip[:, 3], clip[:, 1] - ndc[1] * clip[:, 3]])
    return np.linalg.solve(system, [1, 0, 0])


def shown(frame, step=7):
    """Some pixels that a frame shows, (y, x)."""
    return np.argwhere(frame.depth < edgewise.DEPTH_CLEAR)[::step]


@pytest.mark.parametrize("name", CAMERAS)
def test_metric_depth_is_the_distance_along_the_view_direction(name):
    camera, drawn = CAMERAS[name], scene()
    eye, direction = eye_of(name)
    frame, corners = drawn.draw(camera, SIZE, ids=True), corners_by_id(drawn)
    depth = edgewise.metric_depth(frame, camera)
    assert depth.shape == (HEIGHT, WIDTH) and depth.dtype == np.float64
    assert np.array_equal(np.isinf(depth), frame.depth == edgewise.DEPTH_CLEAR)
    errors = []
    for y, x in shown(frame):
        triangle = corners[frame.payload[y, x]]
        point = weights_at(camera, triangle, x, y) @ triangle
        normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
        facing = abs(normal @ direction) / np.linalg.norm(normal)
        errors.append(abs(depth[y, x] - (point - eye) @ direction) * facing)  # vertices are snapped, which moves steep planes
    assert len(errors) > 100 and max(errors) < 0.01
    frame_of_depth = drawn.draw(camera, SIZE, depth_only=True)
    assert np.array_equal(edgewise.metric_depth(frame_of_depth, camera), depth)


def test_metric_depth_is_the_distance_of_barycentrics():
    drawn, cameras = scene(), [CAMERAS[name] for name in ("perspective", "to infinity", "intrinsics")]
    frames = drawn.draw(cameras, SIZE, ids=True)
    uv, distance = drawn.barycentrics(frames, cameras, threads=2)
    assert uv.shape == (3, HEIGHT, WIDTH, 2) and distance.shape == (3, HEIGHT, WIDTH)
    assert np.allclose(edgewise.metric_depth(frames, cameras), distance, rtol=1e-6)
    for i, camera in enumerate(cameras):
        alone = drawn.barycentrics(edgewise.Frame(frames.payload[i], frames.depth[i]), camera)
        assert np.array_equal(alone[0], uv[i]) and np.array_equal(alone[1], distance[i])


def test_metric_depth_far_from_the_worlds_origin():
    far = np.eye(4)
    far[:3, 3] = -4.7e6, 3e5, 4.2e6
    camera = edgewise.Camera(CAMERA.view @ far, CAMERA.projection)
    depth = edgewise.metric_depth(scene().draw(CAMERA, SIZE), CAMERA)
    assert np.array_equal(edgewise.metric_depth(scene().draw(CAMERA, SIZE), camera), depth)


def test_instance_ids_and_masks():
    drawn = scene()
    drawn.add_instance(drawn.add_mesh(np.empty((0, 3)), np.empty((0, 3), np.uint32)))  # no triangle has its number
    drawn.add_instance(1, np.linalg.inv(MOVED))
    drawn.add_instance(0, [[1, 0, 0, 99], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])  # out of view
    first = drawn.first_ids()
    cameras = [CAMERAS["perspective"], CAMERAS["parallel"]]
    frames = drawn.draw(cameras, SIZE, ids=True, cull="back")
    instances = drawn.instance_ids(frames)
    masks = drawn.amodal_masks(cameras, SIZE, cull="back", threads=2)
    fractions = drawn.visible_fraction(frames, cameras, cull="back")
    assert instances.shape == (2, HEIGHT, WIDTH) and instances.dtype == np.uint32
    assert masks.shape == (2, 6, HEIGHT, WIDTH) and masks.dtype == bool and fractions.shape == (2, 6)
    for v, camera in enumerate(cameras):
        for y, x in np.ndindex(HEIGHT, WIDTH):
            if frames.depth[v, y, x] == edgewise.DEPTH_CLEAR:
                assert instances[v, y, x] == edgewise.BACKGROUND_ID
            else:
                assert first[instances[v, y, x]] <= frames.payload[v, y, x] < first[instances[v, y, x] + 1]
        for i, (mesh, matrix) in enumerate(drawn.instances):
            alone, of = edgewise.Scene(), drawn.meshes[mesh]
            alone.add_instance(alone.add_mesh(of.positions, of.triangles), matrix)
            assert np.array_equal(masks[v, i], alone.draw(camera, SIZE, cull="back").depth < edgewise.DEPTH_CLEAR)
            visible, whole = (instances[v] == i).sum(), masks[v, i].sum()
            assert fractions[v, i] == (visible / whole if whole else 0)
            assert masks[v, i][instances[v] == i].all()
        one = edgewise.Frame(frames.payload[v], frames.depth[v])
        assert np.array_equal(drawn.instance_ids(one), instances[v])
        assert np.array_equal(drawn.amodal_masks(camera, SIZE, cull="back"), masks[v])
        assert np.array_equal(drawn.visible_fraction(one, camera, cull="back"), fractions[v])
    assert fractions[0].max() < 1 and (fractions[:, [3, 5]] == 0).all() and (fractions[:, [0, 1, 2]] > 0).all()
    assert len(drawn.instances) == 6 and np.array_equal(drawn.draw(cameras, SIZE, ids=True, cull="back").payload, frames.payload)


def test_the_only_instance_is_wholly_visible():
    positions, indices, _ = triangles()
    drawn = edgewise.Scene(positions, indices)
    frame = drawn.draw(CAMERA, SIZE, ids=True)
    assert list(drawn.visible_fraction(frame, CAMERA)) == [1]


def test_without_instances():
    nothing = edgewise.Scene()
    frame = nothing.draw([CAMERA] * 2, SIZE, ids=True)
    assert (nothing.instance_ids(frame) == edgewise.BACKGROUND_ID).all()
    assert nothing.amodal_masks([CAMERA] * 2, SIZE).shape == (2, 0, HEIGHT, WIDTH)
    assert nothing.amodal_masks(CAMERA, SIZE).shape == (0, HEIGHT, WIDTH)
    assert nothing.visible_fraction(frame, [CAMERA] * 2).shape == (2, 0)
    assert np.isnan(nothing.interpolate(frame, [], [CAMERA] * 2)).all()


@pytest.mark.parametrize("name", ["perspective", "parallel"])
def test_interpolation_is_perspective_correct(name):
    camera, drawn = CAMERAS[name], scene()
    random = np.random.default_rng(11)
    attributes = [random.uniform(-1, 1, (len(mesh.positions), 3)) for mesh in drawn.meshes]
    frame, corners = drawn.draw(camera, SIZE, ids=True), corners_by_id(drawn)
    values = drawn.interpolate(frame, attributes, camera, threads=2)
    assert values.shape == (HEIGHT, WIDTH, 3) and values.dtype == np.float64
    assert np.array_equal(np.isnan(values).any(axis=-1), frame.depth == edgewise.DEPTH_CLEAR)
    by_id = np.concatenate([attributes[mesh][drawn.meshes[mesh].triangles] for mesh, _ in drawn.instances])
    for y, x in shown(frame):
        triangle = frame.payload[y, x]
        weights = weights_at(camera, corners[triangle], x, y)
        size = np.ptp(in_pixels(camera.projection @ camera.view, corners[triangle], SIZE)[0], axis=0)
        if weights.min() > 0 and size.min() > 8:  # vertices are snapped
            assert np.allclose(values[y, x], weights @ by_id[triangle], atol=0.02)
    single = [a.astype(np.float32)[:, 0] for a in attributes]
    assert drawn.interpolate(frame, single, camera).dtype == np.float32
    assert np.allclose(drawn.interpolate(frame, single, camera), values[..., 0], atol=1e-6, equal_nan=True)


def test_interpolated_positions_are_the_points_seen():
    positions, indices, _ = triangles()
    drawn = edgewise.Scene(positions, indices)
    cameras = [CAMERAS["perspective"], CAMERAS["intrinsics"]]
    frames = drawn.draw(cameras, SIZE, ids=True)
    points = drawn.interpolate(frames, positions, cameras)
    assert points.shape == (2, HEIGHT, WIDTH, 3) and points.dtype == np.float32
    for camera, view, depth in zip(cameras, points, frames.depth):
        seen = depth < edgewise.DEPTH_CLEAR
        pixels, _ = in_pixels(camera.projection @ camera.view, view[seen].astype(float))
        assert np.abs(pixels - np.argwhere(seen)[:, ::-1] - 0.5).max() < 1 / 64
    grid = np.stack([np.stack([positions, -positions], axis=-1)] * 2, axis=-1)  # an attribute may be an array
    assert np.array_equal(drawn.interpolate(frames, grid, cameras)[..., 1, 0], -points, equal_nan=True)
    integers = drawn.interpolate(frames, np.full((len(positions), 1), 7, np.uint8), cameras)
    assert set(np.unique(integers[~np.isnan(integers)])) == {7}


def test_a_notebook_shows_frames(tmp_path):
    def shown_as(frame):
        (tmp_path / "a.png").write_bytes(frame._repr_png_())
        return edgewise.read_image(tmp_path / "a.png")
    drawn = scene()
    colours, ids = drawn.draw(CAMERA, SIZE), drawn.draw(CAMERA, SIZE, ids=True)
    for made in (colours, edgewise.Frame(*colours)):
        assert np.array_equal(shown_as(made), colours.payload)
    for made in (ids, edgewise.Frame(*ids), drawn.draw(CAMERA, SIZE, ids=True, background=7)):
        assert np.array_equal(shown_as(made), edgewise.id_colours(made.payload))
    views = drawn.draw([CAMERA] * 3, SIZE)
    assert np.array_equal(shown_as(views), np.concatenate([colours.payload] * 3))
    transparent = edgewise.Stream(stream().vertices, SIZE, colours=stream().colours & np.uint32(0xFFFFFF)).draw()
    assert np.array_equal(shown_as(transparent), transparent.payload | np.uint32(edgewise.BLACK))
    assert drawn.draw(CAMERA, SIZE, depth_only=True)._repr_png_() is None and drawn.draw([], SIZE)._repr_png_() is None
