"""Cameras, frames, and what a frame of ids shows of its scene. The package `edgewise` has all of its public names."""
from __future__ import annotations

import copy
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Callable, Iterator, NamedTuple, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

import edgewise
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
    triangles: int  # of all instances
    whole_mesh: int  # dropped with their instance, which is out of view
    not_finite: int  # dropped: a vertex is NaN or infinite
    outside: int  # dropped: out of view
    not_in_front: int  # dropped: behind the camera
    clipped: int  # triangles that need clipping, which may drop them (outside, not_in_front)
    clipped_near: int  # of these, those that cross the near plane
    clipped_far: int  # those that cross the far plane
    clipped_guard: int  # those that cross a side of the guard band
    pieces: int  # triangles after clipping
    culled: int  # pieces dropped for their facing
    zero_area: int  # pieces dropped: no area once vertices are rounded
    emitted: int  # pieces drawn


class _Planes(NamedTuple):
    payload: NDArray[np.uint32]  # or None; Optional here would make every user of payload check for None
    depth: NDArray[np.uint32]


class Frame(_Planes):
    """What a draw wrote: shape (height, width), or (views, height, width) for several cameras. Screen: as `edgewise` says.

    payload: uint32, ids or colours 0xAABBGGRR; None if only depth was drawn. An id is the number of a triangle, counted
    through the instances in order. Colours in memory are R, G, B, A: payload[..., None].view(np.uint8).
    depth: uint32, smaller is nearer; depth01() and metric_depth() convert it.
    stats: the counts of the draw that returned it. has_ids: whether that draw wrote ids, not colours. subpixel_bits: those of
    that draw. None for a Frame that no draw made.
    """
    stats: Stats | None = None
    has_ids: bool | None = None
    subpixel_bits: int | None = None

    def _repr_png_(self) -> bytes | None:
        """The picture that a notebook shows: colours, or id_colours(); views one below the other, 16384 px at most."""
        if self.payload is None or not self.payload.size:
            return None
        ids = self.has_ids
        if ids is None:  # ids are below 2**30
            ids = bool((self.payload[self.depth != DEPTH_CLEAR] < BLACK).any())
        colours = id_colours(self.payload) if ids else _check.array(self.payload, "payload", np.uint32)
        with TemporaryDirectory() as folder:
            path = Path(folder, "frame.png")
            _native.write_colours(path, np.ascontiguousarray(colours.reshape(-1, colours.shape[-1])[:_native.MAX_SIDE]))
            return path.read_bytes()


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
                of_w = to_world[0] * x + to_world[1] * y + to_world[2] * stacked[i] + to_world[3]
                distances[i] = 1 / (of_w * np.linalg.norm(to_w))
        else:
            distances[i] = (stacked[i] * projection[3, 3] - projection[2, 3]) / np.linalg.norm(to_z)
    result[depth == DEPTH_CLEAR] = np.inf
    return result


