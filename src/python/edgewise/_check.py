"""Checks of arguments. Each returns the value as the extension takes it. An error is one line: the name, what is allowed, and
the value. Numbers that become floats may be rounded; all others keep their value."""
from __future__ import annotations

import operator
import os
import reprlib
import textwrap
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

import edgewise
from . import _native

INT_MAX = 0x7FFFFFFF
UINT_MAX = 0xFFFFFFFF


def refuse(value: Any, name: str, allowed: str, error: type[Exception] = TypeError) -> NoReturn:
    raise error(f"{name} must be {allowed}, not {textwrap.shorten(reprlib.repr(value), 80)}") from None


def integer(value: Any, name: str, low: int = 0, high: int = INT_MAX) -> int:
    try:
        number = None if isinstance(value, bool) else operator.index(value)
    except TypeError:
        number = None
    if number is None or not low <= number <= high:
        refuse(value, name, f"an integer from {low} to {high}", TypeError if number is None else ValueError)
    return number


def integers(values: Any, name: str, count: int, low: int, high: int) -> tuple[int, ...]:
    try:
        given = tuple(values)
    except TypeError:
        given = ()
    if len(given) != count:
        refuse(values, name, f"{count} integers")
    return tuple(integer(value, f"{name}[{i}]", low, high) for i, value in enumerate(given))


def counts(**given: Any) -> list[int]:
    return [integer(value, name) for name, value in given.items()]


def numbers(**given: Any) -> list[float]:
    for name, value in given.items():
        given_array = as_array(value, name, "a number")
        if given_array.ndim or given_array.dtype.kind not in "iuf":
            refuse(value, name, "a number")
    return [float(value) for value in given.values()]


def flags(**given: Any) -> list[bool]:
    for name, value in given.items():
        if not isinstance(value, (bool, np.bool_)):
            refuse(value, name, "True or False")
    return [bool(value) for value in given.values()]


def text(value: Any, name: str) -> str:
    if not isinstance(value, str) or not value.isascii():  # of all names that the library knows
        refuse(value, name, "a name (str)")
    return value


def path(value: Any, name: str) -> Any:
    try:
        bad = b"\0" in os.fsencode(value)
    except (TypeError, UnicodeEncodeError):
        bad = True
    if bad:
        refuse(value, name, "the path of a file")
    return value


def callback(value: Any, name: str) -> Any:
    if value is not None and not callable(value):
        refuse(value, name, "a function or None")
    return value


def as_array(values: Any, name: str, allowed: str = "an array") -> NDArray[Any]:
    """An array of any type."""
    if isinstance(values, np.ma.MaskedArray):
        refuse(values, name, allowed + " without a mask", ValueError)
    try:
        return np.asarray(values)
    except (TypeError, ValueError):  # rows of different lengths
        refuse(values, name, allowed, ValueError)


def array(values: Any, name: str, dtype: Any) -> NDArray[Any]:
    """`dtype` is float64, float32, or uint32, for which floats are refused. An empty array may have any type, as [] has one."""
    kinds, allowed = ("iu", "an array of integers") if dtype == np.uint32 else ("iuf", "an array of numbers of up to 64 bits")
    given = as_array(values, name, allowed)
    if given.size and (given.dtype.kind not in kinds or given.dtype.itemsize > 8):
        refuse(values if given.dtype == object else given.dtype, name, allowed, ValueError)
    if not given.size or given.dtype == dtype:
        return np.asarray(given, dtype, order="C")
    with np.errstate(over="ignore", invalid="ignore"):
        made = np.asarray(given, dtype, order="C")
    lost = (given < 0) | (given > UINT_MAX) if made.dtype == np.uint32 else np.isinf(made) & ~np.isinf(given)
    if lost.any():
        refuse(given[lost][0].item(), name, f"in the range of {made.dtype}", ValueError)
    return made


def points(values: Any) -> NDArray[Any]:
    return array(values, "positions", np.float32 if as_array(values, "positions").dtype == np.float32 else np.float64)


def vectors(**given: Any) -> list[NDArray[np.float64]]:
    arrays = [array(values, name, np.float64) for name, values in given.items()]
    for name, values in zip(given, arrays):
        if values.shape != (3,):
            raise ValueError(f"{name} must have the shape (3,), not {values.shape}")
    return arrays


def camera(value: Any) -> edgewise.Camera:
    return value if isinstance(value, edgewise.Camera) else refuse(value, "camera", "an edgewise.Camera")


def cameras(values: Any, name: str) -> list[edgewise.Camera]:
    try:
        return [values] if isinstance(values, edgewise.Camera) else [camera(value) for value in values]
    except TypeError:
        refuse(values, name, "an edgewise.Camera or a sequence of them")


def matrices(given: list[edgewise.Camera]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    def stack(name: str, of_views: list[Any]) -> NDArray[np.float64]:
        made = array([as_array(matrix, name) for matrix in of_views], name, np.float64)
        if given and made.shape[1:] != (4, 4):
            raise ValueError(f"{name} must have the shape (4, 4), not {made.shape[1:]}")
        return made
    return stack("camera.view", [one.view for one in given]), stack("camera.projection", [one.projection for one in given])


def frame(value: Any, name: str = "frame") -> edgewise.Frame:
    if not isinstance(value, tuple) or len(value) != 2 or not isinstance(value[1], np.ndarray) or \
            not isinstance(value[0], (np.ndarray, type(None))):
        refuse(value, name, "an edgewise.Frame of arrays")
    if value[0] is not None and value[0].shape != value[1].shape:
        raise ValueError(f"{name}: payload and depth must have the same shape, not {value[0].shape} and {value[1].shape}")
    return edgewise.Frame(*value)


def size(value: Any) -> tuple[int, ...]:
    return integers(value, "size", 2, 1, _native.MAX_SIDE)


def threads(value: Any) -> int:
    return integer(value, "threads", 1, _native.MAX_THREADS)


def id_options(first_id: Any, cull: Any, subpixel_bits: Any, given_threads: Any) -> tuple[int, str, int, int]:
    return (integer(first_id, "first_id", 0, UINT_MAX), text(cull, "cull"),
            integer(subpixel_bits, "subpixel_bits", _native.MIN_SUBPIXEL_BITS, _native.MAX_SUBPIXEL_BITS), threads(given_threads))


def id_frame(given: Any, first_id: Any, cull: Any, subpixel_bits: Any, given_threads: Any) -> tuple[Any, ...]:
    """A frame's planes, and the options of its draw."""
    planes, options = frame(given), id_options(first_id, cull, subpixel_bits, given_threads)
    if getattr(given, "subpixel_bits", None) not in (None, subpixel_bits):
        raise ValueError(f"subpixel_bits is {subpixel_bits}, but the frame was drawn with {given.subpixel_bits}")
    return *planes, *options
