"""The cost of a covered pixel along the triangles' area: curves, their settled crossings, and the fastest backend at each point."""
import math

from bench_rows import order
from bench_tables import OURS
from plot_style import INK, WIDTH_IN, Look, headline, log_axis, plt, save, spread_labels


def curves(bench, key, threads, x_of, scale_of=lambda row: 1.0):
    """Per backend the points (x, row, scale) by growing x; times are to be multiplied by scale."""
    points = {backend: [] for backend in bench.backends}
    for row in bench.sweep(key):
        if row.threads == threads and row.backend in points and not row.frontend:
            points[row.backend].append((x_of(row), row, scale_of(row)))
    return {backend: sorted(found, key=lambda point: point[0]) for backend, found in points.items() if found}


def area_curves(bench, threads):
    """ns per covered pixel along the triangles' area."""
    return curves(bench, "area", threads, lambda row: float(row.keys["area"]),
                  lambda row: 1e6 / row.counters["covered_px"])


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
    """(x, y, backend, other backend) of each, by growing x; `points` as of curves()."""
    names = list(points)
    return sorted((x, y, a, b) for i, a in enumerate(names) for b in names[i + 1:]
                  for x, y in crossings(points[a], points[b]))


def wins(points, backend):
    """(at how many x the backend is settled as the fastest, number of x that all drew); `points` as of curves()."""
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


def label_ends(axes, points, look):
    low, high = axes.get_ylim()
    wanted = [math.log(found[-1][1].median_ms * found[-1][2]) for found in points.values()]
    heights = spread_labels(wanted, 0.055 * math.log(high / low))
    for (backend, found), height in zip(points.items(), heights):
        axes.annotate(backend, (found[-1][0], math.exp(height)), xytext=(7, 0), textcoords="offset points",
                      va="center", color=look.text_colour(backend), fontweight="bold", annotation_clip=False)


def free_place(axes, at, size, taken):
    """Offset in points, near a point, where a label of a size covers the fewest taken places (all in points)."""
    bounds = axes.get_window_extent().transformed(axes.figure.dpi_scale_trans.inverted())
    left, bottom, right, top = (72 * v for v in bounds.extents)
    best = None
    for distance in (34, 48, 64, 84, 110):
        for degrees in (60, 30, 75, 10, 100, -20, -60, 130, -100, -130, -150, -165):
            x = at[0] + distance * math.cos(math.radians(degrees)) - (size[0] if abs(degrees) > 90 else 0)
            y = at[1] + distance * math.sin(math.radians(degrees)) - size[1] / 2
            outside = x < left + 2 or y < bottom + 2 or x + size[0] > right or y + size[1] > top
            covered = sum(x - 4 < px < x + size[0] + 4 and y - 4 < py < y + size[1] + 4 for px, py in taken)
            score = covered + 100 * outside + distance / 15
            if best is None or score < best[0]:
                best = score, x, y
    return best[1:]


def mark_crossings(axes, points):
    """Rings and labels, placed off the curves. The axes must have their final place and limits."""
    def in_points(x, y):
        return axes.transData.transform((x, y)) * 72 / axes.figure.dpi

    taken = []
    for found in points.values():
        ends = [in_points(x, row.median_ms * scale) for x, row, scale in found]
        for (x0, y0), (x1, y1) in zip(ends, ends[1:]):
            taken += [(x0 + t / 10 * (x1 - x0), y0 + t / 10 * (y1 - y0)) for t in range(11)]
    for x, y, a, b in all_crossings(points):
        axes.plot([x], [y], marker="o", markersize=11, markerfacecolor="none", markeredgecolor=INK, markeredgewidth=1.3)
        size = (5.4 * (len(a) + len(b) + 3), 24)
        at = in_points(x, y)
        place = free_place(axes, at, size, taken)
        taken += [(place[0] + i * size[0] / 8, place[1] + j * size[1] / 3) for i in range(9) for j in range(4)]
        axes.annotate(f"{a} × {b}\n{two_digits(x)} px", (x, y), xytext=(place[0] - at[0], place[1] - at[1]),
                      textcoords="offset points", ha="left", va="bottom", fontsize=9, linespacing=1.1,
                      arrowprops={"arrowstyle": "-", "color": INK, "linewidth": 0.8, "shrinkB": 6})


def title(points, threads):
    """At how many areas our backend is the fastest."""
    if OURS not in points or len(points) < 2:
        return "Cost of a covered pixel"
    won, total = wins(points, OURS)
    return f"On {threads} thread{'s' if threads > 1 else ''}, {OURS} is fastest at {won} of {total} triangle areas"


def area(bench, folder, caption):
    look = Look(bench.backends)
    all_threads = sorted({row.threads for row in bench.sweep("area")})
    if not all_threads:
        return None
    curves = {threads: area_curves(bench, threads) for threads in all_threads}
    rings = any(all_crossings(points) for points in curves.values())
    figure, panels = plt.subplots(1, len(all_threads), sharey=True, squeeze=False, figsize=(WIDTH_IN, 5.2))
    top = headline(figure, title(curves[all_threads[-1]], all_threads[-1]),
                   "Random triangles of one area that together cover the same number of pixels; lower is better. Bands: 95 % "
                   "intervals." + (" Rings: settled crossings of two curves." if rings else ""))
    figure.subplots_adjust(left=0.07, right=0.925, bottom=0.145, top=top - 0.06, wspace=0.24)
    drawn = []
    for axes, threads in zip(panels[0], all_threads):
        points = curves[threads]
        draw_curves(axes, points, look)
        drawn.append((axes, points))
        axes.set_title(f"{threads} thread{'s' if threads > 1 else ''}")
        axes.set_xlabel("area of a triangle, px")
    panels[0][0].set_ylabel("ns per covered pixel")
    for axes, points in drawn:
        label_ends(axes, points, look)
        mark_crossings(axes, points)
    save(figure, folder, "area", caption)
    return "area"