def id_colours(ids: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """A colour per id, another for each id below 2**24 - 1, as `edgewise render --payload id` writes.

    BACKGROUND_ID is black.
    """
    return (_check.array(ids, "ids", np.uint32) + np.uint32(1)) * np.uint32(0x9E3779) & np.uint32(0xFFFFFF) | np.uint32(BLACK)


# The rest are methods of Scene. Frames are those of one scene alone, with ids from 0 on; all may have several views.


def instance_ids(self: edgewise.Scene, frame: Frame) -> NDArray[np.uint32]:
    """The number of the instance that each pixel shows: shape (height, width) or (views, height, width).

    frame: of ids from 0 on, of this scene alone. Background: BACKGROUND_ID.
    """
    drawn, _, instances = _shown(self, frame)
    result = np.full(drawn.shape, BACKGROUND_ID, np.uint32)
    result[drawn] = instances
    return result


def amodal_masks(self: edgewise.Scene, camera: Camera | Sequence[Camera], size: tuple[int, int], *, cull: str = "none",
                 threads: int = 1, subpixel_bits: int = 8,
                 progress: Callable[[int], object] | None = None) -> NDArray[np.bool_]:
    """The pixels that each instance would cover if it were alone: shape (instances, height, width) or (views, instances,
    height, width). Arguments as for draw(). Draws each instance once per camera; progress() counts these draws."""
    width, height = _check.size(size)
    camera = camera if isinstance(camera, Camera) else _check.cameras(camera, "camera")
    masks = list(_alone(self, camera, (width, height), cull, threads, subpixel_bits, progress))
    several = () if isinstance(camera, Camera) else (len(camera),)
    return np.stack(masks, axis=-3) if masks else np.empty((*several, 0, height, width), np.bool_)


def visible_fraction(self: edgewise.Scene, frame: Frame, camera: Camera | Sequence[Camera], *, cull: str = "none",
                     threads: int = 1, subpixel_bits: int = 8,
                     progress: Callable[[int], object] | None = None) -> NDArray[np.float64]:
    """The pixels that a frame shows of each instance, divided by those of its amodal mask: shape (instances,) or (views,
    instances). 0 if the mask is empty. What lies beyond the picture counts in neither.

    frame, camera, cull and subpixel_bits: of one draw of ids from 0 on, of this scene alone. progress: as for amodal_masks().
    """
    _check.id_frame(frame, 0, cull, subpixel_bits, threads)
    frame = _check.frame(frame)
    camera = camera if isinstance(camera, Camera) else _check.cameras(camera, "camera")
    visible = self.pixels_per_instance(frame)
    height, width = frame.depth.shape[-2:]
    alone = [mask.sum(axis=(-2, -1)) for mask in _alone(self, camera, (width, height), cull, threads, subpixel_bits, progress)]
    whole = np.stack(alone, axis=-1) if alone else np.zeros(visible.shape)
    if whole.shape != visible.shape:
        raise ValueError(f"the frame has the shape {frame.depth.shape}, for {len(_check.cameras(camera, 'camera'))} cameras")
    return visible / np.maximum(whole, 1)


def interpolate(self: edgewise.Scene, frame: Frame, attribute: ArrayLike | Sequence[ArrayLike],
                camera: Camera | Sequence[Camera], *, cull: str = "none", threads: int = 1, subpixel_bits: int = 8,
                progress: Callable[[int], object] | None = None) -> NDArray[np.floating[Any]]:
    """A vertex attribute at each pixel, perspective-correct: shape (height, width, k) or (views, height, width, k).

    attribute: for a scene of one mesh, an ndarray of shape (n,), (n, k) or (n, ...), numbers, with a row per vertex; else a
    list or tuple with one per mesh. ValueError for others. frame, camera, cull and subpixel_bits: of one draw of ids from 0 on,
    of this scene alone. Background: NaN. The result has the arrays' type, or a float type that holds it; the weights are those of
    barycentrics(), as is progress.
    """
    _check.id_frame(frame, 0, cull, subpixel_bits, threads)
    meshes = self._native.triangles()
    given = attribute if isinstance(attribute, (list, tuple)) else [attribute]
    arrays = [_check.as_array(values, "attribute", "an array, or a list of them") for values in given]
    if len(arrays) != len(meshes):
        raise ValueError(f"attribute: {len(arrays)} arrays given instead of {len(meshes)}; a list has one per mesh")
    rest = arrays[0].shape[1:] if arrays else ()
    for i, (array, (vertices, _)) in enumerate(zip(arrays, meshes)):
        if array.dtype.kind not in "iuf":
            raise ValueError(f"attribute: that of mesh {i} must be numbers, not {array.dtype}")
        if array.shape != (vertices, *rest):
            raise ValueError(f"attribute: that of mesh {i} has the shape {array.shape} instead of {(vertices, *rest)}")
    drawn, triangles, instances = _shown(self, frame)
    uv, _ = self.barycentrics(frame, camera, cull=cull, threads=threads, subpixel_bits=subpixel_bits, progress=progress)
    result = np.full((*drawn.shape, *rest), np.nan, np.result_type(np.float32, *arrays))
    if triangles.size:
        of_instance = np.array([mesh for mesh, _ in self.instances])[instances]
        first_triangle = np.cumsum([0, *(len(of_mesh) for _, of_mesh in meshes)])
        by_triangle = np.concatenate([array[of_mesh] for array, (_, of_mesh) in zip(arrays, meshes)])
        values = by_triangle[triangles + first_triangle[of_instance]]
        u, v = uv[drawn].T.astype(np.float64)  # the weights add up to 1 exactly
        result[drawn] = np.einsum("ip,pi...->p...", np.stack([1 - u - v, u, v]), values)
    return result


def _shown(self: edgewise.Scene, frame: Frame) -> tuple[NDArray[np.bool_], NDArray[np.int64], NDArray[np.intp]]:
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


def _alone(self: edgewise.Scene, camera: Camera | Sequence[Camera], size: tuple[int, int], cull: str, threads: int,
           subpixel_bits: int, progress: Callable[[int], object] | None) -> Iterator[NDArray[np.bool_]]:
    """Whether each pixel is drawn if an instance is alone, for each."""
    alone = edgewise.Scene()  # not a copy of self, whose class may draw otherwise
    alone._native = copy.deepcopy(self._native)
    instances = alone.instances
    for i in reversed(range(len(instances))):
        alone.remove_instance(i)
    for instance in instances:
        alone.add_instance(*instance)
        yield alone.draw(camera, size, cull=cull, threads=threads, depth_only=True, subpixel_bits=subpixel_bits,
                         progress=progress).depth != DEPTH_CLEAR
        alone.remove_instance(0)
