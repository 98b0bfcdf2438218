"""Exact, reproducible rasterization of triangles on the CPU.

    scene = edgewise.Scene.read_obj("bunny.obj")  # or edgewise.Scene(positions, triangles)
    ids, depth = scene.draw(scene.camera(640 / 480), (640, 480), ids=True)
    edgewise.write_image("ids.png", edgewise.id_colours(ids))

Screen: pixel [0, 0] is top left, and y points down. A pixel's only sample lies at its centre, (x + 0.5, y + 0.5).
Clip space, which is ``projection @ view @ world``: x points right, y up; visible where \\|x\\| <= w, \\|y\\| <= w and
0 <= z <= w; z = 0 is nearest. The front of a triangle is the side from which its vertices appear clockwise on the screen.
Pictures are the same, bit for bit, on every machine and for every backend and number of threads.

Matrices multiply column vectors, as in ``matrix @ column``. Input arrays are converted to the stated type. Numbers that become
floats are rounded. These are errors: complex numbers, text, objects, bools, masked arrays, numbers beyond the type's range, and
floats of more than 64 bits. A frame's planes are the caller's memory. They are neither converted nor copied, so another type is
an error.

Errors: ValueError for arguments, arrays' types among them; TypeError for arguments of another type, such as "2" or True for
2; OSError for files that cannot be read or written, among them unknown extensions; MemoryError. All name what is wrong.

All work that takes long releases the GIL. Ctrl-C ends a call of several cameras between two views. A call of one view ends
first. Python may exit while its threads draw.
"""
from __future__ import annotations

import copy
import copyreg
import math
from typing import TYPE_CHECKING, Any, Callable, NamedTuple, Sequence, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _check, _native
from .frames import (BACKGROUND_ID as BACKGROUND_ID, BLACK as BLACK, DEPTH_CLEAR as DEPTH_CLEAR, Camera as Camera, Frame as Frame,
                     Stats as Stats, amodal_masks as _amodal_masks, depth01 as depth01, id_colours as id_colours,
                     instance_ids as _instance_ids, interpolate as _interpolate, metric_depth as metric_depth,
                     visible_fraction as _visible_fraction)
from .pictures import (Difference as Difference, _Path, colours as _colours, diff as diff, read_image as read_image,
                       read_pfm as read_pfm, warn as _warn, write_image as write_image, write_pfm as write_pfm)

if TYPE_CHECKING:
    from . import lab

if int(np.__version__.split(".")[0]) >= 2 and _native.PYBIND11 < (2, 12):  # arrays would be read wrong, without an error
    raise ImportError(f"edgewise was built with pybind11 {'.'.join(map(str, _native.PYBIND11))}, which cannot read arrays of "
                      f"numpy {np.__version__}: install numpy below 2, or build edgewise with pybind11 2.12 or later")

__version__: str = _native.VERSION
BACKENDS: tuple[str, ...] = tuple(_native.BACKENDS)  # all draw the same pictures
IDENTITY = np.eye(4)

_Drawn = TypeVar("_Drawn", bound="_Drawable")


class Mesh(NamedTuple):
    """A mesh's positions, triangles and colours, copied. The normals and names that a file gives are not among them."""
    positions: NDArray[np.float32] | NDArray[np.float64]  # shape (n, 3); float64 if far from 0, else float32
    triangles: NDArray[np.uint32]  # shape (m, 3)
    colours: NDArray[np.uint32]  # shape (m,)
    two_sided: bool  # all triangles are


class Instance(NamedTuple):
    """Where a scene shows a mesh."""
    mesh: int
    matrix: NDArray[np.float64]  # shape (4, 4), from the mesh to the world


