"""Exact, reproducible rasterization of triangles on the CPU.

    scene = edgewise.Scene.read_obj("bunny.obj")  # or edgewise.Scene(positions, triangles)
    ids, depth = scene.draw(scene.camera(640 / 480), (640, 480), ids=True)
    edgewise.write_image("ids.png", edgewise.id_colours(ids))

Screen: pixel [0, 0] is top left, and y points down. A pixel's only sample lies at its centre, (x + 0.5, y + 0.5).
Clip space, which is ``projection @ view @ world``: x points right, y up; visible where \\|x\\| <= w, \\|y\\| <= w and
0 <= z <= w; z = 0 is nearest. The front of a triangle is the side from which its vertices appear clockwise on the screen.
Pictures are the same, bit for bit, on every machine and for every backend and number of threads.

Matrices multiply column vectors, as in ``matrix @ column``. Arrays of input are converted to the type that is stated.
A frame's planes are the caller's memory: they are neither converted nor copied, so another type is an error.

Errors: ValueError for arguments, with the library's text; OSError for files that cannot be read or written, among them
unknown extensions; TypeError for arguments of another type, and for integers of over 32 bits, or below 0 where only those
from 0 on count; MemoryError. All work that takes long releases the GIL.
"""
from __future__ import annotations

import math
import warnings
from os import PathLike, fspath
from typing import Any, NamedTuple, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native

__version__: str = _native.VERSION
BACKENDS: tuple[str, ...] = tuple(_native.BACKENDS)  # all draw the same pictures
BACKGROUND_ID = 0xFFFFFFFF  # of pixels that no triangle covers, in frames of ids
BLACK = 0xFF000000
DEPTH_CLEAR: int = _native.DEPTH_CLEAR  # the depth of pixels that no triangle covers; all others are smaller
IDENTITY = np.eye(4)
UNSTABLE: tuple[str, ...] = tuple(_native.UNSTABLE)  # the meanings of 0, 1, ... in Portable.reasons

_Path = Union[str, "PathLike[str]"]


class Camera(NamedTuple):
    """Two matrices of shape (4, 4): world space to view space, and view space to clip space."""
    view: NDArray[np.float64]
    projection: NDArray[np.float64]


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
    payload: NDArray[np.uint32] | None
    depth: NDArray[np.uint32]


class Frame(_Planes):
    """What a draw wrote: shape (height, width), or (views, height, width) for several cameras. Screen: as this module says.

    A named tuple of two planes: ids, depth = frame. stats: the counts of the draw that returned it; else None.
    payload: uint32, ids or colours 0xAABBGGRR; None if only depth was drawn. An id is the number of a triangle, counted
    through the instances in order. Colours in memory are R, G, B, A: payload[..., None].view(np.uint8).
    depth: uint32, smaller is nearer; depth01() converts it.
    """
    stats: Stats | None = None


class Difference(NamedTuple):
    """How two pictures or depth maps differ outside a mask."""
    differing: int  # pixels
    largest: float  # difference of a channel or of a depth
    scale: int  # what `largest` is out of: 255, or 65535 if a file has 16 bits; 1 for depths
    first: tuple[int, int] | None  # x, y of the first pixel that differs, row by row
    masked: int  # pixels of the mask
    differing_in_mask: int
    picture: NDArray[np.uint32]  # grey where equal, red where not


class Portable(NamedTuple):
    """Which pixels show the same triangle in every conformant rasterizer's picture."""
    reasons: NDArray[np.uint8]  # shape (height, width): 0 if they do; else UNSTABLE[reason] says why they may not
    counts: dict[str, int]  # pixels by reason


class Witness(NamedTuple):
    """A pixel at which an answer shows an error."""
    frame: int
    x: int
    y: int
    right: tuple[int, ...]  # ids of triangles; none: background
    drawn: tuple[int, ...]


class Answer(NamedTuple):
    """One method or precision, and the first pixel that it draws wrong; None: it is enough."""
    name: str
    witness: Witness | None
    wrong_pixels: int  # in the frame of the witness


