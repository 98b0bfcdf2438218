"""Pictures, depth maps and their differences; edgewise's names are those of edgewise/__init__.py."""
from __future__ import annotations

import warnings
from os import PathLike
from typing import Any, NamedTuple, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _check, _native
from .frames import BLACK

_Path = Union[str, "PathLike[str]"]


class Difference(NamedTuple):
    """How two pictures or depth maps differ outside a mask."""
    differing: int  # pixels
    largest: float  # difference of a channel or of a depth
    scale: int  # what `largest` is out of: 255, or 65535 if a file has 16 bits; 1 for depths
    first: tuple[int, int] | None  # x, y of the first pixel that differs, row by row
    masked: int  # pixels of the mask
    differing_in_mask: int
    differing_in_alpha: int  # pixels outside the mask, which `differing` leaves out; 0 for depths
    picture: NDArray[np.uint32]  # grey where equal, red where not


def read_image(path: _Path) -> NDArray[Any]:
    """A picture: PNG, PGM or PPM, or a PFM with three channels, by the file's content. Shape (height, width).

    16-bit grey is uint16, as stored. All else is uint32, 0xFFBBGGRR: alpha is ignored, other samples of 16 bits are rounded to
    8, and those of a PFM, from 0 to 1, too. Warns of a PNG that is cut behind its pixels.
    """
    picture, notes = _native.read_image(_check.path(path, "path"))
    warn(notes)
    return picture


def write_image(path: _Path, colours: ArrayLike) -> None:
    """Writes a picture by the extension: colours as an 8-bit PNG or PPM, or grey as a 16-bit PNG.

    colours: shape (height, width), uint32, 0xAABBGGRR, or (height, width, 3 or 4), uint8: R, G, B; alpha is ignored. Or
    (height, width), uint16: 16-bit grey. ValueError for other types.
    """
    picture = _picture(colours)
    (_native.write_grey16 if picture.dtype == np.uint16 else _native.write_colours)(_check.path(path, "path"), picture)


def read_pfm(path: _Path) -> NDArray[np.float32]:
    """The floats of a PFM file: a depth map, shape (height, width), or three channels, shape (height, width, 3)."""
    return _native.read_pfm(_check.path(path, "path"))


def write_pfm(path: _Path, depth: ArrayLike) -> None:
    """Writes a depth map, such as depth01() of a frame's depth, as float32.

    depth: shape (height, width), of any float type; ValueError for others.
    """
    if (dtype := np.asarray(depth).dtype).kind != "f":
        raise ValueError(f"depths must be floats, not {dtype}; of a frame's depths, write depth01(depth)")
    _native.write_pfm(_check.path(path, "path"), _check.array(depth, "depth", np.float32))


def diff(a: _Path | ArrayLike, b: _Path | ArrayLike, mask: _Path | ArrayLike | None = None) -> Difference:
    """Compares two pictures or two depth maps, as `edgewise diff` does.

    a, b: files, or arrays: pictures as write_image() takes them; or depths of any float type, shape (height, width) or
    (height, width, 3), which are compared as float32. Planes of frames are neither: compare id_colours(ids) and
    depth01(depth). mask: a file, or an array of shape (height, width), or a picture. Pixels count as equal where it is not
    black or 0, so Portable.reasons is one.
    """
    *found, notes = _native.diff(_comparable(a), _comparable(b), mask if mask is None or _is_path(mask) else _mask(mask))
    warn(notes)
    return Difference(*found)


def colours(values: ArrayLike, of_mesh: bool = False) -> NDArray[np.uint32]:
    """0xAABBGGRR. ValueError for types that could mean anything else. A mesh's may be integers of 64 bits."""
    array = np.asarray(values)
    if array.dtype == np.uint8 and array.ndim and array.shape[-1] in (3, 4):
        alpha = array[..., 3:] if array.shape[-1] == 4 else np.full_like(array[..., :1], 255)
        r, g, b, a = np.moveaxis(np.concatenate([array[..., :3], alpha], axis=-1).astype(np.uint32), -1, 0)
        return r | g << np.uint32(8) | b << np.uint32(16) | a << np.uint32(24)
    wide = array.dtype.kind in "iu" and array.dtype.itemsize == 8
    if array.size and wide and (of_mesh or isinstance(values, (list, tuple))):  # Python's integers have no width
        if array.min() < 0 or array.max() > 0xFFFFFFFF:
            raise ValueError("a colour is outside 0 to 0xFFFFFFFF")
    elif array.size and (array.dtype.kind != "u" or array.dtype.itemsize != 4):
        raise ValueError(f"colours must be 0xAABBGGRR of type uint32, or R, G, B of type uint8 and shape (..., 3 or 4), "
                         f"not {array.dtype} of shape {array.shape}")
    return np.asarray(array, np.uint32, order="C")


def _picture(picture: ArrayLike) -> NDArray[Any]:
    """Colours, or 16-bit grey."""
    array = np.asarray(picture)
    return np.asarray(array, np.uint16, order="C") if array.dtype.kind == "u" and array.dtype.itemsize == 2 else colours(picture)


def _comparable(value: Any) -> Any:
    if _is_path(value):
        return value
    array = np.asarray(value)
    return np.asarray(array, np.float32, order="C") if array.dtype.kind == "f" else _picture(value)


def _mask(mask: ArrayLike) -> NDArray[np.uint32]:
    """A picture that is black where pixels count."""
    array = np.asarray(mask)
    if array.dtype == np.uint32 or array.dtype == np.uint8 and array.ndim == 3:
        return colours(array)
    if array.dtype.kind not in "biuf":
        raise ValueError(f"a mask must be numbers, not {array.dtype}")
    return np.where(array != 0, np.uint32(0xFFFFFFFF), np.uint32(BLACK))


def _is_path(value: Any) -> bool:
    return isinstance(value, (str, PathLike))


def warn(notes: Sequence[str]) -> None:
    """Of a file, to the caller of the function that calls this."""
    for note in notes:
        warnings.warn(note, stacklevel=3)