def look_at(eye: ArrayLike, target: ArrayLike, up: ArrayLike = (0.0, 1.0, 0.0)) -> NDArray[np.float64]:
    """The view, shape (4, 4), of a camera at `eye` that looks at `target`: x right, y up, and -z forward.

    All have the shape (3,). ValueError if the direction is 0, or parallel to `up` but for rounding.
    """
    eye, target, up = _check.vectors(eye=eye, target=target, up=up)
    back = eye - target
    right = np.cross(up, back)
    axes = np.array([right, np.cross(back, right), back])
    lengths = np.linalg.norm(axes, axis=1, keepdims=True)
    if not (np.isfinite(lengths) & (lengths > 0)).all() or \
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
    return _native.perspective(*_check.numbers(fov_y=fov_y, aspect=aspect, near=near, far=far))


def orthographic(left: float, right: float, bottom: float, top: float, near: float, far: float) -> NDArray[np.float64]:
    """The projection without perspective, shape (4, 4), from the same view space as perspective()'s.

    All are coordinates or distances in view space. left > right or bottom > top mirrors the picture. ValueError if two of
    these are equal, and unless near < far: projection_from() converts reversed depth.
    """
    return _native.orthographic(*_check.numbers(left=left, right=right, bottom=bottom, top=top, near=near, far=far))


def intrinsics(k: ArrayLike, width: int, height: int, near: float, far: float = math.inf, *,
               first_centre: float = 0.0) -> NDArray[np.float64]:
    """The projection of a camera with intrinsics, from a view space with x right, y down, and z forward.

    k: shape (3, 3), in pixels of a width x height image in which the centre of the first pixel lies at
    (first_centre, first_centre): 0 for OpenCV, 0.5 for COLMAP. Such a camera's view is the world-to-camera matrix.
    """
    return _native.intrinsics(_check.array(k, "k", np.float64), *_check.counts(width=width, height=height),
                              *_check.numbers(first_centre=first_centre, near=near, far=far))


def projection_from(projection: ArrayLike, *, z_from_minus_w: bool = False, y_down: bool = False,
                    reversed: bool = False) -> NDArray[np.float64]:
    """Converts a projection into another clip space to ours, shape (4, 4). The picture stays the same.

    z_from_minus_w: visible where -w <= z <= w (OpenGL). y_down: Vulkan. reversed: the near plane is where z is largest.
    """
    return _native.projection_from(_check.array(projection, "projection", np.float64),
                                   *_check.flags(z_from_minus_w=z_from_minus_w, y_down=y_down, reversed=reversed))


def pixel_hash(frame: Frame) -> int:
    """A number that is the same for the same picture, on every machine; what `edgewise hash` prints. One view only."""
    return _native.pixel_hash(*_check.frame(frame))


def visible_triangles(frame: Frame) -> tuple[NDArray[np.uint32], NDArray[np.int64]]:
    """What frames of ids show: flat, offsets. View i sees the ids flat[offsets[i]:offsets[i + 1]], in ascending order.

    One frame is view 0. offsets: shape (views + 1,).
    """
    views = _native.visible_triangles(*_check.frame(frame))
    return np.concatenate([*views, np.empty(0, np.uint32)]), np.cumsum([0, *map(len, views)])


