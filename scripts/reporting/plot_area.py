"""The cost of a covered pixel along the triangles' area; other charts of curves share its functions."""
import math

from area import all_crossings, area_curves, two_digits, wins
from peers import OURS
from plot_style import INK, WIDTH_IN, Look, headline, log_axis, plt, save, spread_labels


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


CHARTS = (area,)
