"""Compares the rows of other projects' rasterizers with ours: the same scene, work and number of threads."""
from dataclasses import dataclass

from bench_rows import Row, order
from speedups import mark, with_width
from tables import THREADS, milliseconds

OURS = "tiled"  # the backend that represents ours


@dataclass
class Pair:
    peer: Row
    ours: Row

    @property
    def ratio(self):
        """The speed-up of ours over the peer."""
        return self.peer.median_ms / self.ours.median_ms

    @property
    def settled(self):
        return order(self.ours, self.peer) != 0


def pair(bench, peer, scene, threads, target=None):
    """Of whole frames, with the kernels of `target` or the widest; None if either side was not timed."""
    row, ours = bench.frame(peer, scene, threads), bench.frame(OURS, f"{scene}/target:{target}" if target else scene, threads)
    return Pair(row, ours) if row and ours else None


def pairs(bench, target=None):
    """All pairs, by (peer, scene, threads)."""
    keys = ((peer, scene, n) for peer in bench.peers for scene in bench.scenes for n in THREADS)
    return {key: found for key in keys if (found := pair(bench, *key, target))}


def with_ratios(bench, header, lines):
    """A scene table with a further column for each peer, on the most threads."""
    found = pairs(bench)
    for peer in dict.fromkeys(peer for peer, _, _ in found):
        header = [*header, f"whole frame: {OURS} over {peer}"]
        lines = [[*line, mark(p.ratio, p.settled) if (p := found.get((peer, line[0], max(THREADS)))) else "–"]
                 for line in lines]
    return header, lines


def peer_table(bench, peer):
    """Header and lines: one line per scene that the peer drew; a cell has a figure for each number of threads."""
    widest, narrow = pairs(bench), pairs(bench, "avx2")
    compared = [(bench.context.get("simd_target"), widest), *([("avx2", narrow)] if any(key[2] == max(THREADS) for key in narrow) else [])]
    header = ["scene", f"{peer}, ms", f"{OURS}, ms", *(f"speed-up with {with_width(target)}" for target, _ in compared)]

    def joined(cells):
        return " / ".join(cells)

    lines = []
    for scene in bench.scenes:
        timed = [widest.get((peer, scene, n)) for n in THREADS]
        if not any(timed):
            continue
        cells = [joined(milliseconds(p and p.peer) for p in timed), joined(milliseconds(p and p.ours) for p in timed)]
        for _, found in compared:
            cells.append(joined(mark(p.ratio, p.settled) if (p := found.get((peer, scene, n))) else "–" for n in THREADS))
        lines.append([scene, *cells])
    return header, lines


def peer_tables(bench, layout):
    """Every peer's table, laid out by `layout`, below its version and the depth ties at which the pictures may differ; one line if
    no peer was timed."""
    told = []
    for peer in dict.fromkeys(peer for peer, _, _ in pairs(bench)):
        ties = max(p.peer.counters.get("depth_ties", 0) for (name, _, _), p in pairs(bench).items() if name == peer)
        told.append(f"{peer} ({bench.context.get(peer, 'unknown version')}), on {' / '.join(map(str, THREADS))} threads; pictures differ in "
                    f"at most {ties:,.0f} pixels, all depth ties within tolerance:\n\n{layout(*peer_table(bench, peer))}")
    return "\n\n".join(told) or "No other project's rasterizer was timed here; `scripts/run --peers` does."
