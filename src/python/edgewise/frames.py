"""Cameras, frames, and what a frame of ids shows of its scene. The package `edgewise` has all of its public names."""
from __future__ import annotations

import copy
import struct
import zlib
from typing import Any, Iterator, NamedTuple, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _check, _native

BACKGROUND_ID = 0xFFFFFFFF  # of pixels that no triangle covers, in frames of ids
BLACK = 0xFF000000
DEPTH_CLEAR: int = _native.DEPTH_CLEAR  # the depth of pixels that no triangle covers; all others are smaller


class Camera(NamedTuple):
    """Two matrices of shape (4, 4): world space to view space, and view space to clip space.

    Cameras are equal, and have the same hash, if their matrices are equal. So do not change the matrices of a dict's keys.
    """
    view: NDArray[np.float64]
    projection: NDArray[np.float64]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Camera) and all(map(np.array_equal, self, other))

    def __ne__(self, other: object) -> bool:  # else that of tuples
        return not self == other

    def __hash__(self) -> int:
        return hash(tuple((np.asarray(matrix, np.float64) + 0.0).tobytes() for matrix in self))  # -0.0 becomes 0.0


class Stats(NamedTuple):
    """Counts of a draw, added up over its views.

    triangles = whole_mesh + not_finite + outside + not_in_front + those that become pieces; pieces = culled + zero_area +
    emitted.
    """
    meshes: int  # instances
    meshes_culled: int  # of these, out of view
    triangles: int
    whole_mesh: int  # dropped with their instance, which is out of view
    not_finite: int  # dropped: a vertex is NaN or infinite
    outside: int  # dropped: out of view
    not_in_front: int  # dropped: behind the camera
    clipped: int
    clipped_near: int
    clipped_far: int
    clipped_guard: int
    pieces: int  # triangles after clipping
    culled: int  # pieces dropped for their facing
    zero_area: int  # pieces dropped: no area once rounded to 1/256 px
    emitted: int  # pieces drawn


class _Planes(NamedTuple):
    payload: NDArray[np.uint32]  # or None; a type that says so would burden all who draw payloads
    depth: NDArray[np.uint32]


class Frame(_Planes):
    """What a draw wrote: shape (height, width), or (views, height, width) for several cameras. Screen: as `edgewise` says.

    payload: uint32, ids or colours 0xAABBGGRR; None if only depth was drawn. An id is the number of a triangle, counted
    through the instances in order. Colours in memory are R, G, B, A: payload[..., None].view(np.uint8).
    depth: uint32, smaller is nearer; depth01() and metric_depth() convert it.
    stats: the counts of the draw that returned it. has_ids: whether that draw wrote ids, not colours. None for a Frame
    that no draw made.
    """
    stats: Stats | None = None
    has_ids: bool | None = None

    def _repr_png_(self) -> bytes | None:
        """The picture that a notebook shows: colours, or id_colours(); views one below the other, 16384 px at most."""
        if self.payload is None or not self.payload.size:
            return None
        ids = self.has_ids
        if ids is None:  # ids are below 2**30
            ids = bool((self.payload[self.depth != DEPTH_CLEAR] < BLACK).any())
        colours = id_colours(self.payload) if ids else self.payload
        return _png(colours.reshape(-1, colours.shape[-1])[:_native.MAX_SIDE])


def _png(colours: NDArray[np.uint32]) -> bytes:
    height, width = colours.shape
    rows = np.zeros((height, 1 + 3 * width), np.uint8)  # each begins with 0: not filtered
    rows[:, 1:] = colours.astype("<u4")[..., None].view(np.uint8)[..., :3].reshape(height, -1)
    png = b"\x89PNG\r\n\x1a\n"
    for name, data in ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")):
        png += struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    return png


def depth01(depth: NDArray[np.uint32]) -> NDArray[np.float64]:
    """Depths of a frame, of any shape, from 0, at the near plane, to 1, at the far plane and on background."""
    words = _check.array(depth, "depth", np.uint32)
    return np.clip((words.astype(np.float64) - _native.DEPTH_HEAD) / _native.DEPTH_RANGE, 0.0, 1.0)


