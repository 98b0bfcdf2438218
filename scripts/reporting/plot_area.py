"""The cost of a covered pixel along the triangles' area: a curve for each backend."""
from bench_rows import order
from bench_tables import OURS
from plot_style import BLUE, GREEN, ORANGE, WIDTH_IN, headline, plt, save
from tables import short

LOOKS = {"scanline": (BLUE, "o"), "naive": (ORANGE, "s"), "tiled": (GREEN, "^")}
ADDED = "#7f5539", "D"  # for backends that a user adds


def area_curves(bench, threads):
    """{backend: {area: row}} by growing area"""
    rows = sorted((row for row in bench.sweep("area") if row.threads == threads and not row.frontend), key=lambda row: float(row.keys["area"]))
    return {backend: found for backend in bench.backends if (found := {float(row.keys["area"]): row for row in rows if row.backend == backend})}


def title(curves, threads):
    """At how many areas our backend is settled as the fastest."""
    others = [rows for backend, rows in curves.items() if backend != OURS]
    if OURS not in curves or not others:
        return "Cost of a covered pixel"
    won = sum(all(x in rows and order(row, rows[x]) < 0 for rows in others) for x, row in curves[OURS].items())
    return f"On {threads} thread{'s' if threads > 1 else ''}, {OURS} is fastest at {won} of {len(curves[OURS])} triangle areas"


def area(bench, folder, caption):
    all_threads = sorted({row.threads for row in bench.sweep("area")})
    if not all_threads:
        return None
    figure, [panels] = plt.subplots(1, len(all_threads), sharey=True, squeeze=False, figsize=(WIDTH_IN, 5.2))
    for axes, threads in zip(panels, all_threads):
        curves = area_curves(bench, threads)
        for backend, rows in curves.items():
            colour, marker = LOOKS.get(backend, ADDED)
            ns = [[ms * 1e6 / row.counters["covered_px"] for ms in (row.median_ms, *row.interval_ms)] for row in rows.values()]
            median, low, high = zip(*ns)
            axes.fill_between([*rows], low, high, color=colour, alpha=0.18, linewidth=0)
            axes.plot([*rows], median, color=colour, marker=marker, markeredgecolor="white", markeredgewidth=0.6, label=backend)
        axes.set(xscale="log", yscale="log", title=f"{threads} thread{'s' if threads > 1 else ''}", xlabel="area of a triangle, px")
        axes.xaxis.set_major_formatter(short)
        axes.yaxis.set_major_formatter(short)
    panels[0].set_ylabel("ns per covered pixel")
    panels[-1].legend(frameon=False)
    top = headline(figure, title(curves, all_threads[-1]),
                   "Random triangles of one area that together cover the same number of pixels; lower is better. Bands: 95 % intervals.")
    figure.subplots_adjust(left=0.07, right=0.985, bottom=0.145, top=top - 0.06, wspace=0.08)
    return save(figure, folder, "area", caption)
