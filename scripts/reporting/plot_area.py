"""The cost of a covered pixel along the triangles' area: curves, their settled crossings, and the fastest backend at each point."""
import math

from bench_rows import order
from bench_tables import OURS
from plot_labels import Label, label_points
from plot_style import INK, WIDTH_IN, Look, headline, log_axis, plt, save


def area_curves(bench, threads):
    """Per backend the points (area, row, scale) by growing area; times are to be multiplied by scale: ns per covered pixel."""
    points = {}
    for row in sorted(bench.sweep("area"), key=lambda row: float(row.keys["area"])):
        if row.threads == threads and not row.frontend:
            points.setdefault(row.backend, []).append((float(row.keys["area"]), row, 1e6 / row.counters["covered_px"]))
    return {backend: points[backend] for backend in bench.backends if backend in points}


def crossings(first, second):
    """The settled crossings of two curves over the same x, by straight lines on log axes.

    Left and right of a crossing the repetitions must settle the order of the two, the other way round.
    """
    by_x = {x: row for x, row, _ in second}
    decided = None  # (side, index of the point) that was last clear of noise
    shared = [(x, row, by_x[x], scale) for x, row, scale in first if x in by_x]
    logs = [(math.log(x), math.log(a.median_ms * scale), math.log(b.median_ms * scale)) for x, a, b, scale in shared]
    for index, (_, a, b, _) in enumerate(shared):
        side = order(a, b)
        if side and decided and side != decided[0]:
            for (x0, a0, b0), (x1, a1, b1) in reversed(list(zip(logs[decided[1]:index], logs[decided[1] + 1:index + 1]))):
                before, after = a0 - b0, a1 - b1
                if before * after < 0:
                    t = before / (before - after)
                    yield math.exp(x0 + t * (x1 - x0)), math.exp(a0 + t * (a1 - a0))
                    break
        if side:
            decided = side, index


def all_crossings(points):
    """(x, y, backend, other backend) of each, by growing x; `points` as of area_curves()."""
    names = list(points)
    return sorted((x, y, a, b) for i, a in enumerate(names) for b in names[i + 1:]
                  for x, y in crossings(points[a], points[b]))


def wins(points, backend):
    """(at how many x the backend is settled as the fastest, number of x that all drew); `points` as of area_curves()."""
    own, *others = ({x: row for x, row, _ in points[name]} for name in sorted(points, key=lambda name: name != backend))
    shared = [x for x in own if all(x in rows for rows in others)]
    return sum(all(order(own[x], rows[x]) < 0 for rows in others) for x in shared), len(shared)


def two_digits(px):
    return f"{float(f'{px:.2g}'):,.{0 if px >= 10 else 1}f}"


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


def mark_crossings(axes, points):
    """Rings and labels, placed off the curves. The axes must have their final place and limits."""
    labels = []
    for x, y, a, b in all_crossings(points):
        axes.plot([x], [y], marker="o", markersize=11, markerfacecolor="none", markeredgecolor=INK, markeredgewidth=1.3)
        labels.append(Label(x, y, f"{a} × {b}\n{two_digits(x)} px", type_size=9))
    label_points(axes, labels, [[(x, row.median_ms * scale) for x, row, scale in found] for found in points.values()])


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
    rings = any(all_crossings(points) for points in curves.values())
    look = Look(bench.backends)
    figure, panels = plt.subplots(1, len(all_threads), sharey=True, squeeze=False, figsize=(WIDTH_IN, 5.2))
    top = headline(figure, title(curves[all_threads[-1]], all_threads[-1]),
                   "Random triangles of one area that together cover the same number of pixels; lower is better. Bands: 95 % "
                   "intervals." + (" Rings: settled crossings of two curves." if rings else ""))
    look.legend(figure, top)
    figure.subplots_adjust(left=0.07, right=0.985, bottom=0.145, top=top - 0.12, wspace=0.08)
    for axes, threads in zip(panels[0], all_threads):
        draw_curves(axes, curves[threads], look)
        axes.set_title(f"{threads} thread{'s' if threads > 1 else ''}")
        axes.set_xlabel("area of a triangle, px")
    panels[0][0].set_ylabel("ns per covered pixel")
    for axes, threads in zip(panels[0], all_threads):
        mark_crossings(axes, curves[threads])
    save(figure, folder, "area", caption)
    return "area"