class _Drawable:
    """What scenes and streams share. They keep the memory of their draws, so later ones are faster than the first.

    Several threads may use one; its draws take turns. Two scenes or streams draw at the same time. A forked child may use it
    unless a thread of its parent was changing it. After a draw of its parent on several threads, a child draws on one.
    copy.copy(), copy.deepcopy() and pickle make another one that holds the same and draws the same.
    """
    _native: Any

    def __copy__(self: _Drawn) -> _Drawn:
        return copy.deepcopy(self, {id(value): value for value in vars(self).values() if value is not self._native})

    def first_ids(self) -> NDArray[np.int64]:
        """The id of each instance's first triangle; then the number of triangles. Of a stream, 0 and the number."""
        return np.asarray(self._native.first_ids(), np.int64)

    def pixels_per_triangle(self, frame: Frame) -> NDArray[np.uint32]:
        """The number of pixels of each triangle in a frame of ids: shape (triangles,), or (views, triangles).

        The frame has ids from 0 on, of this alone. ValueError for an id that this lacks.
        """
        return self._native.pixels_per_triangle(*_check.frame(frame))

    def _draw(self, cameras: list[Camera], several: bool, size: tuple[int, int], first_id: int, cull: str, subpixel_bits: int,
              shade: bool, threads: int, backend: str, ids: bool, background: int | None,
              scissor: tuple[int, int, int, int] | None, onto: Frame | None, clear: bool, depth_only: bool,
              progress: Callable[[int], object] | None) -> Frame:
        width, height = _check.size(size)
        shape = (*((len(cameras),) if several else ()), height, width)
        ids, shade, clear, depth_only = _check.flags(ids=ids, shade=shade, clear=clear, depth_only=depth_only)
        if background is None:
            background = BACKGROUND_ID if ids else BLACK
        if scissor is not None:
            scissor = _check.integers(scissor, "scissor", 4, -_check.INT_MAX, _check.INT_MAX)
        options = (*_check.id_options(first_id, cull, subpixel_bits, threads), shade, _check.text(backend, "backend"),
                   _check.integer(background, "background", 0, _check.UINT_MAX))
        _check.callback(progress, "progress")
        if onto is None:
            def plane(value: int) -> NDArray[np.uint32]:  # the draw writes all pixels, unless there is a scissor
                return np.empty(shape, np.uint32) if scissor is None else np.full(shape, value, np.uint32)
            frame = Frame(None if depth_only else plane(background), plane(DEPTH_CLEAR))
        else:
            frame = _check.frame(onto, "onto")
            if np.shape(frame.depth) != shape:
                raise ValueError(f"onto has the shape {np.shape(frame.depth)}, not {shape}")
            if not clear and frame.depth.dtype.kind == "u" and np.max(frame.depth, initial=0) > DEPTH_CLEAR:
                raise ValueError("onto has a depth above DEPTH_CLEAR")
        frame.stats = Stats(*self._native.draw(*_check.matrices(cameras), None if depth_only else frame.payload, frame.depth,
                                               ids, *options, clear or onto is None, scissor, progress))
        frame.has_ids = getattr(onto, "has_ids", None) if depth_only else ids
        frame.subpixel_bits = getattr(onto, "subpixel_bits", None) if depth_only else subpixel_bits
        return frame


def _scene_of(meshes: list[Any], instances: list[Any], light: Any) -> Any:
    made = _native.Drawable()
    for mesh in meshes:
        made.add_mesh(*mesh)
    for instance in instances:
        made.add_instance(*instance)
    made.set_light(*light)
    return made


def _reduced(drawable: Any) -> tuple[Callable[..., Any], tuple[Any, ...]]:
    held = copy.deepcopy(drawable)  # other threads may change the original
    arrays = held.arrays()  # a tuple for a stream, a list for a scene
    return (_native.Drawable, arrays) if isinstance(arrays, tuple) else (_scene_of, (arrays, held.instances(), held.light()))


copyreg.pickle(_native.Drawable, _reduced)  # pybind11's py::pickle fails with protocols below 2


