"""The ladder from the plainest backend to the fastest, one idea more on each line."""
from bench_rows import order
from tables import milliseconds

START = "naive"
NAMES = {"vector-setup": "+ set-up in vectors", "prefetch": "+ prefetch", "patches": "+ small ones in binning",
         "hierarchical-depth": "+ hierarchical depth", "stepped": "+ incremental edges", "tiles": "+ tiles"}


def steps(bench, scene):
    """[(label, row)] from the plainest to the last: rows of the suite at both ends, rungs between them."""
    rungs = [row for row in bench.sweep("rung") if row.scene == scene]
    backend = rungs[-1].backend
    named = [(f"{START}, 1 thread", bench.find(f"{START}/{scene}/threads:1"))]
    named += [(NAMES.get(row.keys["rung"], f"… in {row.keys['rung']}"), row) for row in rungs]
    named += [("+ write-out chosen", bench.find(f"{backend}/{scene}/threads:1")),
              ("+ second thread", bench.find(f"{backend}/{scene}/threads:2"))]
    return [(label, row) for label, row in named if row]


def said(before, row):
    """How many times faster than the step before; of the first its time."""
    return f"{before.median_ms / row.median_ms:.2f}×" if before else f"{milliseconds(row)} ms"


def verdict(before, after):
    """Whether one idea more made a difference. Slow rungs are drawn a few times, which settles large steps only."""
    larger, smaller = sorted((before.median_ms, after.median_ms), reverse=True)
    if min(len(before.times_ms), len(after.times_ms)) < 5 and larger < 1.5 * smaller:
        return "neither"
    return {-1: "gain", 0: "neither", 1: "loss"}[order(after, before)]
