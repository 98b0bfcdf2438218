"""Arguments of another type, and numbers that would change: an error of one line that names the argument."""
import inspect
import re

import numpy as np
import pytest

import edgewise
import edgewise.lab
from support import CAMERA, SIZE, scene, stream, triangles

POSITIONS, INDICES, _ = triangles()
FRAME = scene().draw(CAMERA, SIZE, ids=True)
POINT = np.zeros(3)

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
    "positions": POSITIONS, "triangles": INDICES, "vertices": POSITIONS[INDICES], "matrix": np.eye(4), "mesh": 0, "instance": 0,
    "drawable": scene(), "camera": CAMERA, "cameras": CAMERA, "size": SIZE, "frame": FRAME, "low": POINT, "high": POINT, "direction": (0, 0, 1),
    "eye": (0, 0, 1), "target": POINT, "fov_y": 1, "aspect": 1, "near": 1, "far": 2, "left": 0, "right": 1, "bottom": 0, "top": 1,
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


def test_numbers_that_stay_the_same_are_taken():
    expected = edgewise.Scene(np.round(POSITIONS * 4), INDICES).draw(CAMERA, SIZE)
    for kind in (np.float16, ">f8", np.int8, np.int64):
        other = edgewise.Scene(np.round(POSITIONS * 4).astype(kind), INDICES.astype(">u2")).draw(CAMERA, SIZE)
        assert np.array_equal(other.payload, expected.payload)
    ids = FRAME.payload.astype(np.int64)
    assert np.array_equal(edgewise.id_colours(ids), edgewise.id_colours(FRAME.payload))
    assert np.array_equal(edgewise.depth01(FRAME.depth.astype(np.uint64)), edgewise.depth01(FRAME.depth))