def metric_depth(frame: Frame, camera: Camera | Sequence[Camera]) -> NDArray[np.float64]:
    """Distances along the view direction, in world units, of a frame's depths: shape (height, width) or (views, height, width).

    camera: that of the draw, or those of the views. Background: infinity. A perspective projection's are distances from the
    camera; a parallel one's are those that orthographic() counts. A unit of depth, 2**-31 of its range, is a longer distance
    where the camera is far: distance**2 / near * 2**-31 in perspective; the depth is within 34 units. Scene.barycentrics()
    gives distances with an error relative to them, and takes longer.
    """
    depth = _check.frame(frame).depth
    views, projections = _check.matrices(_check.cameras(camera, "camera"))
    if depth.ndim < 2 or depth.shape[:-2] != (() if isinstance(camera, Camera) else (len(views),)):
        raise ValueError(f"depth has the shape {depth.shape}, for {len(views)} cameras")
    z = depth01(depth)
    result = np.empty(depth.shape)
    height, width = depth.shape[-2:]
    x, y = (2 * np.arange(width) + 1) / width - 1, 1 - (2 * np.arange(height)[:, None] + 1) / height
    stacked, distances = z.reshape(-1, height, width), result.reshape(-1, height, width)
    for i, (view, projection) in enumerate(zip(views, projections)):
        to_z, to_w = (projection @ view)[2:, :3]
        if to_w.any():  # w is the distance from the camera, but for scale
            try:
                to_world = np.linalg.inv(view)[3] @ np.linalg.inv(projection)  # clip space, where w is 1, to 1 / w
            except np.linalg.LinAlgError:
                raise ValueError("a camera's matrix has no inverse") from None
            with np.errstate(divide="ignore"):
                distances[i] = 1 / ((to_world[0] * x + to_world[1] * y + to_world[2] * stacked[i] + to_world[3]) * np.linalg.norm(to_w))
        else:
            distances[i] = (stacked[i] * projection[3, 3] - projection[2, 3]) / np.linalg.norm(to_z)
    result[depth == DEPTH_CLEAR] = np.inf
    return result


