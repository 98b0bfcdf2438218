"""The main chart: which method to choose. Wrong pixels of a whole picture against its time, a panel for each kind of scene."""
import math

from matplotlib.ticker import LogLocator, NullLocator

from bench_rows import order
from choice import OURS, TITLES
from plot_labels import place_labels
from plot_style import BAND, FAINT, GREEN, INK, chart, plt, save
from tables import kernels, short

WIDTH_IN, PANEL_IN = 6.4, 3.2  # narrow, so that a phone shows it in readable type
FIRST = "tiled_8"  # of ours, whose label has its name
HOLE, FLOATS = "#cf222e", "#d8dee4"
WHISKER = {"linewidth": 3.0, "alpha": 0.3, "solid_capstyle": "butt", "zorder": 1.8}  # an interval, as a light bar


def choice_title(panels):
    """In how many scenes one of ours is settled as faster than every other method without a hole."""
    def won(points):
        tight = [point for point in points if not point.wrong.holes]
        others = [point.row for point in tight if not point.method.startswith(OURS)]
        return any(all(order(point.row, other) < 0 for other in others) for point in tight if point.method.startswith(OURS))

    return f"Without holes, tiled is settled fastest in {sum(map(won, panels))} of {len(panels)} scenes"


def draw_points(axes, points):
    """Returns their labels, which lie on the points."""
    ours = [(point.wrong.mean, point.row.median_ms) for point in points if point.method.startswith(OURS)]
    axes.plot([x for x, _ in ours], [y for _, y in ours], color=GREEN, linewidth=1.5)
    labels = []
    for point in points:
        is_ours = point.method.startswith(OURS)
        colour = HOLE if point.wrong.holes else GREEN if is_ours else INK
        x, y = point.wrong.mean, point.row.median_ms
        axes.plot([point.wrong.least, point.wrong.most], [y, y], color=colour, **WHISKER)
        axes.plot([x, x], point.row.interval_ms, color=colour, **WHISKER)
        axes.plot(x, y, marker="^" if is_ours else "o", color=colour, markersize=7, markeredgecolor="white", markeredgewidth=0.8, zorder=3)
        name = point.method.removeprefix(OURS) if is_ours and point.method != FIRST else TITLES[point.method]
        labels.append(axes.annotate(name, (x, y), (0, 0), textcoords="offset pixels", color=colour, fontsize=9.5,
                                    fontweight="bold" if is_ours else "normal", va="bottom", zorder=5, in_layout=False,
                                    arrowprops={"arrowstyle": "-", "color": FAINT, "linewidth": 0.6, "shrinkA": 0, "shrinkB": 5}))
    return labels


def draw_panel(axes, panel, points):
    wrong = [n for point in points for n in point.wrong[:3] if n] or [1]
    least = 10.0 ** math.floor(math.log10(min(wrong)))  # below: the band of 0
    axes.set_xscale("symlog", linthresh=least, linscale=0.5)
    axes.set_xlim(-0.4 * least, max(*wrong, 10 * least) * 1.6)
    axes.xaxis.set_major_formatter(short)
    axes.axvspan(-least, 0.4 * least, color=BAND, zorder=0, linewidth=0)
    if panel.floats:
        axes.axvspan(-least, panel.floats.mean, color=FLOATS, zorder=0.5, linewidth=0)
    axes.set_yscale("log")
    axes.margins(y=0.18)
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 3, 5, 7)))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_minor_locator(NullLocator())
    kind, _, rest = panel.summary.partition(": ")
    axes.set_title(rest, fontsize=9, color=FAINT, pad=4)
    axes.annotate(kind, (0, 1), xytext=(0, 17), xycoords="axes fraction", textcoords="offset points", fontsize=10.5, fontweight="bold")
    return draw_points(axes, points)


def choice(accuracy, bench, folder, caption):
    found = [(panel, points) for panel in accuracy.choices if (points := panel.points(bench))] if accuracy else []
    if not found:
        return None
    subtitle = (f"Wrong pixels of a picture, mean and range of {found[0][0].frames} frames, against its time, from vertices to picture, on one "
                "thread. Best is bottom left. Red: a hole shows in a frame. Dark grey: what projecting in floats alone gets wrong. Light grey: 0.")
    notes = ("Wrong: another triangle than in the exact picture of the scene's vertices. A hole: inside a surface, something else shows. llvmpipe "
             "(SIMD of 256 bits) and SwiftShader (128 bits), where shown, are timed with their own projection and judged with ours. All others use "
             f"our front end and {kernels(bench.context['simd_target'])}; all but tiled get their floats ready-made.\n{caption}")
    rows = (len(found) + 1) // 2
    figure, grid = chart(choice_title([points for _, points in found]), subtitle, notes, rows * PANEL_IN, (rows, 2), WIDTH_IN)
    labels = [draw_panel(axes, *panel) for axes, panel in zip(grid.flat, found)]
    plt.setp(grid.flat[len(found):], visible=False)
    plt.setp(grid[-1], xlabel="wrong pixels")
    plt.setp(grid[:, 0], ylabel="ms")
    figure.draw_without_rendering()  # gives the axes their place
    figure.set_layout_engine("none")
    for texts in labels:
        place_labels(texts)
    return save(figure, folder, "choice")
