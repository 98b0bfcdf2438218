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


def depth01(depth: NDArray[np.uint32]) -> NDArray[np.float64]:
    """Depths of a frame from 0, at the near plane, to 1, at the far plane and on background."""
    return np.clip((depth.astype(np.float64) - _native.DEPTH_HEAD) / _native.DEPTH_RANGE, 0.0, 1.0)


def pixel_hash(frame: Frame) -> int:
    """A number that is the same for the same picture, on every machine; what `edgewise hash` prints."""
    return _native.pixel_hash(*_stacked(frame))


def visible_triangles(frame: Frame) -> tuple[NDArray[np.uint32], NDArray[np.int64]]:
    """What frames of ids show: flat, offsets. View i sees the ids flat[offsets[i]:offsets[i + 1]], in ascending order."""
    views = _native.visible_triangles(*_stacked(frame))
    return np.concatenate([*views, np.empty(0, np.uint32)]), np.cumsum([0, *map(len, views)])


class Scene:
    """Meshes, their instances, and a light. Keeps the memory of its draws, so later ones are faster than the first.

    Several threads may use a scene; its draws take turns. Scenes of their own let them draw at the same time.
    """

    def __init__(self, positions: ArrayLike | None = None, triangles: ArrayLike | None = None, *,
                 colours: ArrayLike | None = None, two_sided: bool = False):
        """Empty, or one mesh and one instance of it where it is; see add_mesh()."""
        self._native = _native.Scene()
        if positions is not None and triangles is not None:
            self.add_instance(self.add_mesh(positions, triangles, colours=colours, two_sided=two_sided))

    @classmethod
    def read_obj(cls, path: str | PathLike[str]) -> Scene:
        """The mesh of a Wavefront OBJ file, with its colours. RuntimeError if the file cannot be read."""
        scene = cls.__new__(cls)
        scene._native = _native.Scene.read_obj(path)
        return scene

    def add_mesh(self, positions: ArrayLike, triangles: ArrayLike, *, colours: ArrayLike | None = None,
                 two_sided: bool = False) -> int:
        """Adds a mesh, which only its instances show, and returns its number. Copies the arrays.

        positions: shape (n, 3), float32. triangles: shape (m, 3), uint32, indices of positions. colours: shape (m,),
        uint32, 0xAABBGGRR; else light grey. two_sided: no triangle is culled, and each is lit on the side that is seen.
        """
        return self._native.add_mesh(
            np.ascontiguousarray(positions, np.float32), _indices(triangles),
            None if colours is None else np.ascontiguousarray(colours, np.uint32), two_sided)

    def add_instance(self, mesh: int, matrix: ArrayLike = IDENTITY) -> int:
        """Places a mesh in the world by an affine matrix, shape (4, 4), and returns the instance's number."""
        return self._native.add_instance(mesh, np.ascontiguousarray(matrix, np.float64))

    def set_instance(self, instance: int, matrix: ArrayLike) -> None:
        """Moves an instance."""
        self._native.set_instance(instance, np.ascontiguousarray(matrix, np.float64))

    def set_light(self, direction: Sequence[float]) -> None:
        """The direction towards the light; any length but 0."""
        self._native.set_light(*direction)

    def first_ids(self) -> NDArray[np.int64]:
        """The id of each instance's first triangle; then the number of triangles."""
        return np.asarray(self._native.first_ids(), np.int64)

    def camera(self, aspect: float) -> Camera:
        """A camera that sees the whole scene in images whose width is `aspect` times their height."""
        return Camera(*self._native.camera(aspect))

    def draw(self, camera: Camera | Sequence[Camera], size: tuple[int, int], *, ids: bool = False, cull: str = "none",
             shade: bool = True, threads: int = 1, backend: str = "tiled", background: int | None = None,
             scissor: tuple[int, int, int, int] | None = None, onto: Frame | None = None) -> Frame:
        """Draws the scene, seen by one camera or by several.

        size: width, height in pixels, at most 16384. ids: payloads are ids, not colours. cull: none, back, front or both.
        backend: tiled, scanline or naive, which draw the same picture. background: the payload of pixels that no triangle
        covers; by default BACKGROUND_ID or black. scissor: x, y, width, height, the only pixels to draw. onto: a frame that
        is drawn over, as if both draws were one, and returned; else the frame is new.
        """
        cameras = [camera] if isinstance(camera, Camera) else list(camera)
        if onto is None:
            shape = (len(cameras), size[1], size[0])
            frame = Frame(*(np.empty(shape, np.uint32) for _ in range(2)))
            if isinstance(camera, Camera):
                frame = Frame(frame.payload[0], frame.depth[0])
        else:
            frame = onto
        payload, depth = _stacked(frame)
        matrices = [np.array([c[i] for c in cameras], np.float64).reshape(-1, 4, 4) for i in range(2)]
        if background is None:
            background = BACKGROUND_ID if ids else 0xFF000000
        if onto is None and scissor is not None:
            raise ValueError("a scissor needs a frame to draw onto")
        self._native.draw(*matrices, payload, depth, cull, ids, shade, threads, backend, background, onto is None, scissor)
        return frame

    def barycentrics(self, frame: Frame, camera: Camera, *, cull: str = "none",
                     threads: int = 1) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Perspective-correct coordinates of the triangle's point that each pixel of a frame of ids shows.

        Returns uv, shape (height, width, 2), and distance along the view direction, shape (height, width). A pixel's value
        of an attribute is (1 - u - v) a[0] + u a[1] + v a[2]. u, v and 1 - u - v are >= 0; the error is below 2**-24, that
        of the distance below 2**-23 of it. Background: 0 and infinity. ValueError if the frame shows something else.
        """
        return self._native.barycentrics(np.ascontiguousarray(camera.view, np.float64),
                                         np.ascontiguousarray(camera.projection, np.float64), *_stacked(frame), cull, threads)


def draw(positions: ArrayLike, triangles: ArrayLike, camera: Camera | Sequence[Camera], size: tuple[int, int],
         **options) -> Frame:
    """The ids and depths of one mesh: Scene(positions, triangles).draw(camera, size, ids=True). For a mesh that is drawn
    often, a Scene is faster."""
    return Scene(positions, triangles).draw(camera, size, ids=True, **options)


def _indices(triangles: ArrayLike) -> NDArray[np.uint32]:
    array = np.asarray(triangles)
    if array.size and array.dtype != np.uint32:
        if not np.issubdtype(array.dtype, np.integer):
            raise ValueError("triangles must be integers")
        if array.min() < 0 or array.max() > 0xFFFFFFFF:
            raise ValueError("an index of triangles is out of range")
    return np.ascontiguousarray(array, np.uint32)


def _stacked(frame: Frame) -> tuple[NDArray[np.uint32], NDArray[np.uint32]]:
    """The planes with a leading axis of views. They share the frame's memory."""
    for plane in frame:
        if plane.dtype != np.uint32 or plane.ndim not in (2, 3) or not plane.flags.c_contiguous:
            raise ValueError("a frame's planes must be contiguous arrays of uint32 with 2 or 3 axes")
    return tuple(plane.reshape(-1, *plane.shape[-2:]) for plane in frame)
