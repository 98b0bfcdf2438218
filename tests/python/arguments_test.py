"""Bad arguments are errors of one line that name the argument, and change nothing."""
import inspect
import re

import numpy as np
import pytest

import edgewise
import edgewise.lab
from support import CAMERA, SIZE, same, scene, stream, triangles

WIDTH, HEIGHT = SIZE
POSITIONS, INDICES, COLOURS = triangles()
IDENTITY = np.eye(4)
FRAME = scene().draw(CAMERA, SIZE, ids=True)
FINE = scene().draw(CAMERA, SIZE, ids=True, subpixel_bits=12)


def plane(*shape, dtype=np.uint32):
    return np.zeros(shape or (HEIGHT, WIDTH), dtype)


def read_only(array):
    array.flags.writeable = False
    return array


def onto(payload, depth, camera=CAMERA):
    return lambda: scene().draw(camera, SIZE, onto=edgewise.Frame(payload, depth))


CASES = {
    "positions of 2 columns": ("positions", lambda: edgewise.Scene(POSITIONS[:, :2], INDICES)),
    "matrix of 80 bits": (r"matrix .*float\d+", lambda: scene().set_instance(0, np.eye(4, dtype=np.longdouble))),
    "missing vertex": ("triangle 59 names vertex 179 of 179", lambda: edgewise.Scene(POSITIONS[:-1], INDICES)),
    "too few colours": ("colours", lambda: edgewise.Scene(POSITIONS, INDICES, colours=COLOURS[1:])),
    "instance of NaN": ("finite", lambda: scene().set_instance(0, IDENTITY * np.nan)),
    "colour of 33 bits": ("colours .* range of uint32, not ", lambda: edgewise.Scene(POSITIONS, INDICES, colours=[1 << 32] * len(INDICES))),
    "missing instance": ("instance 3 of 3", lambda: scene().set_instance(3, IDENTITY)),
    "fewer positions": ("179 vertices given instead of 180", lambda: scene().set_positions(0, POSITIONS[:-1])),
    "ids beyond 32 bits": ("ids", lambda: scene().draw(CAMERA, SIZE, ids=True, first_id=2**32 - 2)),
    "light 0": ("light", lambda: scene().set_light((0, 0, 0))),
    "aspect 0": ("aspect", lambda: scene().camera(0)),
    "cull": ("culling mode 'bck'; did you mean 'back'", lambda: scene().draw(CAMERA, SIZE, cull="bck")),
    "other subpixel_bits": ("subpixel_bits is 8, but the frame was drawn with 12", lambda: scene().barycentrics(FINE, CAMERA)),
    "attribute at other subpixel_bits": ("drawn with 12", lambda: edgewise.Scene(POSITIONS, INDICES).interpolate(
        FINE, POSITIONS, CAMERA, subpixel_bits=4)),
    "depths above the background's": ("above DEPTH_CLEAR", onto(plane(), plane() - np.uint32(1))),
    "depth of the other byte order": ("uint32", onto(plane(), plane(dtype=">u4"))),
    "depth that is read-only": ("depth must not be read-only", onto(plane(), read_only(plane()))),
    "planes of different strides": ("strides", onto(plane(HEIGHT, WIDTH + 1)[:, 1:], plane())),
    "one plane for both": ("overlap", onto(*[plane()] * 2)),
    "views that overlap": ("follow|read-only", onto(*(np.lib.stride_tricks.as_strided(
        plane(), (2, HEIGHT, WIDTH), (0, 4 * WIDTH, 4)) for _ in range(2)), [CAMERA, CAMERA])),
    "unaligned": ("aligned", onto(*(np.zeros(4 * WIDTH * HEIGHT + 1, np.uint8)[1:].view(np.uint32).reshape(HEIGHT, WIDTH)
                                    for _ in range(2)))),
    "hash of several views": ("one view", lambda: edgewise.pixel_hash(scene().draw([CAMERA], SIZE))),
    "barycentrics without ids": ("no payload", lambda: scene().barycentrics(scene().draw(CAMERA, SIZE, depth_only=True), CAMERA)),
    "box of 2 coordinates": ("low must", lambda: scene().visible([0, 0], [1, 1], CAMERA, scene().draw(CAMERA, SIZE))),
    "bits 16": ("1 to 15, the most that the library draws", lambda: stream().portable(bits=16)),
    "portable of a parallel projection": ("perspective", lambda: scene().portable(edgewise.Camera(
        IDENTITY, edgewise.orthographic(-1, 1, -1, 1, -2, 2)), SIZE)),
    "needs of no frames": ("0 cameras", lambda: scene().needs([], SIZE)),
    "depths beyond float32": ("^b must be in the range of float32, not 1e\\+39", lambda: edgewise.diff(np.zeros((1, 1)), np.full((1, 1), 1e39))),
    "planes of two shapes": ("frame: payload and depth must have the same shape", lambda: scene().instance_ids(edgewise.Frame(plane(2, 2), plane()))),
    "cameras for a stream": ("2 cameras for a stream", lambda: edgewise.lab.needs(stream(), [CAMERA] * 2, SIZE)),
    "attribute of another length": ("attribute: that of mesh 0 has the shape", lambda: scene().interpolate(
        FRAME, [np.zeros((3, 2)), np.zeros((60, 2))], CAMERA)),
    "one attribute for two meshes": ("1 arrays given instead of 2", lambda: scene().interpolate(FRAME, np.zeros((180, 2)), CAMERA)),
    "attributes of two widths": ("mesh 1 has the shape", lambda: scene().interpolate(FRAME, [np.zeros((180, 2)), np.zeros((60, 3))], CAMERA)),
    "one camera for two views": ("1 cameras for 2 views", lambda: scene().barycentrics(scene().draw([CAMERA] * 2, SIZE, ids=True), CAMERA)),
    "instance of a missing mesh": ("mesh 2 of 2", lambda: scene().add_instance(2)),
    "positions of a missing mesh": ("mesh 2 of 2", lambda: scene().set_positions(2, POSITIONS)),
    "columns with gaps": ("contiguous", onto(*(plane(HEIGHT, 2 * WIDTH)[:, ::2] for _ in range(2)))),
    "masked camera": ("camera.view .* mask", lambda: scene().draw(edgewise.Camera(np.ma.masked_less(IDENTITY, 0), IDENTITY), SIZE)),
    "instances of another scene": ("has id", lambda: edgewise.Scene(*triangles(1)[:2]).instance_ids(FRAME)),
    "depth of two cameras": ("2 cameras", lambda: edgewise.metric_depth(FRAME, [CAMERA] * 2)),
    "singular camera": ("no inverse", lambda: edgewise.metric_depth(FRAME, edgewise.Camera(np.eye(4), np.ones((4, 4))))),
    "colours of int64": ("colours .* not int64", lambda: edgewise.Scene(POSITIONS, INDICES, colours=COLOURS.astype(np.int64))),
}


