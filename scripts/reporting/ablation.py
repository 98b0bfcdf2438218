"""The ablation: one optimization more in each step, first of a backend's draw, then of the whole frame."""
from itertools import takewhile

from bench_rows import order
from noise import median
from speedups import about, kernels, speed_up
from tables import milliseconds

START = "naive"
NAMES = {"vector-setup": "+ SIMD set-up", "prefetch": "+ prefetch", "coverage-masks": "+ coverage masks",
         "hierarchical-depth": "+ HiZ", "stepped": "+ incremental edges", "tiles": "+ tiles",
         "tile-store": "+ choice of tile store"}


def parts(bench, scene):
    """Two lists of (label, row), each from the plainest to the last: draws of prepared triangles on one thread, and whole
    frames. The suite's own rows stand at the ends, those of the ablation between them. A part ends where a row is missing,
    since each label names the step from the row before."""
    rows = {row.keys["step"]: row for row in bench.sweep("step") if row.scene == scene}
    backend = list(rows.values())[-1].backend
    one, two = (bench.find(f"{backend}+frontend/{scene}/threads:{threads}") for threads in (1, 2))
    draws = [(f"{START}, 1 thread", bench.find(f"{START}/{scene}/threads:1")),
             *((NAMES.get(step, f"… with {kernels(step)}"), row) for step, row in rows.items() if not row.frontend),
             ("+ rows of empty tiles", bench.find(f"{backend}/{scene}/threads:1"))]
    frames = [("whole frame, 1 thread", rows.get("two-calls")), ("+ fusion, clusters", one),
              ("+ second thread", rows.get("one-tile-per-task")), ("+ several tiles per task", two)]
    return [list(takewhile(lambda named: named[1], part)) for part in (draws, frames)]


def said(before, row):
    """The speed-up over the step before; of the first step its time."""
    return speed_up(before.median_ms / row.median_ms) if before else f"{milliseconds(row)} ms"


def verdict(before, after):
    """Whether one optimization more made a difference."""
    return {-1: "gain", 0: "neither", 1: "loss"}[order(after, before)]


def summary(named):
    """The step that gains most; `named` are the draws of each scene."""
    gains = {}
    for found in named.values():
        for (_, before), (label, row) in zip(found, found[1:]):
            gains.setdefault(label, []).append(before.median_ms / row.median_ms)
    if not gains:
        return "Ablation"
    best = max(gains, key=lambda label: median(gains[label]))
    name = best.strip("+… ").removeprefix("with ")
    return f"{name[0].upper()}{name[1:]} gains most, {about(median(gains[best]))} in the median of scenes"
