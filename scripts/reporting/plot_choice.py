"""The main chart: which method to choose. Wrong pixels of a whole picture against its time, a panel for each kind of scene."""
import math

from matplotlib.ticker import LogLocator, NullLocator

from bench_rows import order
from choice import OURS, PEERS, TITLES
from plot_labels import Label, label_points
from plot_style import BAND, FAINT, GREEN, INK, WHISKER, foot_in, head_in, headline, plt, save
from tables import kernels, short

WIDTH_IN, PANEL_IN, GAP_IN = 6.4, 2.3, 0.75  # narrow, so that a phone shows it in readable type
FIRST = "tiled_8"  # of ours, whose label has its name
HOLE, PLAIN, FLOATS = "#cf222e", "#57606a", "#d8dee4"


def choice_title(panels):
    """In how many scenes one of ours is settled as faster than every other method without a hole."""
    def won(points):
        tight = [point for point in points if not point.wrong.holes]
        others = [point.row for point in tight if not point.method.startswith(OURS)]
        return any(all(order(point.row, other) < 0 for other in others) for point in tight if point.method.startswith(OURS))

    return f"Of these without holes, tiled is fastest in {sum(map(won, panels))} of {len(panels)} scenes"


def kind_of(point):
    """What a label's colour shows: whether a hole shows, and whether it is ours."""
    return bool(point.wrong.holes), point.method.startswith(OURS)


def labels_of(axes, points):
    """Points that lie on one another share a label."""
    groups = []
    for point in points:
        x, y = axes.transLimits.transform(axes.transScale.transform((point.wrong.mean, point.row.median_ms)))  # in parts of the panel
        near = [group for at_x, at_y, group in groups if abs(at_x - x) < 0.02 and abs(at_y - y) < 0.03 and kind_of(group[0]) == kind_of(point)]
        near[0].append(point) if near else groups.append((x, y, [point]))
    for _, _, group in groups:
        (hole, ours), methods = kind_of(group[0]), [point.method for point in group]
        bits = ", ".join(method.removeprefix(OURS) for method in methods)
        title = "\n".join(TITLES[method] for method in methods) if not ours else f"tiled, {bits} bits" if FIRST in methods else bits
        yield Label(group[0].wrong.mean, group[0].row.median_ms, title, colour=HOLE if hole else GREEN if ours else INK, bold=ours)


def draw_points(axes, points):
    """Returns the lines that labels keep off."""
    ours = [(point.wrong.mean, point.row.median_ms) for point in points if point.method.startswith(OURS)]
    axes.plot(*zip(*ours), color=GREEN, linewidth=1.5, zorder=2) if ours else None
    lines = [ours]
    for point in points:
        hole, is_ours = kind_of(point)
        colour = HOLE if hole else GREEN if is_ours else PLAIN
        x, y, ends = point.wrong.mean, point.row.median_ms, (point.wrong.least, point.wrong.most)
        axes.plot(ends, [y, y], color=colour, **WHISKER, zorder=1.8)
        axes.plot([x, x], point.row.interval_ms, color=colour, **WHISKER, zorder=1.8)
        axes.plot([x], [y], marker="^" if is_ours else "o", color=colour, markersize=7, markeredgecolor="white", markeredgewidth=0.8, zorder=3)
        lines.append([(end, y) for end in ends])
    return lines


def draw_panel(axes, panel, points):
    wrong = [n for point in points for n in point.wrong[:3] if n] or [1]
    least = 10.0 ** math.floor(math.log10(min(wrong)))  # below: the band of 0
    axes.set_xscale("symlog", linthresh=least, linscale=0.5)
    axes.set_xlim(-0.4 * least, max(*wrong, 10 * least) * 1.6)
    axes.xaxis.set_major_formatter(short)
    axes.axvspan(-least, 0.4 * least, color=BAND, zorder=0, linewidth=0)
    if panel.floats:
        axes.axvspan(-least, panel.floats.mean, color=FLOATS, zorder=0.5, linewidth=0)
    edges = [end for point in points for end in point.row.interval_ms]
    axes.set_yscale("log")
    axes.set_ylim(min(edges) / 1.35, max(edges) * 1.5)
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 3, 5, 7) if max(edges) < 6 * min(edges) else (1, 2, 5)))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_minor_locator(NullLocator())
    kind, _, rest = panel.summary.partition(": ")
    axes.set_title(rest, fontsize=9, color=FAINT, pad=4)
    axes.annotate(kind, (0, 1), xytext=(0, 17), xycoords="axes fraction", textcoords="offset points", fontsize=10.5, fontweight="bold")
    label_points(axes, list(labels_of(axes, points)), draw_points(axes, points))


def choice(accuracy, bench, folder, caption):
    found = [(panel, points) for panel in (accuracy.choices if accuracy else ()) if (points := panel.points(bench))]
    if not found:
        return None
    subtitle = (f"Wrong pixels of a picture, mean and range of {found[0][0].frames} frames, against its time, from vertices to picture, on one thread. "
                "Best is bottom left. Red: a hole shows in a frame. Dark grey: what projecting in floats alone gets wrong. Light grey: 0.")
    code = kernels(bench.context.get("simd_target"))
    peers = ("; peers are timed with their own projection and judged with ours"
             if any(point.method in PEERS for _, points in found for point in points) else "")
    notes = (f"Wrong: another triangle than in the exact picture of the scene's vertices. A hole: inside a surface, something else shows. Ours and the "
             f"laboratory's methods use {code} and our front end{peers}.\n{caption}")
    rows = (len(found) + 1) // 2
    above, below = head_in(subtitle, WIDTH_IN), foot_in(notes, WIDTH_IN)
    height = above + below + rows * (PANEL_IN + GAP_IN)
    figure, grid = plt.subplots(rows, 2, squeeze=False, figsize=(WIDTH_IN, height))
    headline(figure, choice_title([points for _, points in found]), subtitle)
    figure.subplots_adjust(left=0.09, right=0.99, bottom=below / height, top=1 - (above + 0.45) / height, wspace=0.17, hspace=GAP_IN / PANEL_IN)
    for axes, (panel, points) in zip(grid.flat, found):
        draw_panel(axes, panel, points)
    for axes in grid.flat[len(found):]:
        axes.set_visible(False)
    for axes in grid[-1]:
        axes.set_xlabel("wrong pixels")
    for axes in grid[:, 0]:
        axes.set_ylabel("ms")
    return save(figure, folder, "choice", notes)
