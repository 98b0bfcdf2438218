"""Identities of draws, and what they take and give."""
import pickle
import threading
import time

import numpy as np
import pytest

import edgewise
from support import ASPECT, CAMERA, MOVED, SIZE, same, scene, stream, triangles

CAMERAS = [CAMERA, edgewise.Camera(edgewise.look_at((-3, 1, 2), (0, 0, 0)), edgewise.perspective(1.1, ASPECT, 0.2)),
           edgewise.Camera(edgewise.look_at((0, 0, 3), (0, 0, 0)), edgewise.orthographic(-2, 2, -1, 1, 0, 9))]
WIDTH, HEIGHT = SIZE
SCISSOR = (11, 7, 50, 31)


def part(plane, rectangle=SCISSOR):
    x, y, width, height = rectangle
    return plane[y:y + height, x:x + width]


@pytest.mark.parametrize("draw", [lambda **options: scene().draw(CAMERA, SIZE, **options), lambda **options: stream().draw(**options)])
def test_every_number_of_subpixel_bits_has_a_picture_of_its_own(draw):
    frames = [[draw(subpixel_bits=bits, backend=backend, threads=threads)
               for backend in (*edgewise.BACKENDS, "tiles+spans") for threads in (1, 3)] for bits in range(4, 16)]
    hashes = [{edgewise.pixel_hash(frame) for frame in of_bits} for of_bits in frames]
    assert all(len(of_bits) == 1 for of_bits in hashes) and len(set.union(*hashes)) == len(hashes)
    assert hashes[4] == {edgewise.pixel_hash(draw())}


def test_several_views_are_single_views():
    drawn = scene()
    frames = drawn.draw(CAMERAS, SIZE, ids=True)
    assert frames.payload.shape == frames.depth.shape == (3, HEIGHT, WIDTH)
    for i, camera in enumerate(CAMERAS):
        assert same((frames.payload[i], frames.depth[i]), drawn.draw(camera, SIZE, ids=True))
    assert drawn.draw([], SIZE).depth.shape == (0, HEIGHT, WIDTH)
    assert drawn.draw(CAMERAS[:1], SIZE).depth.shape == (1, HEIGHT, WIDTH)


def test_one_call_is_a_scene():
    positions, indices, _ = triangles()
    frame = edgewise.draw(positions, indices, CAMERA, SIZE, threads=2)
    ids, depth = frame
    assert same(frame, edgewise.Scene(positions, indices).draw(CAMERA, SIZE, ids=True))
    assert ids.dtype == depth.dtype == np.uint32 and ids.shape == depth.shape == (HEIGHT, WIDTH)
    assert ((ids == edgewise.BACKGROUND_ID) == (depth == edgewise.DEPTH_CLEAR)).all()


def test_a_mesh_of_doubles_far_from_0_is_drawn_as_one_near_0():
    near, indices, _ = triangles()
    place = np.array([-2487002.881739342, -4684683.676570751, 3529638.9835389843])
    far = place + 0.01 * near.astype(np.float64)

    def shown(positions, at, moved=None):
        drawn = edgewise.Scene(positions, indices)
        if moved is not None:
            drawn.set_positions(0, moved)
        camera = edgewise.Camera(edgewise.look_at(at + [0.01, 0.01, 0.04], at), edgewise.perspective(0.8, ASPECT, 1e-3, 1))
        return drawn.draw(camera, SIZE, ids=True).payload
    expected = shown((far - place).astype(np.float32), np.zeros(3))
    assert (expected != edgewise.BACKGROUND_ID).sum() > 700
    for ids in (shown(far, place), shown(far[::-1], place, far)):
        assert (ids != expected).mean() < 0.002  # by the rounding of the camera and the points
    assert (shown(far.astype(np.float32), place) != expected).mean() > 0.1


def test_stats_count_what_is_dropped():
    positions, indices, _ = triangles()
    positions[0], positions[7] = np.nan, np.inf
    drawn = edgewise.Scene(positions, indices)
    frame = drawn.draw(CAMERA, SIZE)
    assert frame.stats.not_finite == 2 and frame.stats.triangles == 60 and frame.stats.meshes == 1
    assert drawn.draw(CAMERAS, SIZE, ids=True).stats.triangles == 3 * 60
    onto = drawn.draw(CAMERA, SIZE, onto=frame, cull="both")
    assert onto.payload is frame.payload and onto.stats.culled > 0 and frame.stats.culled == 0
    assert stream().draw().stats.emitted > 0
    assert edgewise.Frame(*frame).stats is None
    restored = pickle.loads(pickle.dumps(frame))
    assert same(restored, frame) and (restored.stats, restored.has_ids) == (frame.stats, False) and type(restored) is edgewise.Frame
    huge = positions.astype(np.float64)
    huge[3] = 1e39
    assert edgewise.Scene(huge, indices).draw(CAMERA, SIZE).stats.not_finite == 3


