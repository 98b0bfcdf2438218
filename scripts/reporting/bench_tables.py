"""The tables of a machine's benchmark."""
import os

from bench_rows import describe_machine, gained, order, read_bench
from program import read_json
from tables import VECTORS, about, by_order, milliseconds, number, outcome, with_width

NOT_TIMED = "These results hold none of the rows for this."
THREADS = (1, 2)
OURS = "tiled"  # the backend that represents ours
GPU = "gpu"  # the peer that has no number of threads


def speed_table(bench):
    """Header and lines: whole frames of ours and of peers, one line per scene; bold: the settled fastest of ours."""
    lines = []
    for scene in bench.scenes:
        ours = {backend: row for backend in bench.backends if (row := bench.frame(backend, scene, max(THREADS)))}
        front, any_frame = bench.find(f"frontend/{scene}/threads:1"), next(iter(ours.values()), None)

        def cell(row):
            best = all(order(row, other) < 0 for other in ours.values() if other is not row)
            return f"**{milliseconds(row)}**" if best and len(ours) > 1 else milliseconds(row)

        lines.append([scene, f"{front.counters['triangles']:,.0f}" if front else "–", f"{any_frame.counters['overdraw']:.2f}" if any_frame else "–",
                      *(cell(ours[backend]) if backend in ours else "–" for backend in bench.backends),
                      *(milliseconds(peer_frame(bench, peer, scene, max(THREADS))) for peer in bench.peers)])
    return ["scene", "triangles", "overdraw", *bench.backends, *bench.peers], lines


def peer_frame(bench, peer, scene, threads):
    """A peer's whole frame. A GPU's has one row, which is compared with ours on any number of threads."""
    return bench.frame(peer, scene, 1 if peer == GPU else threads)


def pairs(bench, peer, target=None):
    """{(scene, threads): (the peer's row, ours)} of whole frames, ours with the kernels of `target` or the widest."""
    keys = f"/target:{target}" if target else ""
    found = {(scene, n): (peer_frame(bench, peer, scene, n), bench.frame(OURS, scene + keys, n)) for scene in bench.scenes for n in THREADS}
    return {key: rows for key, rows in found.items() if all(rows)}


def timed_peers(bench):
    return [peer for peer in bench.peers if pairs(bench, peer)]


def compared_targets(bench, peer):
    """[(SIMD target of ours, its pairs())]: the widest, and the one with vectors of the peer's width."""
    widest, version = bench.context.get("simd_target"), bench.context.get(peer, "")
    same = [(target, pairs(bench, peer, target)) for target, (_, bits) in VECTORS.items()
            if target != widest and version.endswith(f", {bits} bits")]
    return [(widest, pairs(bench, peer)), *((target, found) for target, found in same if found)]


def faster(found):
    """In how many scenes of pairs() ours is faster, and by how much, on each number of threads."""
    of = {n: [(ours, row) for (_, threads), (row, ours) in found.items() if threads == n] for n in THREADS}
    return "; ".join(f"{outcome(by_order(rows))} on {n} thread{'s' * (n > 1)}" for n, rows in of.items() if rows)


def peer_lines(bench):
    """A line per peer: its version, how much faster ours is, and in how many pixels the pictures differ; or why there is none."""
    told = []
    for peer in timed_peers(bench):
        rows = [row for row, _ in pairs(bench, peer).values()]
        most, why = max((row.counters.get(counter, 0), why) for row in rows for counter, why in
                        (("depth_ties", "depth ties within tolerance"), ("wrong_px", "not portable")))
        speeds = (f"with {with_width(target)}, {faster(found)}" for target, found in compared_targets(bench, peer))
        told.append(f"- Against {peer} ({bench.context.get(peer, 'unknown version')}), whole frames by `{OURS}` are, {'; '.join(speeds)}. Pictures differ in "
                    f"at most {most:,.0f} pixels, all {why}.")
    return "\n".join(told) or "No other project's rasterizer was timed here; `scripts/run --peers` does."


# The SIMD engine of `tiled` with other numbers in its edge functions: what exactness costs, all else equal.
BASE = "exact"
WITH_MASKS = "with-masks"  # the backend's own row
RUNS = {WITH_MASKS: "`tiled` itself", "int64": "64-bit integers", "double": "doubles", "float": "floats",
        "float_rebased": "floats, relative to the tile", "int32": "32-bit integers that wrap"}


def engine_rows(bench):
    """Of each scene with the base: the rows by run."""
    found = {}
    for row in bench.sweep("engine"):
        found.setdefault(row.scene, {})[row.keys["engine"]] = row
    for scene, rows in found.items():
        own = bench.find(f"{next(iter(rows.values())).backend}/{scene}/threads:1")
        if own:
            rows[WITH_MASKS] = own
    return {scene: rows for scene, rows in found.items() if BASE in rows}


def against_base(base, row):
    """The speed relative to the base, bold if it is settled, and how many pixels are wrong."""
    if row is None:
        return "–"
    ratio = about(gained(base, row))
    wrong = row.counters.get("wrong_px")
    return (f"**{ratio}**" if order(row, base) else ratio) + (f"; {number(wrong)} px" if wrong else "")


def engine_table(bench):
    """Header and lines; no lines if no such row was timed."""
    scenes = engine_rows(bench)
    lines = [["exact, the base", *(f"{milliseconds(rows[BASE])} ms" for rows in scenes.values())]]
    for run, title in RUNS.items():
        if any(run in rows for rows in scenes.values()):
            lines.append([title, *(against_base(rows[BASE], rows.get(run)) for rows in scenes.values())])
    return ["numbers", *(f"`{scene}`" for scene in scenes)], lines if scenes else []


def other_folders(folder):
    """Results folders beside this one that have benchmark rows."""
    return [other for other in sorted(folder.resolve().parent.iterdir())
            if other != folder.resolve() and (other / "bench.json").exists() and (other / "machine.json").exists()]


def machines(folder, where):
    """A line for each machine, this one first: what it is, and how much faster ours is than each peer on it. `where` is `folder` as the
    README names it."""
    lines = []
    for one in (folder, *other_folders(folder)):
        link, bench = os.path.normpath(f"{where}/../{one.resolve().name}"), read_bench(one)
        told = [f"Against {peer}, `{OURS}` is {outcome(by_order([(ours, row) for (_, n), (row, ours) in pairs(bench, peer).items() if n == max(THREADS)]))}."
                for peer in timed_peers(bench)]
        lines.append(" ".join([f"- [`{one.resolve().name}`]({link}): {describe_machine(read_json(one / 'machine.json'))}.", *told]))
    return "\n".join(lines)
