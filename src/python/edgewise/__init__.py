"""Exact, reproducible rasterization of triangles on the CPU.

Screen: pixel [0, 0] is top left, and y points down. A pixel's only sample lies at its centre, (x + 0.5, y + 0.5).
Clip space, which is ``projection @ view @ world``: x points right, y up; visible where \\|x\\| <= w, \\|y\\| <= w and
0 <= z <= w; z = 0 is nearest. The front of a triangle is the side from which its vertices appear clockwise on the screen.
Pictures are the same, bit for bit, on every machine and for every backend and number of threads.

Errors in arguments are ValueError, with the library's text. Draws release the GIL.
"""
from __future__ import annotations

import math
from os import PathLike
from typing import NamedTuple, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native

BACKGROUND_ID = 0xFFFFFFFF  # of pixels that no triangle covers
IDENTITY = np.eye(4)


class Camera(NamedTuple):
    """Two matrices of shape (4, 4): world space to view space, and view space to clip space."""
    view: NDArray[np.float64]
    projection: NDArray[np.float64]


class Frame(NamedTuple):
    """What a draw wrote: shape (height, width), or (views, height, width) for several cameras.

    payload: uint32, ids or colours 0xAABBGGRR. An id is the number of a triangle, counted through the instances in order.
    depth: uint32, smaller is nearer; depth01() converts it.
    """
    payload: NDArray[np.uint32]
    depth: NDArray[np.uint32]


def perspective(fov_y: float, aspect: float, near: float, far: float = math.inf) -> NDArray[np.float64]:
    """The projection, shape (4, 4), from a view space with x right, y up, and -z forward.

    fov_y: vertical field of view in radians. aspect: width / height. near, far: distances along the view direction.
    """
    return _native.perspective(fov_y, aspect, near, far)


def orthographic(left: float, right: float, bottom: float, top: float, near: float, far: float) -> NDArray[np.float64]:
    """The projection without perspective, from the same view space as perspective()'s."""
    return _native.orthographic(left, right, bottom, top, near, far)


def intrinsics(k: ArrayLike, width: int, height: int, near: float, far: float = math.inf, *,
               first_centre: float = 0.0) -> NDArray[np.float64]:
    """The projection of a camera with intrinsics, from a view space with x right, y down, and z forward.

    k: shape (3, 3), in pixels of a width x height image in which the centre of the first pixel lies at
    (first_centre, first_centre): 0 for OpenCV, 0.5 for COLMAP. Such a camera's view is the world-to-camera matrix.
    """
    return _native.intrinsics(np.ascontiguousarray(k, np.float64), width, height, first_centre, near, far)


def projection_from(projection: ArrayLike, *, z_from_minus_w: bool = False, y_down: bool = False,
                    reversed: bool = False) -> NDArray[np.float64]:
    """Turns a projection into another clip space into one into ours.

    z_from_minus_w: visible where -w <= z <= w (OpenGL). y_down: Vulkan. reversed: the near plane is where z is largest.
    """
    return _native.projection_from(np.ascontiguousarray(projection, np.float64), z_from_minus_w, y_down, reversed)