@pytest.mark.parametrize("name", CASES)
def test_a_bad_argument_is_a_value_error(name):
    text, call = CASES[name]
    with pytest.raises(ValueError, match=text):
        call()


def test_a_failed_call_changes_nothing():
    drawn = scene()
    frame = drawn.draw(CAMERA, SIZE)
    kept = [p.copy() for p in frame]
    for bad in ({"threads": 0}, {"cull": "?"}, {"backend": "?"}, {"scissor": (0, 0, 0, -1)}):
        with pytest.raises(ValueError):
            drawn.draw(CAMERA, SIZE, onto=frame, clear=True, **bad)
    with pytest.raises(ValueError):
        drawn.add_mesh(POSITIONS[:2], INDICES)
    assert same(frame, kept)
    assert list(drawn.first_ids()) == [0, 60, 80, 140]
    assert same(drawn.draw(CAMERA, SIZE), kept)


# What must be refused, by the annotation of a parameter.
NUMBERS = [None, "1", True, 1j, [1.0], np.complex64(1), object()]
SIZES = [None, 5, "12", (1.5, 2), ("1", 2), (1, 2, 3), (0, 5), (5, -5), (5, 10**20), (True, 5)]
ARRAYS = [None, "text", [[1], [2, 3]], {"a": 1}, [None], ["1"], [b"1"], [1j], [object()], [True], np.array([1], "M8[s]"),
          np.ma.masked_less([1.0], 0)]