def test_draws_add_up():
    (a, a_indices, a_colours), (b, b_indices, b_colours) = triangles(50, 1), triangles(50, 2)
    first, second = edgewise.Scene(a, a_indices, colours=a_colours), edgewise.Scene(b, b_indices, colours=b_colours)
    both = edgewise.Scene(a, a_indices, colours=a_colours)
    both.add_instance(both.add_mesh(b, b_indices, colours=b_colours))
    for ids in (False, True):
        stack = first.draw(CAMERAS, SIZE, ids=ids)
        second.draw(CAMERAS, SIZE, ids=ids, first_id=50, onto=stack, threads=2)
        assert same(stack, both.draw(CAMERAS, SIZE, ids=ids))
    alone = second.draw(CAMERA, SIZE, ids=True, first_id=50)
    for values, of_first in zip(second.barycentrics(alone, CAMERA, first_id=50),
                                second.barycentrics(second.draw(CAMERA, SIZE, ids=True), CAMERA)):
        assert np.array_equal(values, of_first)


def test_what_is_drawn_onto_is_returned_and_may_be_cleared():
    drawn = scene()
    frame = drawn.draw(CAMERAS[1], SIZE)
    result = drawn.draw(CAMERA, SIZE, onto=frame, clear=True, background=7)
    assert result.payload is frame.payload and result.depth is frame.depth
    assert same(frame, drawn.draw(CAMERA, SIZE, background=7))
    assert (frame.payload[frame.depth == edgewise.DEPTH_CLEAR] == 7).all()


def test_a_scissor_is_a_crop():
    drawn = scene()
    other = drawn.draw(CAMERAS[1], SIZE)
    for frame, options in ((drawn.draw(CAMERA, SIZE, background=5, cull="both"), {"background": 5}),
                           (other, {"onto": edgewise.Frame(other.payload.copy(), other.depth.copy()), "clear": True})):
        for plane, of_whole in zip(frame, drawn.draw(CAMERA, SIZE, background=options.get("background"))):
            part(plane)[:] = part(of_whole)
        assert same(drawn.draw(CAMERA, SIZE, scissor=SCISSOR, **options), frame)
    assert (drawn.draw(CAMERA, SIZE, scissor=(200, 0, 5, 5)).depth == edgewise.DEPTH_CLEAR).all()


@pytest.mark.parametrize("backend", edgewise.BACKENDS)
def test_depth_only(backend):
    drawn = scene()
    whole = drawn.draw(CAMERA, SIZE)
    frame = drawn.draw(CAMERA, SIZE, depth_only=True, backend=backend)
    assert frame.payload is None and np.array_equal(frame.depth, whole.depth)
    into = edgewise.Frame(np.full((HEIGHT, WIDTH), 3, np.uint32), np.empty((HEIGHT, WIDTH), np.uint32))
    drawn.draw(CAMERA, SIZE, onto=into, clear=True, depth_only=True, backend=backend)
    assert (into.payload == 3).all() and np.array_equal(into.depth, whole.depth)
    for onto in (whole, drawn.draw(CAMERA, SIZE, ids=True), into):
        assert drawn.draw(CAMERA, SIZE, onto=onto, depth_only=True).has_ids is onto.has_ids
    drawn.draw(CAMERA, SIZE, onto=edgewise.Frame(None, into.depth), backend=backend)
    assert np.array_equal(into.depth, whole.depth)


def test_planes_may_be_parts_of_larger_arrays():
    drawn = scene()
    payloads, depths = (np.full((2, HEIGHT + 9, WIDTH + 5), 1, np.uint32) for _ in range(2))
    into = edgewise.Frame(payloads[:, 4:4 + HEIGHT, 2:2 + WIDTH], depths[:, 4:4 + HEIGHT, 2:2 + WIDTH])
    drawn.draw(CAMERAS[:2], SIZE, onto=into, clear=True)
    assert same(into, drawn.draw(CAMERAS[:2], SIZE))
    for plane, inner in zip((payloads, depths), into):
        inner[:] = 1
        assert (plane == 1).all()
    assert same(drawn.draw(CAMERA, SIZE, onto=edgewise.Frame(into.payload[1], into.depth[1]), clear=True),
                drawn.draw(CAMERA, SIZE))