class Question(NamedTuple):
    """What one stage of a rasterizer needs."""
    name: str
    answer: str | None  # the least precise of `answers` that is enough; None: none is
    proof: str | None  # why it is enough; None: it was seen to be, in so many trials
    trials: int
    trial: str  # "pixel"
    error: str  # what Answer.wrong_pixels counts
    answers: tuple[Answer, ...]  # from the least precise on


class Reach(NamedTuple):
    """How many triangles a plane of the view volume, or the guard band, concerns."""
    beyond: int  # triangles with a vertex beyond it
    crossing: int  # of these, those that do not lie beyond one side of the view as a whole


class Needs(NamedTuple):
    """What `edgewise needs` prints; see its --help."""
    frames: int
    pipeline: tuple[Question, ...]  # the least precise pipeline that draws all frames right, by stage
    orders: int  # of weakening the stages, all tried
    others: tuple[dict[str, str], ...]  # what other orders lead to: level by stage
    unlike_scene: int  # pixels of the right pictures that are off the scene's own vertices by over 1/64 px
    alone: tuple[Question, ...]  # each stage, while the others are exact
    edges: tuple[Question, ...]
    reach: dict[str, Reach]  # by plane; empty for streams
    edge_value_bits: tuple[int, ...]  # of integers that hold all edge values, for 0, 1, ... subpixel bits


def look_at(eye: ArrayLike, target: ArrayLike, up: ArrayLike = (0.0, 1.0, 0.0)) -> NDArray[np.float64]:
    """The view, shape (4, 4), of a camera at `eye` that looks at `target`: x right, y up, and -z forward.

    All have the shape (3,). ValueError if the direction is 0, or parallel to `up` but for rounding.
    """
    eye = np.asarray(eye, np.float64)
    back = eye - np.asarray(target, np.float64)
    right = np.cross(np.asarray(up, np.float64), back)
    axes = np.array([right, np.cross(back, right), back])
    lengths = np.linalg.norm(axes, axis=1, keepdims=True)
    if axes.shape != (3, 3) or not (np.isfinite(lengths) & (lengths > 0)).all() or \
            lengths[0] < 1e-12 * lengths[2] * np.linalg.norm(up):
        raise ValueError("a view needs a direction, which must not be parallel to up")
    view = np.eye(4)
    view[:3, :3] = axes / lengths
    view[:3, 3] = -view[:3, :3] @ eye
    return view


def perspective(fov_y: float, aspect: float, near: float, far: float = math.inf) -> NDArray[np.float64]:
    """The projection, shape (4, 4), from a view space with x right, y up, and -z forward.

    fov_y: vertical field of view in radians. aspect: width / height. near, far: distances along the view direction, with
    0 < near < far. ValueError for others.
    """
    return _native.perspective(fov_y, aspect, near, far)


def orthographic(left: float, right: float, bottom: float, top: float, near: float, far: float) -> NDArray[np.float64]:
    """The projection without perspective, shape (4, 4), from the same view space as perspective()'s.

    All are coordinates or distances in view space. left > right or bottom > top mirrors the picture. ValueError if two of
    these are equal, and unless near < far: projection_from() converts reversed depth.
    """
    return _native.orthographic(left, right, bottom, top, near, far)


def intrinsics(k: ArrayLike, width: int, height: int, near: float, far: float = math.inf, *,
               first_centre: float = 0.0) -> NDArray[np.float64]:
    """The projection of a camera with intrinsics, from a view space with x right, y down, and z forward.

    k: shape (3, 3), in pixels of a width x height image in which the centre of the first pixel lies at
    (first_centre, first_centre): 0 for OpenCV, 0.5 for COLMAP. Such a camera's view is the world-to-camera matrix.
    """
    return _native.intrinsics(_array(k, np.float64), width, height, first_centre, near, far)


def projection_from(projection: ArrayLike, *, z_from_minus_w: bool = False, y_down: bool = False,
                    reversed: bool = False) -> NDArray[np.float64]:
    """Converts a projection into another clip space to ours, shape (4, 4). The picture stays the same.

    z_from_minus_w: visible where -w <= z <= w (OpenGL). y_down: Vulkan. reversed: the near plane is where z is largest.
    """
    return _native.projection_from(_array(projection, np.float64), z_from_minus_w, y_down, reversed)


