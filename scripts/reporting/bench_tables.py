"""The tables of a machine's benchmark."""
import os

from bench_rows import describe_machine, gained, order, read_bench, records
from program import read_json
from tables import VECTORS, about, kernels, milliseconds, number, outcome

NOT_TIMED = "These results hold none of the rows for this."
THREADS = (1, 2)
OURS = "tiled"  # the backend that represents ours


def our_frames(bench, scene):
    """{backend: row} of whole frames on the most threads, and the backend that is settled as faster than each of several, or None."""
    rows = {backend: row for backend in bench.backends if (row := bench.frame(backend, scene, max(THREADS)))}
    fastest = (backend for backend, row in rows.items() if all(order(row, other) < 0 for other in rows.values() if other is not row))
    return rows, next(fastest, None) if len(rows) > 1 else None


def speed_table(bench):
    """Header and lines: whole frames of ours and of peers, one line per scene; bold: the settled fastest of ours."""
    lines = []
    for scene in bench.scenes:
        ours, fastest = our_frames(bench, scene)
        row = next(iter(ours.values()), None)
        sizes = [f"{row.counters['triangles']:,.0f}", f"{row.counters['overdraw']:.2f}"] if row else ["–", "–"]
        times = {backend: milliseconds(ours.get(backend)) for backend in bench.backends}
        times |= {peer: milliseconds(bench.frame(peer, scene, max(THREADS))) for peer in bench.peers}
        lines.append([scene, *sizes, *(f"**{ms}**" if who == fastest else ms for who, ms in times.items())])
    return ["scene", "triangles", "overdraw", *bench.backends, *bench.peers], lines


def pairs(bench, peer, threads, target=None):
    """[(our row, the peer's)] of whole frames, a pair per scene; ours with the SIMD of `target`, by default the widest."""
    rows = [(bench.frame(OURS, scene, threads, target), bench.frame(peer, scene, threads)) for scene in bench.scenes]
    return [pair for pair in rows if all(pair)]


def faster(bench, peer, threads=max(THREADS), target=None):
    """In how many scenes ours is faster than the peer, and by how much."""
    return outcome(pairs(bench, peer, threads, target))


def timed_peers(bench):
    return [peer for peer in bench.peers if pairs(bench, peer, max(THREADS))]


def peer_lines(bench):
    """A line per peer: its version, how much faster ours is with the widest SIMD and with that of the peer's width, and in how many pixels
    the pictures differ; or why there is none."""
    told = []
    for peer in timed_peers(bench):
        widest, version = bench.context["simd_target"], bench.context.get(peer, "unknown version")
        targets = [widest, *(target for target, (_, bits) in VECTORS.items() if target != widest and version.endswith(f", {bits} bits"))]
        speeds = [f"with {kernels(target)}, {VECTORS[target][1]} bits, "
                  + "; ".join(f"{faster(bench, peer, n, target)} on {n} thread{'s' * (n > 1)}" for n in THREADS if pairs(bench, peer, n, target))
                  for target in targets if pairs(bench, peer, max(THREADS), target)]
        most, why = max((row.counters.get(counter, 0), why) for n in THREADS for _, row in pairs(bench, peer, n) for counter, why in
                        (("depth_ties", "depth ties within tolerance"), ("wrong_px", "not portable")))
        told.append(f"- Against {peer} ({version}), whole frames by `{OURS}` are, {'; '.join(speeds)}. "
                    f"Pictures differ in at most {most:,.0f} pixels, all {why}.")
    return "\n".join(told) or "No other project's rasterizer was timed here; `scripts/run --peers` does."


# The SIMD engine of `tiled` with other numbers in its edge functions: what exactness costs, all else equal.
BASE = "exact"
WITH_MASKS = "with-masks"  # the backend's own row
RUNS = {WITH_MASKS: "`tiled` itself", "int64": "64-bit integers", "double": "doubles", "float": "floats",
        "float_rebased": "floats, relative to the tile", "int32": "32-bit integers that wrap"}


def against_base(base, row):
    """The speed relative to the base, bold if it is settled, and how many pixels are wrong."""
    if row is None:
        return "–"
    ratio = about(gained(base, row))
    wrong = row.counters.get("wrong_px")
    return (f"**{ratio}**" if order(row, base) else ratio) + (f"; {number(wrong)} px" if wrong else "")


def engine_table(bench):
    """Header and lines; no lines if no such row was timed."""
    scenes = {}
    for row in bench.sweep("engine"):
        scenes.setdefault(row.scene, {WITH_MASKS: bench.find(f"{OURS}/{row.scene}/threads:1")})[row.keys["engine"]] = row
    lines = [["exact, the base", *(f"{milliseconds(rows[BASE])} ms" for rows in scenes.values())]]
    lines += [[title, *(against_base(rows[BASE], rows.get(run)) for rows in scenes.values())] for run, title in RUNS.items()]
    return ["numbers", *(f"`{scene}`" for scene in scenes)], lines if scenes else []


def machines(folder, where):
    """A line for each machine, this one first: what it is, and how much faster ours is than each peer on it. `where` is `folder` as the
    README names it."""
    lines = []
    for path in records(folder, "bench"):
        machine, bench = path.resolve().parent, read_bench(path)
        told = [f"Against {peer}, `{OURS}` is {faster(bench, peer)}." for peer in timed_peers(bench)]
        link = os.path.normpath(f"{where}/../{machine.name}")
        lines.append(" ".join([f"- [`{machine.name}`]({link}): {describe_machine(read_json(machine / 'machine.json'))}.", *told]))
    return "\n".join(lines)
