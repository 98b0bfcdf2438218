"""What frames show: points, depths, triangles, instances, attributes and boxes; beside slow computations."""
import numpy as np
import pytest

import edgewise
from support import ASPECT, CAMERA, MOVED, SIZE, in_pixels, scene, stream, triangles

WIDTH, HEIGHT = SIZE
CENTRES = np.stack(np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5), axis=-1)
K = [[90, 2, 45], [0, 110, 33], [0, 0, 1.0]]
TO_CAMERA = np.array([[0.8, 0, 0.6, 0.1], [0, 1, 0, -0.2], [-0.6, 0, 0.8, 4], [0, 0, 0, 1]])
TRIPLE = np.diag([3, 3, 3, 1.0])
VIEW = edgewise.look_at((1, 1, 4), (0, 0, 0))
PARALLEL = edgewise.Camera(VIEW, edgewise.orthographic(-2, 2, -1.5, 1.5, 0.5, 9))
# A camera, and what gives a point's distance from it along the view direction, in world units.
CAMERAS = {
    "perspective": (CAMERA, -CAMERA.view[2]),
    "to infinity": (edgewise.Camera(CAMERA.view, edgewise.perspective(0.8, ASPECT, 0.5)), -CAMERA.view[2]),
    "intrinsics": (edgewise.Camera(TO_CAMERA, edgewise.intrinsics(K, *SIZE, 0.5, 20)), TO_CAMERA[2]),
    "view in other units": (edgewise.Camera(TRIPLE @ CAMERA.view, edgewise.perspective(0.8, ASPECT, 0.3, 150)), -CAMERA.view[2]),
    "multiplied": (edgewise.Camera(np.eye(4), CAMERA.projection @ CAMERA.view), -CAMERA.view[2]),
    "parallel": (PARALLEL, -VIEW[2]),
    "parallel in other units": (edgewise.Camera(TRIPLE @ VIEW, 3 * edgewise.orthographic(-6, 6, -4.5, 4.5, -3, 27)), -VIEW[2]),
}


