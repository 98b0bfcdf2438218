"""Whole frames back to back and after pauses, with the rule's tile stores and with streaming ones for all tiles."""
from bench_rows import order
from speedups import speed_up
from tables import milliseconds


def cells(rule, streaming):
    """The two times; behind the second, the speed-up of streaming over the rule."""
    ms = milliseconds(streaming)
    if rule and streaming:
        settled = order(rule, streaming) != 0
        ms += f" ({speed_up(rule.median_ms / streaming.median_ms)})" if settled else " (not settled)"
    return [milliseconds(rule), ms]


def tile_stores_table(bench):
    """Header and lines; no lines if the rows were not timed."""
    def find(row, keys):
        return bench.frame(row.backend, row.scene + keys, row.threads)

    streaming = "/stores:streaming"
    paused = [row for row in bench.sweep("pause") if "stores" not in row.keys]
    lines = [[row.scene, str(row.threads), *cells(find(row, ""), find(row, streaming)),
              *cells(row, find(row, f"/pause:{row.keys['pause']}{streaming}"))] for row in paused]
    after = f"after {paused[0].keys['pause'].replace('ms', ' ms')}" if paused else "after a pause"
    return ["scene", "threads", "back to back: rule, ms", "streaming, ms", f"{after}: rule, ms", "streaming, ms"], lines
