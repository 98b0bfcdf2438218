"""What the laboratory says of a scene or a stream. Scene.needs(), Scene.portable() and those of Stream call these functions.

The module is there if GMP and fmt were found when the package was built; else its import fails, and says so.
"""
from __future__ import annotations

from typing import Any, Callable, NamedTuple, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _check
from .frames import Camera

try:
    from . import _lab
except ImportError as error:
    raise ImportError("edgewise.lab needs GMP and fmt, also when edgewise is built: install them (Debian: libgmp-dev, libfmt-dev), "
                      f"then edgewise again ({error})") from error

UNSTABLE: tuple[str, ...] = tuple(_lab.UNSTABLE)  # the meanings of 0, 1, ... in Portable.reasons


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


class Level(NamedTuple):
    """One level of a stage while all other stages are exact, and its wrong pixels."""
    name: str
    mean: float  # wrong pixels per frame
    worst: int  # wrong pixels of the worst frame
    hidden: float  # per frame: those that show a triangle that the exact picture lacks
    farthest: float  # of the others, px: from such a pixel to the nearest one at which the exact picture shows the same
    witness: Witness | None  # the first wrong pixel of the first frame with more than are tolerated; None: it is enough


class Closest(NamedTuple):
    """The pipeline whose worst frame has the fewest wrong pixels."""
    levels: dict[str, str]  # level by stage
    worst: int


class Needs(NamedTuple):
    """What `edgewise needs` prints; see its --help."""
    frames: int
    minima: tuple[dict[str, str], ...]  # the least precise pipelines that are right: level by stage
    closest: Closest | None  # if none is right
    curves: dict[str, tuple[Level, ...]]  # by stage, each from the least precise level on
    edges: tuple[Question, ...]
    reach: dict[str, Reach]  # by plane; empty for streams
    edge_value_bits: tuple[int, ...]  # of integers that hold all edge values, for 0, 1, ... subpixel bits


def needs(drawable: Any, cameras: Camera | Sequence[Camera], size: tuple[int, int], *, cull: str = "none",
          displacement: float | None = None, tolerance: int = 0, threads: int = 1,
          progress: Callable[[int], object] | None = None) -> Needs:
    """The least precise pipelines that draw these frames of a scene right, or the frame of a stream, which has no cameras.

    As `edgewise needs` finds it, in seconds. Cameras must have a perspective projection and an affine view. displacement:
    pixels per 10**6 edge crossings that rounding may move; by default as many as with 8 subpixel bits. tolerance:
    wrong pixels in each frame of a right pipeline. progress: as in Scene.draw(); pipelines are judged after the last view.
    """
    return _needs(_lab.needs(drawable._native, *_check.matrices(_check.cameras(cameras, "cameras")), *_check.size(size),
                             _check.text(cull, "cull"),
                             None if displacement is None else _check.numbers(displacement=displacement)[0],
                             _check.integer(tolerance, "tolerance"), _check.threads(threads), _check.callback(progress, "progress")))


def portable(drawable: Any, cameras: Camera | Sequence[Camera], size: tuple[int, int], *, cull: str = "none", bits: int = 8,
             ulps: int = 2, guard_band: int = 3000, depth: str = "d24_unorm", threads: int = 1) -> Portable:
    """The pixels that rasterizers which follow Direct3D, Vulkan or WebGPU may draw differently, found as by `edgewise portable`.

    The camera of a scene must have a perspective projection and an affine view; a stream has none. bits: of subpixel
    positions, at least; 1 to 15. Draw the picture to compare others with, with as many subpixel_bits, but at least 8. ulps:
    error of the viewport transform. guard_band: how far triangles may reach beyond the picture, in px. depth: d16_unorm,
    d24_unorm or d32_sfloat.
    """
    reasons = _lab.portable(drawable._native, *_check.matrices(_check.cameras(cameras, "cameras")), *_check.size(size),
                            _check.text(cull, "cull"), *_check.counts(bits=bits, ulps=ulps, guard_band=guard_band),
                            _check.text(depth, "depth"), _check.threads(threads))
    counts = np.bincount(reasons.ravel(), minlength=len(UNSTABLE))
    return Portable(reasons, dict(zip(UNSTABLE, map(int, counts))))


def _needs(found: tuple) -> Needs:
    frames, minima, closest, curves, edges, reach, bits = found
    questions = tuple(Question(*facts, tuple(Answer(name, witness and Witness(*witness), wrong) for name, witness, wrong in
                                             answers)) for *facts, answers in edges)
    levels = {stage: tuple(Level(*facts, witness and Witness(*witness)) for *facts, witness in all_of) for stage, all_of in curves}
    return Needs(frames, tuple(minima), closest and Closest(*closest), levels, questions,
                 {plane: Reach(*counts) for plane, counts in reach.items()}, tuple(bits))
