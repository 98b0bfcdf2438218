"""Copies, pickles and getters: what a scene, stream or camera holds survives."""
import copy
import copyreg
import gc
import multiprocessing
import pickle

import numpy as np
import pytest

import edgewise
from support import ASPECT, CAMERA, MOVED, SIZE, scene, stream, triangles

QUADS = (0, 0, 0), (1, 0, 0.2), (1, 1, 0), (0, 1, 0.3), (2, 0, 0), (2, 1, 0.4)
COPIES = {"copy": copy.copy, "deepcopy": copy.deepcopy,
          **{f"protocol {p}": lambda drawn, p=p: pickle.loads(pickle.dumps(drawn, p)) for p in range(pickle.HIGHEST_PROTOCOL + 1)}}


class Named(edgewise.Scene):
    """A user's class with more to remember."""
    __slots__ = ("slot",)
    note = None


def of_file(tmp_path, offset):
    """Bent quads with one normal each, coloured by a material; far from the origin, the reader places them by a translation."""
    (tmp_path / "a.mtl").write_text("newmtl a\nKd 1 0.5 0.1\n")
    (tmp_path / "a.obj").write_text("mtllib a.mtl\nusemtl a\n" + "".join(f"v {x + offset} {y} {z}\n" for x, y, z in QUADS) +
                                    "f 1 2 3 4\no caf\u00e9\nf 2 5 6 3\nf 1 2 6\n", "latin-1")
    return edgewise.Scene.read_obj(tmp_path / "a.obj")


def lit_scene():
    """All that can be put in: meshes with and without colours, a two-sided one, an empty one, moved vertices, a light."""
    made = scene()
    positions, indices, colours = triangles(30, 5)
    made.add_instance(made.add_mesh(positions, indices, colours=colours, two_sided=True), MOVED)
    made.add_instance(made.add_mesh(np.empty((0, 3)), np.empty((0, 3), np.uint32)))
    made.add_instance(made.add_mesh(positions, indices[:7]), np.diag([1, 2, -1, 1]))
    made.set_positions(0, triangles(60, 9)[0])
    made.set_instance(1, np.diag([-0.5, 1, 1, 1]))
    made.set_light((-1, 0.5, 0.25))
    return made


def exact_stream():
    return edgewise.Stream(stream().vertices.astype(np.float64) + 2.0**-30, SIZE, colours=stream().colours, exact=True)


def hashes(drawn):
    views = [()] if isinstance(drawn, edgewise.Stream) else [(camera, SIZE) for camera in (CAMERA, drawn.camera(ASPECT))]
    return [edgewise.pixel_hash(drawn.draw(*view, cull=cull, ids=ids, threads=2))
            for view in views for cull in ("none", "back") for ids in (False, True)]


@pytest.fixture(params=["scene", "lit", "near file", "far file", "stream", "exact stream", "nothing", "65,536 triangles"])
def drawn(request, tmp_path):
    if request.param == "65,536 triangles":  # with clusters
        positions, indices, colours = triangles(1 << 16)
        return edgewise.Scene(positions * 0.1 + np.repeat(positions[::3], 3, axis=0), indices, colours=colours)
    return {"scene": scene, "lit": lit_scene, "near file": lambda: of_file(tmp_path, 0), "far file": lambda: of_file(tmp_path, 4e6),
            "stream": stream, "exact stream": exact_stream, "nothing": edgewise.Scene}[request.param]()


@pytest.mark.parametrize("how", COPIES)
def test_a_copy_draws_the_same_and_is_another(drawn, how):
    before = hashes(drawn)
    other = COPIES[how](drawn)
    assert type(other) is type(drawn) and hashes(other) == before
    assert list(other.first_ids()) == list(drawn.first_ids())
    if isinstance(other, edgewise.Scene):
        assert str(other.objects()) == str(drawn.objects())
        other.add_instance(other.add_mesh(*triangles(5)[:2]))
        if drawn.instances:
            other.set_instance(0, MOVED)
            other.set_positions(0, drawn.meshes[0].positions[::-1])
        other.set_light((0, 0, 1))
        assert hashes(drawn) == before != hashes(other)


@pytest.mark.parametrize("how", [how for how in COPIES if how not in ("protocol 0", "protocol 1")])  # which know no slots
def test_a_subclass_keeps_what_it_added(how):
    named = Named(*triangles()[:2])
    named.note, named.slot = ["a"], "b"
    other = COPIES[how](named)
    assert type(other) is Named and (other.note, other.slot) == (["a"], "b") and hashes(other) == hashes(named)
    assert (other.note is named.note) == (how == "copy")
    other.remove_instance(0)
    assert len(named.instances) == 1


