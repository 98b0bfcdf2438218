"""The cost of a covered pixel along the triangles' area: curves, and the fastest backend at each point."""
from bench_rows import order
from bench_tables import OURS
from plot_style import WIDTH_IN, Look, headline, log_axis, plt, save


def area_curves(bench, threads):
    """Per backend the points (area, row, scale) by growing area; times are to be multiplied by scale: ns per covered pixel."""
    points = {}
    for row in sorted(bench.sweep("area"), key=lambda row: float(row.keys["area"])):
        if row.threads == threads and not row.frontend:
            points.setdefault(row.backend, []).append((float(row.keys["area"]), row, 1e6 / row.counters["covered_px"]))
    return {backend: points[backend] for backend in bench.backends if backend in points}


def wins(points, backend):
    """(at how many x the backend is settled as the fastest, number of x that all drew); `points` as of area_curves()."""
    own, *others = ({x: row for x, row, _ in points[name]} for name in sorted(points, key=lambda name: name != backend))
    shared = [x for x in own if all(x in rows for rows in others)]
    return sum(all(order(own[x], rows[x]) < 0 for rows in others) for x in shared), len(shared)


def draw_curves(axes, points, look):
    axes.set_xscale("log")
    axes.set_yscale("log")
    for backend, found in points.items():
        x, rows, scales = zip(*found)
        median, low, high = ([t * scale for t, scale in zip(times, scales)] for times in
                             zip(*((row.median_ms, *row.interval_ms) for row in rows)))
        axes.fill_between(x, low, high, color=look.colour(backend), alpha=0.18, linewidth=0)
        axes.plot(x, median, color=look.colour(backend), marker=look.marker(backend), markeredgecolor="white",
                  markeredgewidth=0.6)
    log_axis(axes.xaxis)
    log_axis(axes.yaxis)


def title(points, threads):
    """At how many areas our backend is the fastest."""
    if OURS not in points or len(points) < 2:
        return "Cost of a covered pixel"
    won, total = wins(points, OURS)
    return f"On {threads} thread{'s' if threads > 1 else ''}, {OURS} is fastest at {won} of {total} triangle areas"


def area(bench, folder, caption):
    all_threads = sorted({row.threads for row in bench.sweep("area")})
    if not all_threads:
        return None
    curves = {threads: area_curves(bench, threads) for threads in all_threads}
    look = Look(bench.backends)
    figure, panels = plt.subplots(1, len(all_threads), sharey=True, squeeze=False, figsize=(WIDTH_IN, 5.2))
    top = headline(figure, title(curves[all_threads[-1]], all_threads[-1]),
                   "Random triangles of one area that together cover the same number of pixels; lower is better. Bands: 95 % "
                   "intervals.")
    look.legend(figure, top)
    figure.subplots_adjust(left=0.07, right=0.985, bottom=0.145, top=top - 0.12, wspace=0.08)
    for axes, threads in zip(panels[0], all_threads):
        draw_curves(axes, curves[threads], look)
        axes.set_title(f"{threads} thread{'s' if threads > 1 else ''}")
        axes.set_xlabel("area of a triangle, px")
    panels[0][0].set_ylabel("ns per covered pixel")
    save(figure, folder, "area", caption)
    return "area"
