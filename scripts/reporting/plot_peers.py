"""Chart of how many times faster our backends are than other projects' rasterizers."""
from speedups import about, with_width
from peers import OURS, pairs
from plot_scenes import gain_chart
from tables import THREADS


def against(bench, folder, caption):
    found = pairs(bench)
    threads = max(THREADS)
    for peer in dict.fromkeys(peer for peer, _, n in found if n == threads):
        compared = {scene: p for (name, scene, n), p in found.items() if name == peer and n == threads}

        def rows_of(scene, backend, compared=compared):
            ours = bench.find(compared[scene].ours.name.replace(OURS, backend, 1))
            return (compared[scene].peer, ours) if ours else None

        ratios = [p.ratio for p in compared.values()]
        title = (f"{OURS} is {about(min(ratios))} to {about(max(ratios))} faster than {peer}" if min(ratios) > 1 else
                 f"{OURS} runs at {about(min(ratios))} to {about(max(ratios))} the speed of {peer}")
        gain_chart(bench, folder, caption, f"against-{peer}", list(compared), rows_of, title,
                   f"{bench.context.get(peer, peer)}, against our backends with {with_width(bench.context.get('simd_target'))}; "
                   f"{threads} threads.\nMeshes from vertices to picture, streams from screen triangles to picture.",
                   f"time of {peer} over ours")
        yield f"against-{peer}"