class Scene(_Drawable):
    """Meshes, their instances, and a light. Clip space and the fronts of triangles are as this module says."""

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

        Warns of what the reader skips, such as missing materials. OSError for a file that cannot be read.
        """
        scene = cls.__new__(cls)
        scene._native, notes = _native.read_obj(_check.path(path, "path"))
        _warn(notes)
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
        triangles, (two_sided,) = _check.array(triangles, "triangles", np.uint32), _check.flags(two_sided=two_sided)
        flags = np.full(triangles.shape[:1], _native.TWO_SIDED, np.uint8) if two_sided else None
        return self._native.add_mesh(_check.points(positions), triangles, None if colours is None else _colours(colours), flags,
                                     None, None, [])

    def add_instance(self, mesh: int, matrix: ArrayLike = IDENTITY) -> int:
        """Places a mesh in the world by an affine matrix, shape (4, 4), and returns the instance's number."""
        return self._native.add_instance(*_check.counts(mesh=mesh), _check.array(matrix, "matrix", np.float64))

    def set_instance(self, instance: int, matrix: ArrayLike) -> None:
        """Moves an instance. matrix: affine, shape (4, 4), from the mesh's positions, as they were given, to the world."""
        self._native.set_instance(*_check.counts(instance=instance), _check.array(matrix, "matrix", np.float64))

    def remove_instance(self, instance: int) -> None:
        """Removes an instance. The numbers of later ones decrease by one."""
        self._native.remove_instance(*_check.counts(instance=instance))

    def set_positions(self, mesh: int, positions: ArrayLike) -> None:
        """Moves a mesh's vertices, for animation. positions: as many as before, as add_mesh() takes them; they are copied."""
        self._native.set_positions(*_check.counts(mesh=mesh), _check.points(positions))

    def set_light(self, direction: Sequence[float]) -> None:
        """The direction towards the light, in world space: three numbers, finite, and of any length but 0."""
        self._native.set_light(*_check.vectors(direction=direction)[0])

    @property
    def meshes(self) -> tuple[Mesh, ...]:
        """The meshes by number, copied."""
        return tuple(Mesh(positions + origin if origin.any() else positions, triangles, colours,
                          flags is not None and bool((flags & _native.TWO_SIDED).all()))
                     for positions, triangles, colours, flags, _, origin, _ in self._native.arrays())

    @property
    def instances(self) -> tuple[Instance, ...]:
        """The instances by number."""
        return tuple(Instance(*instance) for instance in self._native.instances())

    @property
    def light(self) -> NDArray[np.float32]:
        """The direction towards the light, in world space, shape (3,)."""
        return self._native.light()

    def bounds(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The lowest and the highest corner, shape (3,), of the box around all instances. Infinite if it is empty."""
        return self._native.bounds()

    def camera(self, aspect: float) -> Camera:
        """A camera that sees the whole scene in images whose width is `aspect` times their height."""
        return Camera(*self._native.camera(*_check.numbers(aspect=aspect)))

    def draw(self, camera: Camera | Sequence[Camera], size: tuple[int, int], *, ids: bool = False, first_id: int = 0,
             cull: str = "none", shade: bool = True, threads: int = 1, backend: str = "tiled", background: int | None = None,
             scissor: tuple[int, int, int, int] | None = None, onto: Frame | None = None, clear: bool = False,
             depth_only: bool = False, subpixel_bits: int = 8, progress: Callable[[int], object] | None = None) -> Frame:
        """Draws the scene, seen by one camera or by several.

        size: width, height in pixels, at most 16384.
        ids: payloads are ids, not colours.
        first_id: the id of the first triangle; in a draw over others, the number of their triangles.
        cull: none, back, front or both; the C++ library's default is back.
        shade: multiplies colours by the light.
        threads: of front end and backend, 1 to 256; a forked child has one.
        backend: one of BACKENDS, or a composition of `edgewise list --all`; all draw the same picture.
        background: the payload of pixels that no triangle covers; by default BACKGROUND_ID or BLACK.
        scissor: x, y, width, height, the only pixels to draw. The others keep what `onto` holds, or are background.
        onto: a frame that is drawn over, as if both draws were one, and returned as a new Frame of the same arrays. Rows must
          be contiguous, views must not overlap, and payload and depth have the same strides. Unless it is cleared, no depth
          may exceed DEPTH_CLEAR.
        clear: clears `onto` first, inside the scissor.
        depth_only: neither makes nor writes payloads.
        subpixel_bits: x and y of vertices are rounded to multiples of 2**-subpixel_bits pixels: 4 to 15.
        progress: is called between views, at most 20 times a second, and at the end, with the number of views just done, as
          tqdm's update is. What it raises ends the draw, as Ctrl-C does. Meanwhile it and other threads may use the scene;
          later views show their changes.
        """
        return self._draw(_check.cameras(camera, "camera"), not isinstance(camera, Camera), size, first_id, cull, subpixel_bits,
                          shade, threads, backend, ids, background, scissor, onto, clear, depth_only, progress)

    def barycentrics(self, frame: Frame, camera: Camera | Sequence[Camera], *, first_id: int = 0, cull: str = "none",
                     threads: int = 1, subpixel_bits: int = 8, progress: Callable[[int], object] | None = None,
                     ) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Perspective-correct coordinates of the triangle's point that each pixel of a frame of ids shows.

        Returns uv, shape (height, width, 2), and distance along the view direction, shape (height, width); for a frame of
        several views, and as many cameras, (views, height, width, 2) and (views, height, width). A pixel's value
        of an attribute is (1 - u - v) a[0] + u a[1] + v a[2]. u, v and 1 - u - v are >= 0. The distance is w in clip space,
        so a projection with another scale has another unit; in a parallel projection it is the depth in 0 ... 1. Background:
        0 and infinity. u and v err by less than 2**-25 + 2**-47 + e / 2. The distance's relative error is below
        2**-24 + 2**-48 + e. Here e is 2**-20 times the largest ratio of a vertex's distance from the camera to its w, usually
        below 2**-19; 0 for a stream (barycentrics.h). progress: as for draw().
        ValueError if the frame shows something else than this scene, seen by this camera, with this culling and these subpixel
        bits. If it was drawn over another, pass a copy in which the pixels of the other have the depth DEPTH_CLEAR.
        """
        return self._native.barycentrics(*_check.matrices(_check.cameras(camera, "camera")),
                                         *_check.id_frame(frame, first_id, cull, subpixel_bits, threads),
                                         _check.callback(progress, "progress"))

    def objects(self) -> dict[str, NDArray[np.uint32]]:
        """The ids of the triangles of each object and group that an OBJ file names, ascending, through all instances.

        ``np.isin(frame.payload, scene.objects()["wheel"])`` is the mask of one, in a frame of ids with a first_id of 0. A
        triangle has an object and any number of groups. Names that are no UTF-8 are decoded as those of files.
        """
        return self._native.objects()

    def pixels_per_instance(self, frame: Frame) -> NDArray[np.uint32]:
        """The number of pixels of each instance in a frame as for pixels_per_triangle(): shape (instances,), or (views,
        instances)."""
        return self._native.pixels_per_instance(*_check.frame(frame))

    def pixels_per_mesh(self, frame: Frame) -> NDArray[np.uint32]:
        """The same of all instances of each mesh: shape (meshes,), or (views, meshes)."""
        return self._native.pixels_per_mesh(*_check.frame(frame))

    def visible(self, low: ArrayLike, high: ArrayLike, camera: Camera, frame: Frame) -> bool | NDArray[np.bool_]:
        """Whether boxes in world space could be seen in front of what a frame shows, drawn with that camera.

        low, high: corners, shape (3,), or (n, 3) for n answers. False is certain; True is not. The frame needs no payload.
        """
        low, high = _check.array(low, "low", np.float64), _check.array(high, "high", np.float64)
        seen = self._native.visible(np.atleast_2d(low), np.atleast_2d(high), *_check.matrices([_check.camera(camera)]),
                                    _check.frame(frame).depth)
        return bool(seen[0]) if low.ndim == 1 else seen

    instance_ids = _instance_ids
    amodal_masks = _amodal_masks
    visible_fraction = _visible_fraction
    interpolate = _interpolate

    def needs(self, cameras: Camera | Sequence[Camera], size: tuple[int, int], **options: Any) -> lab.Needs:
        """edgewise.lab.needs() of this scene."""
        return _laboratory().needs(self, cameras, size, **options)

    def portable(self, camera: Camera, size: tuple[int, int], **options: Any) -> lab.Portable:
        """edgewise.lab.portable() of this scene."""
        return _laboratory().portable(self, _check.camera(camera), size, **options)


class Stream(_Drawable):
    """Triangles that are already on the screen."""

    def __init__(self, vertices: ArrayLike, size: tuple[int, int], *, colours: ArrayLike | None = None, exact: bool = False):
        """vertices: shape (n, 3, 3), float32: per triangle and vertex, x and y in pixels, y down, and z in 0 ... 1, where
        smaller z is nearer. size: width, height in pixels of the image they are made for. colours: as Scene.add_mesh().
        exact: keeps float64, for positions that float32 would round, as it does those of 15 subpixel bits beyond 512 px."""
        kept = np.float64 if _check.flags(exact=exact)[0] else np.float32
        self._native = _native.Drawable(_check.array(vertices, "vertices", kept),
                                        None if colours is None else _colours(colours), *_check.size(size))

    @classmethod
    def read_tri(cls, path: _Path) -> Stream:
        """Reads a .tri file, such as `edgewise capture` writes. OSError for a file that cannot be read."""
        stream = cls.__new__(cls)
        stream._native = _native.read_tri(_check.path(path, "path"))
        return stream

    def write_tri(self, path: _Path) -> None:
        """Writes a .tri file: TRI1, or TRI2 if vertices are float64. OSError if it cannot be written."""
        self._native.write_tri(_check.path(path, "path"))

    @property
    def size(self) -> tuple[int, int]:
        """Width, height in pixels of the image that the triangles are made for."""
        return self._native.size()

    @property
    def vertices(self) -> NDArray[np.float32] | NDArray[np.float64]:
        """The vertices, as the constructor takes them, copied; float64 if they are exact, or read from a TRI2 file."""
        return self._native.arrays()[0]

    @property
    def colours(self) -> NDArray[np.uint32]:
        """The triangles' colours 0xAABBGGRR, shape (n,), copied."""
        return self._native.arrays()[1]

    def draw(self, size: tuple[int, int] | None = None, *, ids: bool = False, first_id: int = 0, cull: str = "none",
             threads: int = 1, backend: str = "tiled", background: int | None = None,
             scissor: tuple[int, int, int, int] | None = None, onto: Frame | None = None, clear: bool = False,
             depth_only: bool = False, subpixel_bits: int = 8) -> Frame:
        """Draws the triangles, unlit. size: by default the stream's; a smaller one crops the picture. The other arguments
        are those of Scene.draw()."""
        return self._draw([], False, self.size if size is None else size, first_id, cull, subpixel_bits, False, threads, backend,
                          ids, background, scissor, onto, clear, depth_only, None)

    def barycentrics(self, frame: Frame, *, first_id: int = 0, cull: str = "none", threads: int = 1,
                     subpixel_bits: int = 8) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """As Scene.barycentrics(); the distance is the depth in 0 ... 1."""
        return self._native.barycentrics(*_check.matrices([]), *_check.id_frame(frame, first_id, cull, subpixel_bits, threads),
                                         None)

    def needs(self, size: tuple[int, int] | None = None, **options: Any) -> lab.Needs:
        """edgewise.lab.needs() of this stream."""
        return _laboratory().needs(self, (), self.size if size is None else size, **options)

    def portable(self, size: tuple[int, int] | None = None, **options: Any) -> lab.Portable:
        """edgewise.lab.portable() of this stream."""
        return _laboratory().portable(self, (), self.size if size is None else size, **options)


def draw(positions: ArrayLike, triangles: ArrayLike, camera: Camera | Sequence[Camera], size: tuple[int, int],
         **options: Any) -> Frame:
    """The ids and depths of one mesh: Scene(positions, triangles).draw(camera, size, ids=True, **options).

    For a mesh that is drawn often, a Scene is faster.
    """
    return Scene(positions, triangles).draw(camera, size, **{"ids": True, **options})


def _laboratory() -> Any:
    from . import lab  # not with the package: it may not have been built
    return lab
