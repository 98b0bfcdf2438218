"""The ablation: from the plainest backend to the fastest, one optimization more in each step."""
from bench_rows import order
from noise import median
from speedups import about, kernels, speed_up
from tables import milliseconds

START = "naive"
NAMES = {"vector-setup": "+ SIMD set-up", "prefetch": "+ prefetch", "coverage-masks": "+ coverage masks",
         "hierarchical-depth": "+ HiZ", "stepped": "+ incremental edges", "tiles": "+ tiles"}


def steps(bench, scene):
    """[(label, row)] from the plainest to the last: rows of the suite at both ends, those of the ablation between them."""
    rows = [row for row in bench.sweep("step") if row.scene == scene]
    backend = rows[-1].backend
    named = [(f"{START}, 1 thread", bench.find(f"{START}/{scene}/threads:1"))]
    named += [(NAMES.get(row.keys["step"], f"… with {kernels(row.keys['step'])}"), row) for row in rows]
    named += [("+ choice of tile store", bench.find(f"{backend}/{scene}/threads:1")),
              ("+ second thread", bench.find(f"{backend}/{scene}/threads:2"))]
    return [(label, row) for label, row in named if row]


def said(before, row):
    """The speed-up over the step before; of the first step its time."""
    return speed_up(before.median_ms / row.median_ms) if before else f"{milliseconds(row)} ms"


def verdict(before, after):
    """Whether one optimization more made a difference."""
    return {-1: "gain", 0: "neither", 1: "loss"}[order(after, before)]


def summary(named):
    """All steps on one thread together, and the one that gains most; `named` are the steps of each scene."""
    totals, gains = [], {}
    for found in named.values():
        single = [(label, row) for label, row in found if row.threads == 1]
        totals.append(single[0][1].median_ms / single[-1][1].median_ms)
        for (_, before), (label, row) in zip(single, single[1:]):
            gains.setdefault(label, []).append(before.median_ms / row.median_ms)
    if not gains:
        return "Ablation"
    best = max(gains, key=lambda label: median(gains[label]))
    name = best.strip("+… ").removeprefix("with ")
    return (f"All steps on one thread: {speed_up(min(totals))} to {speed_up(max(totals))} faster; {name} gains most, "
            f"{about(median(gains[best]))} in the median")
