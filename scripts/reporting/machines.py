"""Results of other machines, beside those that README.md shows."""
from bench_rows import describe_machine, read_bench, read_json
from speedups import mark
from peers import OURS, pairs
from tables import THREADS


def others(folder):
    """Results folders beside this one that have benchmark rows."""
    return [other for other in sorted(folder.resolve().parent.iterdir())
            if other != folder.resolve() and (other / "bench.json").exists() and (other / "machine.json").exists()]


def ratio_table(benches):
    """Header and lines: our backend's speed-up over each peer, on the most threads. `benches`: by the machine's name."""
    found = [pairs(bench) for bench in benches.values()]
    keys = dict.fromkeys((peer, scene) for ratios in found for peer, scene, _ in ratios)
    cells = [[ratios.get((peer, scene, max(THREADS))) for ratios in found] for peer, scene in keys]
    return (["scene", *(f"`{name}`" for name in benches)],
            [[f"{scene}, {peer}", *(mark(pair.ratio, pair.settled) if pair else "–" for pair in row)]
             for (peer, scene), row in zip(keys, cells)])


def other_machines(folder, where, layout):
    """A line and a chart for each other machine, and the peers' ratios on all machines, laid out by `layout` (see
    markdown()); `where` is `folder` as README.md names it."""
    beside = others(folder)
    if not beside:
        return "No other machine's results lie beside these."
    benches = {one.resolve().name: read_bench(one) for one in (folder, *beside)}
    lines, charts = [], []
    for other in beside:
        link = f"{where.rstrip('/').rpartition('/')[0]}/{other.name}".lstrip("/")
        lines.append(f"- [`{other.name}`]({link}): {describe_machine(read_json(other / 'machine.json'))}.")
        charts += ["", f"![`{other.name}`: ns per covered pixel against triangle area]({link}/charts/area.svg)"]
    header, rows = ratio_table(benches)
    if rows:
        lines += ["", f"Speed-up of `{OURS}` over its peers, on {max(THREADS)} threads with the widest SIMD of each machine:", "",
                  layout(header, rows, "|---|" + "--:|" * (len(header) - 1))]
    return "\n".join([*lines, *charts])
