"""Compares the rows of other projects' rasterizers with ours: the same scene, work and number of threads."""
from dataclasses import dataclass

from bench_rows import Row
from tables import THREADS, milliseconds, scene_facts


@dataclass
class Pair:
    peer: Row
    ours: Row  # the fastest of our backends

    @property
    def ratio(self):
        """How many times longer the peer takes."""
        return self.peer.median_ms / self.ours.median_ms


def pair(bench, peer, scene, threads):
    """None where one side was not timed. Peers draw meshes as whole frames only, so ours are compared as such."""
    for with_frontend in ("", "+frontend"):
        row = bench.find(f"{peer}{with_frontend}/{scene}/threads:{threads}")
        ours = [r for b in bench.backends if (r := bench.find(f"{b}{with_frontend}/{scene}/threads:{threads}"))]
        if row and ours:
            return Pair(row, min(ours, key=lambda r: r.median_ms))
    return None


def pairs(bench):
    """All of them, by (peer, scene, threads)."""
    keys = ((peer, scene, n) for peer in bench.peers for scene in bench.scenes for n in THREADS)
    return {key: found for key in keys if (found := pair(bench, *key))}


def over_backend(bench, found, backend):
    """How many times longer the peer of a Pair takes than this one of our backends; None where it was not timed."""
    ours = found and bench.find(found.ours.name.replace(found.ours.backend, backend, 1))
    return found.peer.median_ms / ours.median_ms if ours else None


def times(ratio):
    return f"{ratio:.1f}×" if ratio >= 9.95 else f"{ratio:.2f}×"


def with_ratios(bench, header, lines):
    """A scene table with a further column for each peer, on the most threads."""
    found = pairs(bench)
    for peer in dict.fromkeys(peer for peer, _, _ in found):
        header = [*header, f"{peer} takes"]
        lines = [[*line, times(p.ratio) if (p := found.get((peer, line[0], max(THREADS)))) else "–"] for line in lines]
    return header, lines


def peer_table(bench, peer):
    """Header and lines: one line a scene that the peer drew."""
    found = pairs(bench)
    header = ["scene", "triangles", *(f"{peer}, {n}" for n in THREADS), *(f"ours, {n}" for n in THREADS),
              *(f"ratio, {n}" for n in THREADS), "near ties", f"ours, {max(THREADS)}, is", "from … to picture"]
    lines = []
    for scene in bench.scenes:
        timed = [found.get((peer, scene, n)) for n in THREADS]
        some = next((p for p in reversed(timed) if p), None)
        if not some:
            continue
        work = "mesh" if some.peer.frontend else "screen triangles"
        lines.append([scene, scene_facts(bench, scene)[0], *(milliseconds(p and p.peer) for p in timed),
                      *(milliseconds(p and p.ours) for p in timed), *(times(p.ratio) if p else "–" for p in timed),
                      f"{some.peer.counters.get('near_ties', 0):,.0f}", some.ours.backend, work])
    return header, lines


def peer_tables(bench, layout):
    """Every peer's version and table, laid out by `layout`; one line where no peer was timed."""
    timed = list(dict.fromkeys(peer for peer, _, _ in pairs(bench)))
    if not timed:
        return "No other project's rasterizer was timed here; `scripts/run --peers` does."
    return "\n\n".join(f"{peer} ({bench.context.get(peer, 'unknown version')}):\n\n{layout(*peer_table(bench, peer))}"
                       for peer in timed)