def id_colours(ids: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """A colour per id, another for each id below 2**24 - 1, as `edgewise render --payload id` writes.

    BACKGROUND_ID is black.
    """
    return (_check.array(ids, "ids", np.uint32) + np.uint32(1)) * np.uint32(0x9E3779) & np.uint32(0xFFFFFF) | np.uint32(BLACK)


class Queries:
    """Methods of Scene. Frames are those of this scene alone, with ids from 0 on; all may have several views."""

    def instance_ids(self: Any, frame: Frame) -> NDArray[np.uint32]:
        """The number of the instance that each pixel shows: shape (height, width) or (views, height, width).

        frame: as of pixels_per_triangle(). Background: BACKGROUND_ID.
        """
        drawn, _, instances = self._shown(frame)
        result = np.full(drawn.shape, BACKGROUND_ID, np.uint32)
        result[drawn] = instances
        return result

    def amodal_masks(self: Any, camera: Camera | Sequence[Camera], size: tuple[int, int], *, cull: str = "none",
                     threads: int = 1) -> NDArray[np.bool_]:
        """The pixels that each instance would cover if it were alone: shape (instances, height, width) or (views, instances,
        height, width). Arguments as of draw(). Draws once per instance and camera."""
        cameras, size = _check.cameras(camera, "camera"), _check.size(size)
        several = () if isinstance(camera, Camera) else (len(cameras),)
        masks = list(self._alone(camera, size, cull, threads))
        return np.stack(masks, axis=-3) if masks else np.empty((*several, 0, size[1], size[0]), np.bool_)

    def visible_fraction(self: Any, frame: Frame, camera: Camera | Sequence[Camera], *, cull: str = "none",
                         threads: int = 1) -> NDArray[np.float64]:
        """The pixels that a frame shows of each instance, divided by those of its amodal mask: shape (instances,) or (views,
        instances). 0 if the mask is empty. What lies beyond the picture counts in neither.

        frame, camera and cull: of one draw of ids.
        """
        cameras = _check.cameras(camera, "camera")
        height, width = _check.frame(frame).depth.shape[-2:]
        visible = self.pixels_per_instance(frame)
        alone = [mask.sum(axis=(-2, -1)) for mask in self._alone(camera, (width, height), cull, threads)]
        whole = np.stack(alone, axis=-1) if alone else np.zeros(visible.shape)
        if whole.shape != visible.shape:
            raise ValueError(f"the frame has the shape {frame.depth.shape}, for {len(cameras)} cameras")
        return visible / np.maximum(whole, 1)

    def interpolate(self: Any, frame: Frame, attribute: ArrayLike | Sequence[ArrayLike], camera: Camera | Sequence[Camera], *,
                    cull: str = "none", threads: int = 1) -> NDArray[np.floating[Any]]:
        """An attribute of vertices at each pixel, perspective-correct: shape (height, width, k) or (views, height, width, k).

        attribute: shape (n, k), numbers, a row per vertex of the scene's mesh; for several meshes a list with such an array
        for each. Rows may also be numbers, shape (n,), or arrays. frame, camera and cull: of one draw of ids. Background: NaN.
        The result has the arrays' type, or a float type that holds it; the weights are those of barycentrics().
        """
        meshes = self.meshes
        arrays = [_check.as_array(values) for values in (attribute if isinstance(attribute, (list, tuple)) else [attribute])]
        if len(arrays) != len(meshes):
            raise ValueError(f"attribute: {len(arrays)} arrays given instead of {len(meshes)}, one per mesh")
        for i, (array, mesh) in enumerate(zip(arrays, meshes)):
            if array.dtype.kind not in "iuf":
                raise ValueError(f"attribute: that of mesh {i} must be numbers, not {array.dtype}")
            wanted = (len(mesh.positions), *arrays[0].shape[1:])
            if array.shape != wanted:
                raise ValueError(f"attribute: that of mesh {i} has the shape {array.shape} instead of {wanted}")
        drawn, triangles, instances = self._shown(frame)
        uv, _ = self.barycentrics(frame, camera, cull=cull, threads=threads)
        rest = arrays[0].shape[1:] if arrays else ()
        result = np.full((*drawn.shape, *rest), np.nan, np.result_type(np.float32, *arrays))
        if triangles.size:
            first_vertex = np.cumsum([0, *(len(array) for array in arrays)])
            first_triangle = np.cumsum([0, *(len(mesh.triangles) for mesh in meshes)])
            of_instance = np.array([mesh for mesh, _ in self.instances])[instances]
            corners = np.concatenate([mesh.triangles for mesh in meshes])[triangles + first_triangle[of_instance]]
            values = np.concatenate(arrays)[corners + first_vertex[of_instance][:, None]]
            u, v = uv[drawn].T.astype(np.float64)  # the weights add up to 1 exactly
            result[drawn] = np.einsum("ip,pi...->p...", np.stack([1 - u - v, u, v]), values)
        return result

    def _shown(self: Any, frame: Frame) -> tuple[NDArray[np.bool_], NDArray[np.int64], NDArray[np.intp]]:
        """Which pixels are drawn; then of these in order the triangle, counted in its mesh, and the instance."""
        payload, depth = _check.frame(frame)
        if payload is None:
            raise ValueError("the frame has no payload: draw ids")
        drawn = depth != DEPTH_CLEAR
        ids = _check.array(payload, "frame.payload", np.uint32)[drawn].astype(np.int64)
        first = self.first_ids()
        if ids.size and ids.max() >= first[-1]:
            raise ValueError(f"a pixel has id {ids.max()} of {first[-1]} triangles")
        instances = np.searchsorted(first, ids, side="right") - 1
        return drawn, ids - first[instances], instances

    def _alone(self: Any, camera: Camera | Sequence[Camera], size: tuple[int, int], cull: str,
               threads: int) -> Iterator[NDArray[np.bool_]]:
        """Whether each pixel is drawn if an instance is alone, for each."""
        alone = copy.copy(self)
        instances = alone.instances
        for i in reversed(range(len(instances))):
            alone.remove_instance(i)
        for instance in instances:
            alone.add_instance(*instance)
            yield alone.draw(camera, size, cull=cull, threads=threads, depth_only=True).depth != DEPTH_CLEAR
            alone.remove_instance(0)
