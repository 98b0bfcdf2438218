"""The SIMD engine of `tiled` with other numbers in its edge functions: what exactness costs, all else equal."""
from bench_rows import order
from noise import ratio_interval
from tables import milliseconds, number

BASE = "exact"
WITH_MASKS = "with-masks"  # the backend's own row
RUNS = {WITH_MASKS: "`tiled` with coverage masks", "int64": "64-bit integers", "double": "doubles", "float": "floats",
        "float_rebased": "floats, relative to the tile", "int32": "32-bit integers that wrap"}


def by_scene(bench):
    """Of each scene with the base: the rows by run."""
    found = {}
    for row in bench.sweep("engine"):
        found.setdefault(row.scene, {})[row.keys["engine"]] = row
    for scene, rows in found.items():
        own = bench.find(f"{next(iter(rows.values())).backend}/{scene}/threads:1")
        if own:
            rows[WITH_MASKS] = own
    return {scene: rows for scene, rows in found.items() if BASE in rows}


def against(base, row):
    """The speed relative to the base, bold if it is settled, its interval, and how many pixels are wrong."""
    if row is None:
        return "–"
    low, high = (f"{end:.2f}" for end in ratio_interval(row.times_ms, base.times_ms))
    ratio = f"{base.median_ms / row.median_ms:.2f}×"
    wrong = row.counters.get("wrong_px")
    return (f"**{ratio}**" if order(row, base) else ratio) + f" ({low} to {high})" + (f"; {number(wrong)} px" if wrong is not None else "")


def engine_table(bench):
    """Header and lines; no lines if no such row was timed."""
    scenes = by_scene(bench)
    lines = [["exact, the base", *(f"{milliseconds(rows[BASE])} ms" for rows in scenes.values())]]
    for run, title in RUNS.items():
        if any(run in rows for rows in scenes.values()):
            lines.append([title, *(against(rows[BASE], rows.get(run)) for rows in scenes.values())])
    return ["numbers", *(f"`{scene}`" for scene in scenes)], lines if scenes else []
