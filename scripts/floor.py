"""The floor under a frame's time, and how far above it the rows are: what must be read, drawn and written."""
from tables import THREADS, milliseconds, number, short

# Few large triangles: here the floor is near enough for its parts to be told from what is left.
TOLD = ("large", "grid64")


def floors_ms(row):
    """The floor if only the blocks that a triangle wins are drawn; if all that it covers are; and if the frame is
    written tile by tile from a buffer; None without."""
    c = row.counters if row else {}
    if not c.get("floor_in_tiles_ms"):  # or it is of before that was measured
        return None
    others = c.get("floor_read_ms", 0.0) + c.get("floor_write_ms", 0.0)
    covered = c.get("floor_blocks_ms", 0.0) * c["covered_blocks"] / c["won_blocks"] if c.get("won_blocks") else 0.0
    return c["floor_ms"], others + covered, c["floor_in_tiles_ms"]


def over_floor(bench, backend, scene, which):
    """How many times a floor's time a backend takes, for each thread count."""
    rows = [row for n in THREADS if (row := bench.find(f"{backend}/{scene}/threads:{n}"))]
    return ", ".join(f"{row.median_ms / floors_ms(row)[which]:.2f}" for row in rows if floors_ms(row)) or "–"


def floor_columns(bench):
    """[(title, scene → cell)] for the table of scenes."""
    floored = list(dict.fromkeys(row.backend for row in bench.rows.values() if floors_ms(row)))
    return [(f"{backend} / {title}", lambda scene, b=backend, w=which: over_floor(bench, b, scene, w))
            for backend in floored for which, title in enumerate(("floor", "floor of covered blocks", "floor in tiles"))]


def floor_sentences(bench):
    """What the time of the rows on one thread consists of, as far as the floor knows."""
    sentences = []
    for backend in bench.backends:
        for scene in TOLD:
            row = bench.find(f"{backend}/{scene}/threads:1")
            if not floors_ms(row):
                continue
            c, (won_ms, covered_ms, in_tiles_ms) = row.counters, floors_ms(row)
            sentences.append(
                f"`{scene}`, {backend} on one thread: {milliseconds(row)} ms. The floor has {number(c['floor_write_ms'])} for "
                f"writing the frame, {number(c['floor_blocks_ms'])} for {short(c['won_blocks'])} blocks won, "
                f"{number(c['floor_read_ms'])} for reading; {number(row.median_ms - won_ms)} ms are left. Were all "
                f"{short(c['covered_blocks'])} covered blocks to be drawn, it would be {number(covered_ms)} ms; were the frame written from the buffers of "
                f"tiles, each cleared first, which takes {number(c['floor_tiles_ms'])}, {number(in_tiles_ms)} ms.")
    return sentences