BAD = {
    "int": [*NUMBERS, 1.5, np.float64(2), -1, 10**20],
    "float": NUMBERS,
    "bool": [None, 2, "no", [True]],
    "str": [None, 3, b"back", "\ud800"],
    "_Path": [None, 3, 1.5, "a\0b", "\ud800"],
    "ArrayLike": ARRAYS,
    "ArrayLike | Sequence[ArrayLike]": ARRAYS,
    "_Path | ArrayLike": [*ARRAYS[2:], "a\0b"],  # None is no mask, and text is a path
    "NDArray[np.uint32]": [*ARRAYS, [-1], [1 << 32], [1.0], np.array([-1], np.int8), np.array([1 << 63], np.uint64)],
    "Sequence[float]": [*ARRAYS, (1, 2)],
    "tuple[int, int]": SIZES,
    "tuple[int, int, int, int]": [5, "abcd", (1, 2, 3), (1.5, 0, 1, 1), (0, 0, 0, 10**20)],
    "Camera": [None, 3, "camera", (np.eye(4), np.eye(4)), [CAMERA]],
    "Camera | Sequence[Camera]": [None, 3, "camera", (np.eye(4), np.eye(4)), [CAMERA, None]],
    "Frame": [None, 3, "ab", (1, 2), (None, None), FRAME.depth, [*FRAME], (FRAME.payload.tolist(), FRAME.depth)],
    "Callable[[int], object]": [3, "f"],
}
# Right values of the parameters that a call must have.
GOOD = {
    "positions": POSITIONS, "triangles": INDICES, "vertices": POSITIONS[INDICES], "matrix": IDENTITY, "mesh": 0, "instance": 0,
    "drawable": scene(), "camera": CAMERA, "cameras": CAMERA, "size": SIZE, "frame": FRAME, "low": np.zeros(3), "high": np.zeros(3), "direction": (0, 0, 1),
    "eye": (0, 0, 1), "target": np.zeros(3), "fov_y": 1, "aspect": 1, "near": 1, "far": 2, "left": 0, "right": 1, "bottom": 0, "top": 1,
    "k": np.eye(3), "width": 4, "height": 4, "projection": np.eye(4), "depth": FRAME.depth, "ids": FRAME.payload, "attribute": [POSITIONS, triangles(20, 2)[0]],
    "path": "missing/file.png", "colours": FRAME.depth, "a": FRAME.depth, "b": FRAME.depth,
}


def functions():
    """All public functions and methods: name, function."""
    for name, value in (*vars(edgewise).items(), *vars(edgewise.lab).items()):
        if name.startswith("_") or not getattr(value, "__module__", "").startswith("edgewise") or hasattr(value, "_fields"):
            continue
        yield name, value
        if inspect.isclass(value):
            instance = {"Scene": scene, "Stream": stream}[name]()
            yield from ((f"{name}.{method}", getattr(instance, method)) for method in dir(instance)
                        if not method.startswith("_") and inspect.ismethod(getattr(instance, method)))


def parameters():
    for name, function in functions():
        for parameter in inspect.signature(function).parameters.values():
            if parameter.kind != parameter.VAR_KEYWORD and parameter.name != "drawable":
                yield pytest.param(function, parameter, id=f"{name}-{parameter.name}")


@pytest.mark.parametrize("function, parameter", parameters())
def test_a_wrong_type_is_refused_by_the_arguments_name(function, parameter):
    kind = parameter.annotation.removesuffix(" | None")
    allowed = {p.name: GOOD[p.name] for p in inspect.signature(function).parameters.values()
               if p.name in ("positions", "triangles") or p.default is p.empty and p.kind != p.VAR_KEYWORD}
    for bad in BAD[kind]:
        if bad is None and kind != parameter.annotation:
            continue
        with pytest.raises((TypeError, ValueError)) as raised:
            function(**{**allowed, parameter.name: bad})
        text = str(raised.value)
        assert re.search(rf"\b{parameter.name}\b", text) and "\n" not in text and len(text) < 200, (bad, text)
        assert not isinstance(bad, np.ma.MaskedArray) or "mask" in text
