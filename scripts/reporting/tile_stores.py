"""Whole frames back to back and after pauses, with the rule's tile stores and with streaming ones for all tiles."""
from bench_rows import order
from speedups import mark
from tables import milliseconds


def tile_stores_table(bench):
    """Header and lines; no lines if the rows were not timed. The speed-up of streaming stores stands behind their time."""
    pauses = {(row.scene, row.keys.get("stores")): row for row in bench.sweep("pause")}
    streamed = {row.scene: row for row in bench.sweep("stores") if "pause" not in row.keys}

    def cells(automatic, streaming):
        if automatic is None or streaming is None:
            return ["–", "–"]
        speed_up = mark(automatic.median_ms / streaming.median_ms, order(automatic, streaming) != 0)
        return [milliseconds(automatic), f"{milliseconds(streaming)}, {speed_up}"]

    lines = [[scene, *cells(bench.frame(row.backend, scene, row.threads), streamed.get(scene)), *cells(row, pauses.get((scene, "streaming")))]
             for (scene, stores), row in pauses.items() if stores is None]
    pause = next((row.keys["pause"].replace("ms", " ms") for row in pauses.values()), "")
    return ["scene", "back to back, ms", "all streamed", f"after {pause}, ms", "all streamed"], lines