@pytest.mark.parametrize("name", CAMERAS)
def test_pixels_show_points_at_their_centre_and_depth(name):
    (camera, ahead), drawn = CAMERAS[name], scene()
    frame, to_clip = drawn.draw(camera, SIZE, ids=True), camera.projection @ camera.view
    seen, depth = frame.depth < edgewise.DEPTH_CLEAR, edgewise.depth01(frame.depth)
    assert seen.sum() > 500

    in_mesh = drawn.interpolate(frame, [mesh.positions for mesh in drawn.meshes], camera, threads=2)
    assert in_mesh.shape == (HEIGHT, WIDTH, 3) and np.array_equal(np.isnan(in_mesh).any(axis=-1), ~seen)
    to_world = np.array([matrix for _, matrix in drawn.instances])[drawn.instance_ids(frame)[seen]]
    points = np.einsum("pij,pj->pi", to_world[:, :3, :3], in_mesh[seen]) + to_world[:, :3, 3]
    pixels, z = in_pixels(to_clip, points)
    assert np.abs(pixels - CENTRES[seen]).max() < 1 / 64  # corners are snapped to 1/256 px
    assert np.allclose(z, depth[seen], atol=1e-2)

    metric = edgewise.metric_depth(frame, camera)
    assert metric.shape == (HEIGHT, WIDTH) and metric.dtype == np.float64 and np.array_equal(np.isinf(metric), ~seen)
    corners = np.concatenate([drawn.meshes[mesh].positions[drawn.meshes[mesh].triangles] @ matrix[:3, :3].T
                              for mesh, matrix in drawn.instances])[frame.payload[seen]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    facing = np.abs(normals @ ahead[:3]) / np.linalg.norm(normals, axis=1)  # snapping moves steep planes
    assert (np.abs(metric[seen] - points @ ahead[:3] - ahead[3]) * facing).max() < 0.01
    assert np.array_equal(edgewise.metric_depth(drawn.draw(camera, SIZE, depth_only=True), camera), metric)

    uv, distance = drawn.barycentrics(frame, camera, threads=2)
    assert uv.shape == (HEIGHT, WIDTH, 2) and uv.dtype == distance.dtype == np.float32
    assert not uv[~seen].any() and np.isinf(distance[~seen]).all()
    assert uv.min() >= 0 and (1 - uv[..., 0] - uv[..., 1]).min() >= 0
    unit = np.linalg.norm(to_clip[3, :3])
    assert np.allclose(distance[seen], (unit * metric if unit else depth)[seen], rtol=1e-6, atol=0 if unit else 1e-6)


def test_several_views_show_what_single_ones_do():
    drawn, cameras = scene(), [CAMERA, CAMERAS["intrinsics"][0], PARALLEL]
    frames, positions = drawn.draw(cameras, SIZE, ids=True, cull="back"), [mesh.positions for mesh in drawn.meshes]

    def queries(frame, camera):
        return [*drawn.barycentrics(frame, camera, cull="back"), edgewise.metric_depth(frame, camera), drawn.instance_ids(frame),
                drawn.interpolate(frame, positions, camera, cull="back"), drawn.amodal_masks(camera, SIZE, cull="back"),
                drawn.visible_fraction(frame, camera, cull="back"), drawn.pixels_per_triangle(frame),
                drawn.pixels_per_instance(frame), drawn.pixels_per_mesh(frame)]
    of_all = queries(frames, cameras)
    for i, camera in enumerate(cameras):
        for all_views, one in zip(of_all, queries(edgewise.Frame(frames.payload[i], frames.depth[i]), camera)):
            assert all_views.shape[0] == 3 and np.array_equal(all_views[i], one, equal_nan=one.dtype.kind == "f")


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
    first, frame = drawn.first_ids(), drawn.draw(CAMERA, SIZE, ids=True, cull="back")
    instances = drawn.instance_ids(frame)
    masks = drawn.amodal_masks(CAMERA, SIZE, cull="back", threads=2)
    fractions = drawn.visible_fraction(frame, CAMERA, cull="back")
    assert instances.shape == (HEIGHT, WIDTH) and instances.dtype == np.uint32
    assert masks.shape == (6, HEIGHT, WIDTH) and masks.dtype == bool and fractions.shape == (6,)
    for y, x in np.ndindex(HEIGHT, WIDTH):
        if frame.depth[y, x] == edgewise.DEPTH_CLEAR:
            assert instances[y, x] == edgewise.BACKGROUND_ID
        else:
            assert first[instances[y, x]] <= frame.payload[y, x] < first[instances[y, x] + 1]
    for i, (mesh, matrix) in enumerate(drawn.instances):
        alone, of = edgewise.Scene(), drawn.meshes[mesh]
        alone.add_instance(alone.add_mesh(of.positions, of.triangles), matrix)
        assert np.array_equal(masks[i], alone.draw(CAMERA, SIZE, cull="back").depth < edgewise.DEPTH_CLEAR)
        visible, whole = (instances == i).sum(), masks[i].sum()
        assert fractions[i] == (visible / whole if whole else 0) and masks[i][instances == i].all()
    assert fractions.max() < 1 and (fractions[[3, 5]] == 0).all() and (fractions[[0, 1, 2]] > 0).all()
    assert len(drawn.instances) == 6 and np.array_equal(drawn.draw(CAMERA, SIZE, ids=True, cull="back").payload, frame.payload)


@pytest.mark.parametrize("bits", [4, 12, 15])
def test_what_frames_of_other_subpixel_bits_show(bits):
    drawn, options = scene(), {"cull": "back", "subpixel_bits": bits}
    frame = drawn.draw(CAMERA, SIZE, ids=True, **options)
    assert frame.subpixel_bits == bits
    instances, masks = drawn.instance_ids(frame), drawn.amodal_masks(CAMERA, SIZE, **options)
    assert all(mask[instances == i].all() for i, mask in enumerate(masks))
    fractions = drawn.visible_fraction(frame, CAMERA, **options)
    assert np.array_equal(fractions, drawn.pixels_per_instance(frame) / masks.sum(axis=(1, 2)))
    points = drawn.interpolate(frame, [mesh.positions for mesh in drawn.meshes], CAMERA, **options)
    assert np.array_equal(np.isnan(points).all(axis=-1), frame.depth == edgewise.DEPTH_CLEAR)
    frame = stream().draw(ids=True, subpixel_bits=bits)
    uv, depth = stream().barycentrics(frame, subpixel_bits=bits)
    seen = frame.depth < edgewise.DEPTH_CLEAR
    assert uv.max() <= 1 and np.allclose(depth[seen], edgewise.depth01(frame.depth)[seen], atol=1e-6)


def test_without_instances():
    nothing = edgewise.Scene()
    frame = nothing.draw([CAMERA] * 2, SIZE, ids=True)
    assert (nothing.instance_ids(frame) == edgewise.BACKGROUND_ID).all()
    assert nothing.amodal_masks([CAMERA] * 2, SIZE).shape == (2, 0, HEIGHT, WIDTH)
    assert nothing.amodal_masks(CAMERA, SIZE).shape == (0, HEIGHT, WIDTH)
    assert nothing.visible_fraction(frame, [CAMERA] * 2).shape == (2, 0)
    assert np.isnan(nothing.interpolate(frame, [], [CAMERA] * 2)).all()


def test_an_attribute_has_any_shape_and_type():
    positions, indices, _ = triangles()
    drawn = edgewise.Scene(positions, indices)
    frame = drawn.draw(CAMERA, SIZE, ids=True)
    points = drawn.interpolate(frame, positions, CAMERA)
    assert points.shape == (HEIGHT, WIDTH, 3) and points.dtype == np.float32
    doubles = drawn.interpolate(frame, positions[:, 0].astype(float), CAMERA)
    assert doubles.dtype == np.float64 and np.allclose(doubles, points[..., 0], atol=1e-6, equal_nan=True)
    grid = np.stack([np.stack([positions, -positions], axis=-1)] * 2, axis=-1)
    assert np.array_equal(drawn.interpolate(frame, grid, CAMERA)[..., 1, 0], -points, equal_nan=True)
    integers = drawn.interpolate(frame, np.full((len(positions), 1), 7, np.uint8), CAMERA)
    assert set(np.unique(integers[~np.isnan(integers)])) == {7}


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
    drawn, of_stream = scene(), stream()
    frame, flat = drawn.draw(CAMERA, SIZE, ids=True), of_stream.draw(ids=True)
    for of, shown, count in ((drawn, frame, 140), (of_stream, flat, 40)):
        ids = shown.payload[shown.payload != edgewise.BACKGROUND_ID]
        assert np.array_equal(of.pixels_per_triangle(shown), np.bincount(ids, minlength=count))
    assert list(drawn.first_ids()) == [0, 60, 80, 140]
    a, b, c = instances = np.add.reduceat(drawn.pixels_per_triangle(frame), [0, 60, 80])
    assert np.array_equal(drawn.pixels_per_instance(frame), instances) and list(drawn.pixels_per_mesh(frame)) == [a + c, b]


def test_a_hidden_box_would_not_be_drawn():
    wall = edgewise.Scene([[-9, -9, 0], [-9, 9, 0], [9, 9, 0], [9, -9, 0]], [[0, 1, 2], [0, 2, 3]])
    camera = edgewise.Camera(edgewise.look_at((0, 0, 4), (0, 0, 0)), edgewise.perspective(1, ASPECT, 0.1, 50))
    frame = wall.draw(camera, SIZE)
    assert wall.visible((-1, -1, 1), (1, 1, 2), camera, frame) is True
    assert wall.visible((-1, -1, -2), (1, 1, -1), camera, frame) is False
    lows = np.array([[-1, -1, 1], [-1, -1, -2], [-1, -1, -1], [99, 0, 0.0]])
    seen = wall.visible(lows, lows + [2, 2, 1], camera, edgewise.Frame(None, frame.depth))
    assert seen.dtype == bool and list(seen) == [True, False, seen[2], False]


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