def test_inputs_need_not_be_contiguous_or_of_the_type():
    positions, indices, colours = triangles()
    positions = np.round(4 * positions)
    wide = np.zeros((len(positions), 5))
    wide[:, 4:1:-1] = positions
    expected = edgewise.Scene(positions, indices, colours=colours).draw(CAMERA, SIZE)
    r, g, b = (colours >> shift & 255 for shift in (0, 8, 16))
    for other in (edgewise.Scene(wide[:, 4:1:-1], np.asfortranarray(indices.astype(np.int64)), colours=colours.tolist()),
                  edgewise.Scene(positions.tolist(), indices.tolist(), colours=np.stack([r, g, b], -1).astype(np.uint8)),
                  *(edgewise.Scene(positions.astype(kind), indices.astype(">u2"), colours=colours)
                    for kind in (np.float16, ">f8", np.int8, np.int64))):
        assert same(other.draw(CAMERA, SIZE), expected)
    view = np.asfortranarray(CAMERA.view)
    assert same(edgewise.Scene(positions, indices, colours=colours).draw(edgewise.Camera(view, CAMERA.projection.tolist()), SIZE),
                expected)
    ids, depth = scene().draw(CAMERA, SIZE, ids=True)
    assert np.array_equal(edgewise.id_colours(ids.astype(np.int64)), edgewise.id_colours(ids))
    assert np.array_equal(edgewise.depth01(depth.astype(np.uint64)), edgewise.depth01(depth))


def test_a_scene_copies_its_input():
    positions, indices, colours = triangles()
    drawn = edgewise.Scene(positions, indices, colours=colours)
    before = drawn.draw(CAMERA, SIZE)
    positions[:] = 0
    indices[:] = 0
    colours[:] = 0
    assert same(drawn.draw(CAMERA, SIZE), before)


@pytest.mark.parametrize("count", [60, 1 << 16])  # many have clusters, whose boxes move
def test_instances_and_vertices_move_and_lights_turn(count):
    positions, indices, colours = triangles(count)
    moved, placed = edgewise.Scene(positions + np.float32([0, 0, 9]), indices, colours=colours), edgewise.Scene()
    moved.set_positions(0, positions)  # before the camera
    placed.add_instance(placed.add_mesh(positions, indices, colours=colours), MOVED)
    assert not same(moved.draw(CAMERA, SIZE), placed.draw(CAMERA, SIZE))
    moved.set_instance(0, MOVED)
    assert same(moved.draw(CAMERA, SIZE), placed.draw(CAMERA, SIZE))
    moved.add_instance(0)
    assert not same(moved.draw(CAMERA, SIZE), placed.draw(CAMERA, SIZE))
    moved.remove_instance(1)
    moved.set_light((-1, 0.25, 0.5))
    assert not np.array_equal(moved.draw(CAMERA, SIZE).payload, placed.draw(CAMERA, SIZE).payload)
    assert same(moved.draw(CAMERA, SIZE, shade=False), placed.draw(CAMERA, SIZE, shade=False))


def test_two_sided_triangles_are_not_culled():
    positions, indices, _ = triangles()
    one, two = (edgewise.Scene(positions, indices, two_sided=sides) for sides in (False, True))
    assert same(two.draw(CAMERA, SIZE, ids=True, cull="both"), one.draw(CAMERA, SIZE, ids=True))
    assert (one.draw(CAMERA, SIZE, cull="both").depth == edgewise.DEPTH_CLEAR).all()


def test_streams_are_drawn_as_their_size_says():
    drawn = stream()
    whole = drawn.draw()
    assert whole.depth.shape == (HEIGHT, WIDTH)
    assert all(same(whole, drawn.draw(backend=backend, threads=2)) for backend in edgewise.BACKENDS)
    assert same([plane[:30, :40] for plane in whole], drawn.draw((40, 30)))
    ids = drawn.draw(ids=True).payload
    assert set(np.unique(ids)) <= {*range(40), edgewise.BACKGROUND_ID} and (ids < 40).any()
    assert drawn.size == SIZE
    background = whole.depth == edgewise.DEPTH_CLEAR
    assert (drawn.draw(background=7).payload[background] == 7).all() and background.any()
    assert np.array_equal(drawn.draw(ids=True, first_id=5).payload[~background], ids[~background] + 5)
    both = [drawn.draw(cull=side) for side in ("back", "front")]
    assert all(not same(one, whole) for one in both) and same(drawn.draw(cull="back", onto=both[1]), whole)
    assert same(drawn.draw(cull="front", onto=both[0], clear=True), drawn.draw(cull="front"))
    depth = drawn.draw(scissor=SCISSOR, depth_only=True)
    assert depth.payload is None and np.array_equal(part(depth.depth), part(whole.depth))
    assert (depth.depth == edgewise.DEPTH_CLEAR).sum() > background.sum()


def test_draws_release_the_gil():
    drawn = scene()
    worker = threading.Thread(target=lambda: drawn.draw([CAMERA] * 400, (300, 200), backend="naive"))
    worker.start()
    turns = 0
    while worker.is_alive():
        turns += 1
        time.sleep(0.001)
    assert turns > 10  # held, it is one or two
