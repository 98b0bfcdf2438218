"""Chart of our backends' speed-up over the peers."""
from peers import OURS, pairs
from plot_scenes import gain_chart
from speedups import by_order, spread, with_width
from tables import THREADS


def against(bench, folder, caption):
    found = pairs(bench)
    threads = max(THREADS)
    for peer in dict.fromkeys(peer for peer, _, n in found if n == threads):
        compared = {scene: p for (name, scene, n), p in found.items() if name == peer and n == threads}

        def rows_of(scene, backend, compared=compared):
            ours = bench.find(compared[scene].ours.name.replace(OURS, backend, 1))
            return (compared[scene].peer, ours) if ours else None

        won = by_order((p.ours, p.peer) for p in compared.values())[-1]
        title = f"{OURS} beats {peer} in {len(won)} of {len(compared)} scenes" + (f", {spread(won)}" if won else "")
        gain_chart(bench, folder, caption, f"against-{peer}", list(compared), rows_of, title,
                   f"{bench.context.get(peer, peer)}, against our backends with {with_width(bench.context.get('simd_target'))}; "
                   f"{threads} threads. Whole frames: front end and backend.",
                   f"speed-up over {peer}")
        yield f"against-{peer}"