def depth01(depth: NDArray[np.uint32]) -> NDArray[np.float64]:
    """Depths of a frame, of any shape, from 0, at the near plane, to 1, at the far plane and on background."""
    return np.clip((np.asarray(depth).astype(np.float64) - _native.DEPTH_HEAD) / _native.DEPTH_RANGE, 0.0, 1.0)


def id_colours(ids: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """A colour per id, another for each id below 2**24 - 1, as `edgewise render --payload id` writes.

    BACKGROUND_ID is black.
    """
    return (np.asarray(ids, np.uint32) + np.uint32(1)) * np.uint32(0x9E3779) & np.uint32(0xFFFFFF) | np.uint32(BLACK)


def pixel_hash(frame: Frame) -> int:
    """A number that is the same for the same picture, on every machine; what `edgewise hash` prints. One view only."""
    return _native.pixel_hash(*frame)


def visible_triangles(frame: Frame) -> tuple[NDArray[np.uint32], NDArray[np.int64]]:
    """What frames of ids show: flat, offsets. View i sees the ids flat[offsets[i]:offsets[i + 1]], in ascending order.

    One frame is view 0. offsets: shape (views + 1,).
    """
    views = _native.visible_triangles(*frame)
    return np.concatenate([*views, np.empty(0, np.uint32)]), np.cumsum([0, *map(len, views)])


def read_image(path: _Path) -> NDArray[np.uint32]:
    """A PNG or PPM file as colours 0xFFBBGGRR, shape (height, width). Alpha is ignored, 16-bit samples are rounded to 8."""
    return _native.read_image(_readable(path))


def write_image(path: _Path, colours: ArrayLike) -> None:
    """Writes colours as an 8-bit PNG or PPM, by the extension.

    colours: shape (height, width), uint32, 0xAABBGGRR; or (height, width, 3 or 4), uint8: R, G, B. Alpha is ignored.
    """
    _native.write_image(path, _colours(colours))


def read_pfm(path: _Path) -> NDArray[np.float32]:
    """The depth map of a PFM file, shape (height, width)."""
    return _native.read_pfm(_readable(path))


def write_pfm(path: _Path, depth: ArrayLike) -> None:
    """Writes a depth map, such as depth01() of a frame's depth, shape (height, width), as float32."""
    _native.write_pfm(path, _array(depth, np.float32))


def diff(a: _Path | ArrayLike, b: _Path | ArrayLike, mask: _Path | ArrayLike | None = None) -> Difference:
    """Compares two pictures or two depth maps, as `edgewise diff` does.

    a, b: files (.png, .ppm; .pfm), or arrays: colours as write_image() takes them, or depths of any float type, which are
    compared as float32. Planes of frames are neither: compare id_colours(ids) and depth01(depth). mask: a file, or an array of
    shape (height, width), or a picture. Pixels count as equal where it is not black or 0, so Portable.reasons is one.
    """
    depths = [fspath(x).lower().endswith(".pfm") if _is_path(x) else np.asarray(x).dtype.kind == "f" for x in (a, b)]
    if depths[0] != depths[1]:
        raise ValueError("a picture cannot be compared with a depth map")
    if mask is not None and not _is_path(mask):
        mask = _mask(mask)
    if depths[0]:
        return Difference(*_native.diff_depths(*(_readable(x) if _is_path(x) else _array(x, np.float32) for x in (a, b)), mask))
    return Difference(*_native.diff_pictures(*(_readable(x) if _is_path(x) else _colours(x) for x in (a, b)), mask))


class _Drawable:
    """What scenes and streams share. They keep the memory of their draws, so later ones are faster than the first."""
    _native: Any

    def first_ids(self) -> NDArray[np.int64]:
        """The id of each instance's first triangle; then the number of triangles. Of a stream, 0 and the number."""
        return np.asarray(self._native.first_ids(), np.int64)

    def pixels_per_triangle(self, frame: Frame) -> NDArray[np.uint32]:
        """The number of pixels of each triangle in a frame of ids: shape (triangles,), or (views, triangles).

        The frame shows this alone, drawn with a first_id of 0. ValueError for an id that this lacks.
        """
        return self._native.pixels_per_triangle(*frame)

    def _draw(self, cameras: Sequence[Camera], several: bool, size: tuple[int, int], options: tuple, ids: bool,
              background: int | None, scissor: tuple[int, int, int, int] | None, onto: Frame | None, clear: bool,
              depth_only: bool) -> Frame:
        width, height = size
        if not all(1 <= side <= _native.MAX_SIDE for side in size):
            raise ValueError(f"a frame of {width} x {height} px has a side outside 1 to {_native.MAX_SIDE}")
        shape = (*((len(cameras),) if several else ()), height, width)
        if background is None:
            background = BACKGROUND_ID if ids else BLACK
        if onto is None:
            def plane(value: int) -> NDArray[np.uint32]:  # the draw writes all pixels, unless there is a scissor
                return np.empty(shape, np.uint32) if scissor is None else np.full(shape, value, np.uint32)
            frame = Frame(None if depth_only else plane(background), plane(DEPTH_CLEAR))
        else:
            frame = Frame(*onto)
            if np.shape(frame.depth) != shape:
                raise ValueError(f"onto has the shape {np.shape(frame.depth)}, not {shape}")
            if not clear and np.max(frame.depth) > DEPTH_CLEAR:
                raise ValueError("onto has a depth above DEPTH_CLEAR")
        frame.stats = Stats(*self._native.draw(*_matrices(cameras), None if depth_only else frame.payload, frame.depth, ids,
                                               *options, background, clear or onto is None, scissor))
        return frame


class Scene(_Drawable):
    """Meshes, their instances, and a light. Clip space and the fronts of triangles are as this module says.

    Several threads may use a scene; its draws take turns. Scenes of their own let them draw at the same time.
    """

    def __init__(self, positions: ArrayLike | None = None, triangles: ArrayLike | None = None, *,
                 colours: ArrayLike | None = None, two_sided: bool = False):
        """Empty, or one mesh and one instance of it; see add_mesh()."""
        if (positions is None) != (triangles is None):
            raise ValueError("a mesh needs both positions and triangles")
        self._native = _native.Drawable()
        if positions is not None:
            self.add_instance(self.add_mesh(positions, triangles, colours=colours, two_sided=two_sided))

    @classmethod
    def read_obj(cls, path: _Path) -> Scene:
        """The mesh of a Wavefront OBJ file as one instance, with its colours, and with the fronts that OBJ defines.

        Warns of what the reader skips, such as missing materials.
        """
        scene = cls.__new__(cls)
        scene._native, notes = _native.read_obj(_readable(path))
        for note in notes:
            warnings.warn(note, stacklevel=2)
        return scene

    def add_mesh(self, positions: ArrayLike, triangles: ArrayLike, *, colours: ArrayLike | None = None,
                 two_sided: bool = False) -> int:
        """Adds a mesh, which only its instances show, and returns its number. Copies the arrays.

        positions: shape (n, 3), float32 or float64, to which other types are converted. In float64, a mesh far from 0 keeps
        its shape: coordinates lose at most 2**-24 of the longest side of its box (Mesh::set_positions in scene.h says how).
        triangles: shape (m, 3), integers, indices of positions. colours: shape (m,), uint32, 0xAABBGGRR, or (m, 3), uint8,
        RGB; else light grey. two_sided: no triangle is culled, and each is lit on the side that is seen. Triangles with NaN
        or infinity are not drawn: Frame.stats counts them. ValueError for an index out of range.
        """
        return self._native.add_mesh(_positions(positions), _indices(triangles),
                                     None if colours is None else _colours(colours), two_sided)

    def add_instance(self, mesh: int, matrix: ArrayLike = IDENTITY) -> int:
        """Places a mesh in the world by an affine matrix, shape (4, 4), and returns the instance's number."""
        return self._native.add_instance(mesh, _array(matrix, np.float64))

    def set_instance(self, instance: int, matrix: ArrayLike) -> None:
        """Moves an instance. matrix: affine, shape (4, 4), from the mesh's positions, as they were given, to the world."""
        self._native.set_instance(instance, _array(matrix, np.float64))

    def remove_instance(self, instance: int) -> None:
        """Removes an instance. The numbers of later ones decrease by one."""
        self._native.remove_instance(instance)

    def set_positions(self, mesh: int, positions: ArrayLike) -> None:
        """Moves a mesh's vertices, for animation. positions: as many as before, as add_mesh() takes them; they are copied."""
        self._native.set_positions(mesh, _positions(positions))

    def set_light(self, direction: Sequence[float]) -> None:
        """The direction towards the light, in world space: three numbers, finite, and of any length but 0."""
        self._native.set_light(*direction)

    def bounds(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The lowest and the highest corner, shape (3,), of the box around all instances. Infinite if it is empty."""
        return self._native.bounds()

    def camera(self, aspect: float) -> Camera:
        """A camera that sees the whole scene in images whose width is `aspect` times their height."""
        return Camera(*self._native.camera(aspect))

    def draw(self, camera: Camera | Sequence[Camera], size: tuple[int, int], *, ids: bool = False, first_id: int = 0,
             cull: str = "none", shade: bool = True, threads: int = 1, backend: str = "tiled", background: int | None = None,
             scissor: tuple[int, int, int, int] | None = None, onto: Frame | None = None, clear: bool = False,
             depth_only: bool = False) -> Frame:
        """Draws the scene, seen by one camera or by several.

        size: width, height in pixels, at most 16384.
        ids: payloads are ids, not colours.
        first_id: the id of the first triangle; in a draw over others, the number of their triangles.
        cull: none, back, front or both; the C++ library's default is back.
        shade: multiplies colours by the light.
        threads: 1 to 256.
        backend: one of BACKENDS, which draw the same picture.
        background: the payload of pixels that no triangle covers; by default BACKGROUND_ID or BLACK.
        scissor: x, y, width, height, the only pixels to draw. The others keep what `onto` holds, or are background.
        onto: a frame that is drawn over, as if both draws were one, and returned; else the frame is new. Rows must be
          contiguous, views must not overlap, and payload and depth have the same strides. Unless it is cleared, no depth
          may exceed DEPTH_CLEAR.
        clear: clears `onto` first, inside the scissor.
        depth_only: neither makes nor writes payloads.
        """
        several = not isinstance(camera, Camera)
        return self._draw(camera if several else [camera], several, size, (first_id, cull, shade, threads, backend), ids,
                          background, scissor, onto, clear, depth_only)

    def barycentrics(self, frame: Frame, camera: Camera, *, first_id: int = 0, cull: str = "none",
                     threads: int = 1) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Perspective-correct coordinates of the triangle's point that each pixel of a frame of ids shows.

        Returns uv, shape (height, width, 2), and distance along the view direction, shape (height, width). A pixel's value
        of an attribute is (1 - u - v) a[0] + u a[1] + v a[2]. u, v and 1 - u - v are >= 0. The distance is w in clip space,
        so a projection with another scale has another unit; in a parallel projection it is the depth in 0 ... 1. Background:
        0 and infinity. Errors of u and v are below 2**-25 + 2**-47 + e / 2, that of the distance below 2**-24 + 2**-48 + e of
        it, where e, usually below 2**-19, is 2**-20 times the largest ratio of a vertex's distance from the camera to its w,
        and 0 in a stream (barycentrics.h).
        ValueError if the frame shows something else than this scene, seen by this camera, with this culling. If it was drawn
        over another, pass a copy in which the pixels of the other have the depth DEPTH_CLEAR.
        """
        return self._native.barycentrics(*_matrices([camera]), *frame, first_id, cull, threads)

    def pixels_per_instance(self, frame: Frame) -> NDArray[np.uint32]:
        """The number of pixels of each instance in a frame as of pixels_per_triangle(): shape (instances,), or (views,
        instances)."""
        return self._native.pixels_per_instance(*frame)

    def pixels_per_mesh(self, frame: Frame) -> NDArray[np.uint32]:
        """The same of all instances of each mesh: shape (meshes,), or (views, meshes)."""
        return self._native.pixels_per_mesh(*frame)

    def visible(self, low: ArrayLike, high: ArrayLike, camera: Camera, frame: Frame) -> bool | NDArray[np.bool_]:
        """Whether boxes in world space could be seen in front of what a frame shows, drawn with that camera.

        low, high: corners, shape (3,), or (n, 3) for n answers. False is certain; True is not. The frame needs no payload.
        """
        low, high = _array(low, np.float64), _array(high, np.float64)
        seen = self._native.visible(np.atleast_2d(low), np.atleast_2d(high), *_matrices([camera]), frame[1])
        return bool(seen[0]) if low.ndim == 1 else seen

    def needs(self, cameras: Camera | Sequence[Camera], size: tuple[int, int], *, cull: str = "none",
              displacement: float | None = None, threads: int = 1) -> Needs:
        """The least precise pipeline that draws these frames right, as `edgewise needs` finds it. Takes seconds.

        Frames must have a perspective projection and an affine view. displacement: pixels per 10**6 edge crossings that
        rounding may move; by default as many as with 8 subpixel bits.
        """
        return _needs(self._native.needs(*_matrices([cameras] if isinstance(cameras, Camera) else cameras), *size, cull,
                                         displacement, threads))

    def portable(self, camera: Camera, size: tuple[int, int], *, cull: str = "none", bits: int = 8, ulps: int = 2,
                 guard_band: int = 3000, depth: str = "d24_unorm", threads: int = 1) -> Portable:
        """The pixels that rasterizers which follow Direct3D, Vulkan or WebGPU may draw differently, as `edgewise portable`
        finds them.

        The camera must have a perspective projection and an affine view. bits: of subpixel positions, at least; 1 to 8, until
        the library draws more. ulps: error of the viewport transform. guard_band: how far triangles may reach beyond the
        picture, in px. depth: d16_unorm, d24_unorm or d32_sfloat.
        """
        return _portable(self._native.portable(*_matrices([camera]), *size, cull, bits, ulps, guard_band, depth, threads))


class Stream(_Drawable):
    """Triangles that are already on the screen. Threads as in Scene."""

    def __init__(self, vertices: ArrayLike, size: tuple[int, int], *, colours: ArrayLike | None = None):
        """vertices: shape (n, 3, 3), float32: per triangle and vertex, x and y in pixels, y down, and z in 0 ... 1, where
        smaller z is nearer. size: width, height in pixels of the image they are made for. colours: as Scene.add_mesh()."""
        self._native = _native.stream(_array(vertices, np.float32), *size, None if colours is None else _colours(colours))

    @classmethod
    def read_tri(cls, path: _Path) -> Stream:
        """Reads a .tri file, such as `edgewise capture` writes."""
        stream = cls.__new__(cls)
        stream._native = _native.read_tri(_readable(path))
        return stream

    def write_tri(self, path: _Path) -> None:
        """Writes a .tri file."""
        self._native.write_tri(path)

    @property
    def size(self) -> tuple[int, int]:
        """Width, height in pixels of the image that the triangles are made for."""
        return self._native.size()

    def draw(self, size: tuple[int, int] | None = None, *, ids: bool = False, first_id: int = 0, cull: str = "none",
             threads: int = 1, backend: str = "tiled", background: int | None = None,
             scissor: tuple[int, int, int, int] | None = None, onto: Frame | None = None, clear: bool = False,
             depth_only: bool = False) -> Frame:
        """Draws the triangles, unlit. size: by default the stream's; a smaller one crops the picture. The other arguments
        are those of Scene.draw()."""
        return self._draw([], False, self.size if size is None else size, (first_id, cull, False, threads, backend), ids, background, scissor,
                          onto, clear, depth_only)

    def barycentrics(self, frame: Frame, *, first_id: int = 0, cull: str = "none",
                     threads: int = 1) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """As Scene.barycentrics(); the distance is the depth in 0 ... 1."""
        return self._native.barycentrics(*_matrices([]), *frame, first_id, cull, threads)

    def needs(self, size: tuple[int, int] | None = None, *, cull: str = "none", displacement: float | None = None,
              threads: int = 1) -> Needs:
        """As Scene.needs(), of one frame."""
        return _needs(self._native.needs(*_matrices([]), *(self.size if size is None else size), cull, displacement, threads))

    def portable(self, size: tuple[int, int] | None = None, *, cull: str = "none", bits: int = 8, ulps: int = 2,
                 guard_band: int = 3000, depth: str = "d24_unorm", threads: int = 1) -> Portable:
        """As Scene.portable()."""
        return _portable(self._native.portable(*_matrices([]), *(self.size if size is None else size), cull, bits, ulps, guard_band, depth,
                                               threads))


def draw(positions: ArrayLike, triangles: ArrayLike, camera: Camera | Sequence[Camera], size: tuple[int, int],
         **options: Any) -> Frame:
    """The ids and depths of one mesh: Scene(positions, triangles).draw(camera, size, ids=True, **options).

    For a mesh that is drawn often, a Scene is faster.
    """
    return Scene(positions, triangles).draw(camera, size, **{"ids": True, **options})


def _array(values: ArrayLike, dtype: Any) -> NDArray[Any]:
    return np.asarray(values, dtype, order="C")


def _positions(positions: ArrayLike) -> NDArray[Any]:
    array = np.asarray(positions)
    return _array(array, np.float32 if array.dtype == np.float32 else np.float64)


def _matrices(cameras: Sequence[Camera]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    if not all(isinstance(camera, Camera) for camera in cameras):
        raise ValueError("a camera must be an edgewise.Camera")
    views, projections = (np.array([camera[i] for camera in cameras], np.float64) for i in (0, 1))
    return views, projections


def _indices(triangles: ArrayLike) -> NDArray[np.uint32]:
    array = np.asarray(triangles)
    if array.size and array.dtype != np.uint32:
        if array.dtype.kind not in "iu":
            raise ValueError("triangles must be integers")
        if array.min() < 0 or array.max() > 0xFFFFFFFF:
            raise ValueError("an index of triangles is out of range")
    return _array(array, np.uint32)


def _colours(colours: ArrayLike) -> NDArray[np.uint32]:
    array = np.asarray(colours)
    if array.dtype == np.uint8 and array.ndim and array.shape[-1] in (3, 4):
        r, g, b = (array[..., i].astype(np.uint32) for i in range(3))
        return r | g << np.uint32(8) | b << np.uint32(16) | np.uint32(BLACK)
    if array.size and (array.dtype.kind not in "iu" or array.dtype == np.uint8):
        raise ValueError("colours must be integers 0xAABBGGRR, or R, G, B of type uint8")
    if array.size and array.dtype != np.uint32 and (array.min() < 0 or array.max() > 0xFFFFFFFF):
        raise ValueError("a colour is outside 0 to 0xFFFFFFFF")
    return _array(array, np.uint32)


def _mask(mask: ArrayLike) -> NDArray[np.uint32]:
    """A picture that is black where pixels count."""
    array = np.asarray(mask)
    if array.dtype == np.uint32 or array.dtype == np.uint8 and array.ndim == 3:
        return _colours(array)
    return np.where(array != 0, np.uint32(0xFFFFFFFF), np.uint32(BLACK))


def _is_path(value: Any) -> bool:
    return isinstance(value, (str, PathLike))


def _readable(path: _Path) -> _Path:
    """Raises FileNotFoundError, PermissionError, ... as Python does."""
    with open(path, "rb"):
        return path


def _needs(found: tuple) -> Needs:
    frames, pipeline, orders, others, unlike_scene, alone, edges, reach, bits = found

    def questions(all_of: list) -> tuple[Question, ...]:
        return tuple(Question(*facts, tuple(Answer(name, witness and Witness(*witness), wrong) for name, witness, wrong in
                                            answers)) for *facts, answers in all_of)

    return Needs(frames, questions(pipeline), orders, tuple(others), unlike_scene, questions(alone), questions(edges),
                 {plane: Reach(*counts) for plane, counts in reach.items()}, tuple(bits))


def _portable(reasons: NDArray[np.uint8]) -> Portable:
    counts = np.bincount(reasons.ravel(), minlength=len(UNSTABLE))
    return Portable(reasons, dict(zip(UNSTABLE, map(int, counts))))
