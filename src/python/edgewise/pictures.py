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
    picture: NDArray[np.uint32]  # grey where equal, red where not
    differing_in_alpha: int  # pixels outside the mask, which `differing` leaves out; 0 for depths


def read_image(path: _Path) -> NDArray[Any]:
    """A picture: PNG, PGM or PPM, or a PFM with three channels, by the file's content. Shape (height, width).

    16-bit grey is uint16, as stored. All else is uint32, 0xFFBBGGRR: alpha is ignored, other samples of 16 bits are rounded to
    8, and those of a PFM, from 0 to 1, too. Warns if a PNG ends after its pixels (no IEND).
    OSError for a file that cannot be read.
    """
    picture, notes = _native.read_image(_check.path(path, "path"))
    warn(notes)
    return picture


def write_image(path: _Path, colours: ArrayLike) -> None:
    """Writes a picture by the extension: colours as an 8-bit PNG or PPM, or grey as a 16-bit PNG.

    colours: shape (height, width), uint32, 0xAABBGGRR, or (height, width, 3 or 4), uint8: R, G, B; alpha is ignored. Or
    (height, width), uint16: 16-bit grey. ValueError for other types, OSError for a file that cannot be written.
    """
    path, picture = _check.path(path, "path"), _picture(colours, "colours")
    (_native.write_grey16 if picture.dtype == np.uint16 else _native.write_colours)(path, picture)


def read_pfm(path: _Path) -> NDArray[np.float32]:
    """The floats of a PFM file: a depth map, shape (height, width), or three channels, shape (height, width, 3).

    OSError for a file that cannot be read.
    """
    return _native.read_pfm(_check.path(path, "path"))


def write_pfm(path: _Path, depth: ArrayLike) -> None:
    """Writes a depth map, such as depth01() of a frame's depth, as float32.

    depth: shape (height, width), floats of up to 64 bits. ValueError for other types and for floats beyond float32's range,
    OSError for a file that cannot be written.
    """
    path = _check.path(path, "path")
    if (dtype := _check.as_array(depth, "depth").dtype).kind != "f":
        raise ValueError(f"depth must be floats, not {dtype}; of a frame's depths, write depth01(depth)")
    _native.write_pfm(path, _check.array(depth, "depth", np.float32))


def diff(a: _Path | ArrayLike, b: _Path | ArrayLike, mask: _Path | ArrayLike | None = None) -> Difference:
    """Compares two pictures or two depth maps, as `edgewise diff` does.

    a, b: files, or arrays: pictures as write_image() takes them; or depths, floats of up to 64 bits, shape (height, width) or
    (height, width, 3), which are compared as float32. Planes of frames are neither: compare id_colours(ids) and
    depth01(depth). mask: a file, or an array of shape (height, width), or a picture. Pixels count as equal where it is not
    black or 0, so Portable.reasons is one. ValueError for arrays of other types, OSError for files that cannot be read.
    """
    *found, notes = _native.diff(_comparable(a, "a"), _comparable(b, "b"), None if mask is None else _mask(mask))
    warn(notes)
    return Difference(*found)


def colours(values: ArrayLike, name: str = "colours") -> NDArray[np.uint32]:
    """0xAABBGGRR. ValueError for types that could mean anything else."""
    array = _check.as_array(values, name)
    if array.dtype == np.uint8 and array.ndim and array.shape[-1] in (3, 4):
        rgba = np.full((*array.shape[:-1], 4), 255, np.uint8)
        rgba[..., :array.shape[-1]] = array
        return rgba.view("<u4")[..., 0].astype(np.uint32)
    if isinstance(values, (list, tuple)) and array.dtype == np.int64:  # Python's integers have no width
        return _check.array(values, name, np.uint32)
    if array.size and (array.dtype.kind != "u" or array.dtype.itemsize != 4):
        raise ValueError(f"{name} must be 0xAABBGGRR of type uint32, or R, G, B of type uint8 and shape (..., 3 or 4), "
                         f"not {array.dtype} of shape {array.shape}")
    return np.asarray(array, np.uint32, order="C")


def _picture(picture: ArrayLike, name: str) -> NDArray[Any]:
    """Colours, or 16-bit grey."""
    array = _check.as_array(picture, name)
    if array.dtype.kind == "u" and array.dtype.itemsize == 2:
        return np.asarray(array, np.uint16, order="C")
    return colours(picture, name)


def _comparable(value: Any, name: str) -> Any:
    if _is_path(value):
        return _check.path(value, name)
    if _check.as_array(value, name).dtype.kind == "f":
        return _check.array(value, name, np.float32)
    return _picture(value, name)


def _mask(mask: Any) -> Any:
    """A file, or a picture that is black where pixels count."""
    if _is_path(mask):
        return _check.path(mask, "mask")
    array = _check.as_array(mask, "mask")
    if array.dtype == np.uint32 or array.dtype == np.uint8 and array.ndim == 3:
        return colours(array, "mask")
    if array.dtype.kind not in "biuf" or array.ndim != 2:
        raise ValueError(f"mask must be numbers of shape (height, width), not {array.dtype} of shape {array.shape}")
    return np.where(array != 0, np.uint32(0xFFFFFFFF), np.uint32(BLACK))


def _is_path(value: Any) -> bool:
    return isinstance(value, (str, PathLike))


def warn(notes: Sequence[str]) -> None:
    """Of a file, to the caller of the function that calls this."""
    for note in notes:
        warnings.warn(note, stacklevel=3)
