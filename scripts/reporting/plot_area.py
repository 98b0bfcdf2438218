"""The cost of a covered pixel along the triangles' area: a curve for each backend."""
from itertools import cycle

from bench_rows import order
from bench_tables import OURS
from plot_style import BLUE, GREEN, ORANGE, chart, save
from tables import short

LOOKS = (BLUE, "o"), (ORANGE, "s"), (GREEN, "^"), ("#7f5539", "D")  # the last is for a backend that a user adds


def area_title(threads, curves):
    """At how many areas our backend is settled as the fastest."""
    others = [rows for backend, rows in curves.items() if backend != OURS]
    if OURS not in curves or not others:
        return "Cost of a covered pixel"
    won = sum(all(x in rows and order(row, rows[x]) < 0 for rows in others) for x, row in curves[OURS].items())
    return f"On {threads}, {OURS} is fastest at {won} of {len(curves[OURS])} triangle areas"


def area(bench, folder, caption):
    panels = {}  # {threads: {backend: {area: row}}}
    for row in sorted(bench.sweep("area"), key=lambda row: (row.threads, bench.backends.index(row.drawer), float(row.keys["area"]))):
        curves = panels.setdefault(f"{row.threads} thread{'s' * (row.threads > 1)}", {})
        curves.setdefault(row.drawer, {})[float(row.keys["area"])] = row
    if not panels:
        return None
    figure, [grid] = chart(area_title(*[*panels.items()][-1]),
                           "Random triangles of one area that together cover the same number of pixels; lower is better. Bands: 95 % intervals.",
                           caption, 4.4, (1, len(panels)), sharey=True)
    for axes, (threads, curves) in zip(grid, panels.items()):
        for (backend, rows), (colour, marker) in zip(curves.items(), cycle(LOOKS)):
            ns = [[ms * 1e6 / row.counters["covered_px"] for ms in (row.median_ms, *row.interval_ms)] for row in rows.values()]
            median, low, high = zip(*ns)
            axes.fill_between([*rows], low, high, color=colour, alpha=0.18, linewidth=0)
            axes.plot([*rows], median, color=colour, marker=marker, markeredgecolor="white", markeredgewidth=0.6, label=backend)
        axes.set(xscale="log", yscale="log", title=threads, xlabel="area of a triangle, px")
        axes.xaxis.set_major_formatter(short)
        axes.yaxis.set_major_formatter(short)
    grid[0].set_ylabel("ns per covered pixel")
    grid[-1].legend(frameon=False)
    return save(figure, folder, "area")
