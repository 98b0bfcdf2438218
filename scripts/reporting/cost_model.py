"""The cost model of a frame: an estimate of the time to read triangles, draw blocks and write the frame."""
from tables import THREADS, milliseconds, number, short

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


def cost_model_sentences(bench):
    """The parts of the estimate for the rows on one thread."""
    sentences = []
    for backend in bench.backends:
        for scene in DETAILED:
            row = bench.find(f"{backend}/{scene}/threads:1")
            if not (estimates := estimates_ms(bench, row)):
                continue
            c, (won_ms, covered_ms, in_tiles_ms) = bench.costs[row.name], estimates
            sentences.append(
                f"`{scene}`, {backend} on one thread: {milliseconds(row)} ms measured, {number(won_ms)} ms estimated "
                f"({number(c['write_ms'])} to write the frame, {number(c['blocks_ms'])} for the {short(c['won_blocks'])} blocks with "
                f"a visible triangle, {number(c['read_ms'])} to read the triangles). With all {short(c['covered_blocks'])} covered "
                f"blocks the estimate is {number(covered_ms)} ms; with the frame stored tile by tile, {number(in_tiles_ms)} ms.")
    return sentences