def test_getters_give_what_was_put_in():
    made = lit_scene()
    mesh = made.meshes[2]
    assert [array.dtype for array in mesh[:3]] == [np.float32, np.uint32, np.uint32]
    assert [len(m.triangles) for m in made.meshes] == [60, 20, 30, 0, 7] and [m.two_sided for m in made.meshes] == [0, 0, 1, 0, 0]
    assert [instance.mesh for instance in made.instances] == [0, 1, 0, 2, 3, 4] and list(made.light) == [-1, 0.5, 0.25]
    again = edgewise.Scene()
    for m in made.meshes:
        again.add_mesh(m.positions, m.triangles, colours=m.colours, two_sided=m.two_sided)
    for instance in made.instances:
        again.add_instance(*instance)
    again.set_light(made.light)
    assert hashes(again) == hashes(made)


def test_getters_give_copies():
    made, flat = scene(), stream()
    before = hashes(made), hashes(flat)
    for array in (*made.meshes[0][:3], made.instances[0].matrix, made.light, flat.vertices, flat.colours):
        array[:] = 0
    assert (hashes(made), hashes(flat)) == before
    again = edgewise.Stream(flat.vertices, flat.size, colours=flat.colours)
    assert flat.vertices.shape == (40, 3, 3) and flat.colours.shape == (40,) and hashes(again) == hashes(flat)
    exact = exact_stream()
    assert np.array_equal(exact.vertices, flat.vertices.astype(np.float64) + 2.0**-30) and exact.vertices.dtype == np.float64
    meshes = made.meshes
    del made
    gc.collect()
    assert np.array_equal(meshes[0].positions, triangles(60, 1)[0])


def test_a_files_instance_has_its_place(tmp_path):
    far = of_file(tmp_path, 4e6)
    (mesh,), (instance,) = far.meshes, far.instances
    world = mesh.positions @ instance.matrix[:3, :3].T + instance.matrix[:3, 3]
    low, high = far.bounds()
    assert np.allclose(world.min(axis=0), low, rtol=0, atol=1e-6) and np.allclose(world.max(axis=0), high, rtol=0, atol=1e-6)
    assert low[0] == 4e6 and high[0] == 4e6 + 2


def test_a_damaged_state_is_an_error():
    make, (meshes, instances, light) = copyreg.dispatch_table[edgewise._native.Drawable](scene()._native)
    positions, *others = meshes[0]
    for damaged, text in (((meshes, instances, np.zeros(3)), "light"), ((meshes, [(7, np.eye(4))], light), "mesh 7 of 2"),
                          (([(positions[:1], *others)], [], light), "names vertex"),
                          (([(positions, *others[:3], np.zeros(3, np.float32), *others[4:])], [], light), "normals must"),
                          (([(positions, *others[:-1], [(b"part", 59, 2)])], [], light), "does not fit")):
        with pytest.raises(ValueError, match=text):
            make(*damaged)


def test_cameras_compare_and_hash_by_value():
    one = edgewise.Camera(CAMERA.view.copy(), CAMERA.projection.tolist())
    other = edgewise.Camera(CAMERA.view + np.eye(4) * 1e-9, CAMERA.projection)
    zero, negative = (edgewise.Camera(np.zeros((4, 4)), sign * np.zeros((4, 4))) for sign in (1, -1))
    assert one == CAMERA and not one != CAMERA and hash(one) == hash(CAMERA)
    assert other != CAMERA and not other == CAMERA and hash(other) != hash(CAMERA)
    assert zero == negative and hash(zero) == hash(negative)
    assert CAMERA != tuple(CAMERA) and CAMERA != 5 and tuple(CAMERA) != CAMERA
    assert {CAMERA: "a", other: "b"}[one] == "a" and one in [other, CAMERA] and len({one, other, CAMERA}) == 2
    view, projection = pickle.loads(pickle.dumps(CAMERA))
    assert edgewise.Camera(view, projection) == copy.deepcopy(CAMERA) == CAMERA
    assert edgewise.Camera(view[:3], projection) != CAMERA


def test_a_pool_draws_scenes_and_streams():
    work = [lit_scene(), scene(), stream()] * 2
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        assert pool.map(hashes, work) == list(map(hashes, work))
