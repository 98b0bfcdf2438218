"""The ablation: what each optimization is worth on each scene, one added at a time, beside the cost model's estimate."""
import math

from ablation import said, steps, verdict
from cost_model import estimates_ms
from palette import FAINT, INK, VERDICTS
from plot_style import headline, log_axis, plt, save

COLUMNS = 3


def panel(axes, bench, scene, named):
    times = [row.median_ms for _, row in named]
    places = range(len(named))
    axes.plot(times, places, color="#d0d7de", linewidth=1.4, zorder=2)
    for place, (time, (_, row)) in enumerate(zip(times, named)):
        before = named[place - 1][1] if place else None
        colour = VERDICTS[verdict(before, row)] if before else INK
        axes.plot([time], [place], marker="o", markersize=5.5, color=colour, zorder=3)
        axes.annotate(said(before, row), (time, place), xytext=(7, 0), textcoords="offset points", va="center", fontsize=8,
                      color=colour)
    for place, (_, row) in zip(places, named):
        if floors := estimates_ms(bench, row):
            axes.plot([floors[0], times[place]], [place, place], color=FAINT, linewidth=1.0, linestyle=":", zorder=1)
            axes.plot([floors[0]], [place], marker="|", markersize=11, markeredgewidth=2.2, color=FAINT, zorder=3)
    axes.set_title(scene, color=INK, fontweight="bold", pad=3)
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0, labelsize=9)
    axes.tick_params(axis="x", labelsize=9)


def ablation(bench, folder, caption):
    scenes = list(dict.fromkeys(row.scene for row in bench.sweep("rung")))
    if not scenes:
        return None
    named = {scene: steps(bench, scene) for scene in scenes}
    labels = max(([label for label, _ in steps_] for steps_ in named.values()), key=len)
    lines = math.ceil(len(scenes) / COLUMNS)
    figure, grid = plt.subplots(lines, COLUMNS, sharex=True, sharey=True, squeeze=False,
                                figsize=(11.5, 1.3 + lines * (0.55 + 0.2 * len(labels))))
    panels = list(grid.flat)
    for axes, scene in zip(panels, scenes):
        panel(axes, bench, scene, named[scene])
    for axes in panels[len(scenes):]:
        axes.set_visible(False)
    panels[0].set_xscale("log")
    log_axis(panels[0].xaxis)
    times = [row.median_ms for steps_ in named.values() for _, row in steps_]
    floors = [found[0] for steps_ in named.values() for _, row in steps_ if (found := estimates_ms(bench, row))]
    panels[0].set_xlim(min(times + floors) / 1.6, max(times) * 8)
    panels[0].set_yticks(range(len(labels)), labels)
    panels[0].set_ylim(len(labels) - 0.4, -0.6)
    for axes in grid[-1]:
        axes.set_xlabel("ms a frame", fontsize=9.5)
    height = figure.get_figheight()
    top = headline(figure, "What each idea is worth", "Line by line one idea more, on one thread up to the last; figures say "
                   "how many times faster than the line above.\nBlue: faster; vermilion: slower; grey: not "
                   "settled. Grey bars: the estimate of a cost model.")
    figure.subplots_adjust(left=0.135, right=0.985, bottom=0.72 / height, top=top - 0.3 / height, wspace=0.06,
                           hspace=0.55 / (0.2 * len(labels)))
    save(figure, folder, "ablation", caption)
    return "ablation"


CHARTS = (ablation,)
