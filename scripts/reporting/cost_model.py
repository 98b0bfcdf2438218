"""The cost model of a frame: an estimate of the time to read triangles, draw blocks and write the frame."""
from tables import THREADS, milliseconds, number

# Scenes of few large triangles, on which the estimate comes near the measured time.
DETAILED = ("large", "grid64")


def estimates_ms(bench, row):
    """Three estimates: drawing only the blocks in which a triangle is visible, drawing all covered blocks, and the first
    with the frame stored tile by tile from a buffer. None if the row has no model."""
    c = bench.costs.get(row.name) if row else None
    if not c:
        return None
    covered = c["blocks_ms"] * c["covered_blocks"] / c["won_blocks"] if c["won_blocks"] else 0.0
    return (c["read_ms"] + c["blocks_ms"] + c["write_ms"], c["read_ms"] + covered + c["write_ms"],
            c["read_ms"] + c["blocks_ms"] + c["tiles_ms"])


def over_estimate(bench, backend, scene):
    """A backend's time over the estimate for tile stores, for each thread count."""
    rows = [row for n in THREADS if (row := bench.find(f"{backend}/{scene}/threads:{n}"))]
    found = [row.median_ms / estimates[2] for row in rows if (estimates := estimates_ms(bench, row))]
    return " / ".join(f"{ratio:.2f}" for ratio in found) or "–"


def estimate_columns(bench):
    """[(title, scene → cell)] for the table of scenes."""
    modelled = list(dict.fromkeys(row.backend for row in bench.rows.values() if estimates_ms(bench, row)))
    return [(f"{backend} / estimate", lambda scene, b=backend: over_estimate(bench, b, scene)) for backend in modelled]


def cost_model_table(bench):
    """Header and lines: the parts of the estimate for the rows on one thread."""
    lines = []
    for backend in bench.backends:
        for scene in DETAILED:
            row = bench.find(f"{backend}/{scene}/threads:1")
            if estimates := estimates_ms(bench, row):
                parts = (bench.costs[row.name][part] for part in ("read_ms", "blocks_ms", "write_ms"))
                lines.append([f"`{scene}`, {backend}", milliseconds(row), *map(number, (*parts, *estimates))])
    return ["1 thread, ms", "measured", "1. read", "2. blocks", "3. write", "estimate", "all covered blocks", "tile by tile"], lines
