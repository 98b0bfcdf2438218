"""The lower bound of a cost model under a frame's time, two estimates beside it, and how far above them the rows are."""
from tables import THREADS, milliseconds, number, short

# Few large triangles: here the model explains most of the time.
TOLD = ("large", "grid64")


def floors_ms(row):
    """The lower bound, where only the blocks that a triangle wins are drawn; the estimates for all blocks that it covers,
    and for a frame that is written tile by tile. None if they were not measured."""
    c = row.counters if row else {}
    if not c.get("floor_in_tiles_ms"):  # or the results are older than this figure
        return None
    others = c.get("floor_read_ms", 0.0) + c.get("floor_write_ms", 0.0)
    covered = c.get("floor_blocks_ms", 0.0) * c["covered_blocks"] / c["won_blocks"] if c.get("won_blocks") else 0.0
    return c["floor_ms"], others + covered, c["floor_in_tiles_ms"]


def ratios(bench, backend, scene, which):
    """A backend's time over a figure of floors_ms(), for each thread count."""
    rows = [row for n in THREADS if (row := bench.find(f"{backend}/{scene}/threads:{n}"))]
    return [row.median_ms / floors_ms(row)[which] for row in rows if floors_ms(row)]


def modelled(bench):
    """The backends that have the figures."""
    return list(dict.fromkeys(row.backend for row in bench.rows.values() if floors_ms(row)))


def bound_name(bench):
    """A bound that a row undercuts is none."""
    holds = all(ratio >= 1 for backend in modelled(bench) for scene in bench.scenes
                for ratio in ratios(bench, backend, scene, 0))
    return "lower bound" if holds else "estimate, won blocks"


def floor_columns(bench):
    """[(title, scene → cell)] for a table of scenes."""
    titles = (bound_name(bench), "estimate, covered blocks", "estimate, tile by tile")
    return [(f"{backend} / {title}",
             lambda scene, b=backend, w=which: " / ".join(f"{ratio:.2f}" for ratio in ratios(bench, b, scene, w)) or "–")
            for backend in modelled(bench) for which, title in enumerate(titles)]


def floor_table(bench):
    """Header and lines: one line a scene."""
    columns = floor_columns(bench)
    return ["scene", *(title for title, _ in columns)], [[scene, *(cell(scene) for _, cell in columns)] for scene in bench.scenes]


def floor_sentences(bench):
    """What the time of the rows on one thread consists of, as far as the model knows."""
    sentences = []
    for backend in bench.backends:
        for scene in TOLD:
            row = bench.find(f"{backend}/{scene}/threads:1")
            if not floors_ms(row):
                continue
            c, (won_ms, covered_ms, in_tiles_ms) = row.counters, floors_ms(row)
            sentences.append(
                f"`{scene}`, `{backend}` on one thread: {milliseconds(row)} ms, of which the {bound_name(bench)} explains "
                f"{number(won_ms)}: {number(c['floor_write_ms'])} for writing the frame, {number(c['floor_blocks_ms'])} for "
                f"{short(c['won_blocks'])} won blocks, {number(c['floor_read_ms'])} for reading triangles. Estimates: "
                f"{number(covered_ms)} ms if all {short(c['covered_blocks'])} covered blocks are drawn; {number(in_tiles_ms)} ms if the "
                f"frame is written tile by tile, which takes {number(c['floor_tiles_ms'])}.")
    return sentences
