"""Chart of the ablation: the speed-up by each optimization on each scene, beside the cost model's estimate."""
import math
from itertools import takewhile

from bench_rows import gained, order
from bench_tables import estimates_ms
from noise import median
from plot_style import FAINT, INK, VERDICTS, WIDTH_IN, head_in, headline, log_axis, plt, save
from tables import about, kernels, milliseconds, speed_up

START = "naive"
NAMES = {"vector-setup": "+ SIMD set-up", "prefetch": "+ prefetch", "coverage-masks": "+ coverage masks",
         "hierarchical-depth": "+ HiZ", "stepped": "+ incremental edges", "tiles": "+ tiles",
         "tile-store": "+ choice of tile store"}


def parts(bench, scene):
    """Two lists of (label, row), each from the plainest to the last: draws of prepared triangles on one thread, and whole
    frames. The suite's own rows stand at the ends, those of the ablation between them. A part ends where a row is missing,
    since each label names the step from the row before."""
    rows = {row.keys["step"]: row for row in bench.sweep("step") if row.scene == scene}
    backend = list(rows.values())[-1].backend
    one, two = (bench.find(f"{backend}+frontend/{scene}/threads:{threads}") for threads in (1, 2))
    draws = [(f"{START}, 1 thread", bench.find(f"{START}/{scene}/threads:1")),
             *((NAMES.get(step, f"… with {kernels(step)}"), row) for step, row in rows.items() if not row.frontend),
             ("+ rows of empty tiles", bench.find(f"{backend}/{scene}/threads:1"))]
    frames = [("whole frame, 1 thread", rows.get("two-calls")), ("+ fusion, clusters", one),
              ("+ second thread", rows.get("one-tile-per-task")), ("+ several tiles per task", two)]
    return [list(takewhile(lambda named: named[1], part)) for part in (draws, frames)]


def said(before, row):
    """The speed-up over the step before; of the first step its time."""
    return speed_up(gained(before, row)) if before else f"{milliseconds(row)} ms"


def verdict(before, after):
    """Whether one optimization more made a difference."""
    return {-1: "gain", 0: "neither", 1: "loss"}[order(after, before)]


def summary(named):
    """The step that gains most; `named` are the draws of each scene."""
    gains = {}
    for found in named.values():
        for (_, before), (label, row) in zip(found, found[1:]):
            gains.setdefault(label, []).append(gained(before, row))
    if not gains:
        return "Ablation"
    best = max(gains, key=lambda label: median(gains[label]))
    name = best.strip("+… ").removeprefix("with ")
    return f"{name[0].upper()}{name[1:]} gains most, {about(median(gains[best]))} in the median of scenes"


COLUMNS = 3
SUBTITLE = ("Each line adds one optimization: above, to the draw of prepared triangles on one thread; below, to the whole frame. "
            "Fusion is for streams, clusters for meshes that have them. Figures: speed-up over the line above. Black: faster; red: "
            "slower; grey: not settled. Light bars: 95 % intervals. Grey ticks: the cost model's estimate.")
GAP = 0.7  # lines between the two parts


def places_of(named):
    """{label: y} of the parts that have the most labels."""
    draws, frames = (max((parts_[i] for parts_ in named.values()), key=len) for i in (0, 1))
    return {**{label: y for y, (label, _) in enumerate(draws)}, **{label: len(draws) + GAP + y for y, (label, _) in enumerate(frames)}}


def panel(axes, bench, named, place_of):
    times = [row.median_ms for _, row in named]
    places = [place_of[label] for label, _ in named]
    axes.plot(times, places, color="#d0d7de", linewidth=1.4, zorder=2)
    for i, (time, place, (_, row)) in enumerate(zip(times, places, named)):
        before = named[i - 1][1] if i else None
        colour = VERDICTS[verdict(before, row)] if before else INK
        axes.plot(row.interval_ms, [place, place], color=colour, linewidth=5, alpha=0.2, solid_capstyle="butt")
        axes.plot([time], [place], marker="o", markersize=5, color=colour, zorder=3)
        axes.text(1.02, place, said(before, row), transform=axes.get_yaxis_transform(), va="center", fontsize=8.3, color=colour)
    for time, place, (_, row) in zip(times, places, named):
        if estimates := estimates_ms(bench, row):
            axes.plot([estimates[0], time], [place, place], color=FAINT, linewidth=1.0, linestyle=":", zorder=1)
            axes.plot([estimates[0]], [place], marker="|", markersize=11, markeredgewidth=2.2, color=FAINT, zorder=3)


def ablation(bench, folder, caption):
    scenes = list(dict.fromkeys(row.scene for row in bench.sweep("step")))
    if not scenes:
        return None
    named = {scene: parts(bench, scene) for scene in scenes}
    place_of = places_of(named)
    bottom = max(place_of.values()) + 0.6
    lines = math.ceil(len(scenes) / COLUMNS)
    figure, grid = plt.subplots(lines, COLUMNS, sharex=True, sharey=True, squeeze=False,
                                figsize=(WIDTH_IN, 0.8 + head_in(SUBTITLE) + lines * (0.55 + 0.2 * bottom)))
    panels = list(grid.flat)
    for axes, scene in zip(panels, scenes):
        axes.set_title(scene, color=INK, fontweight="bold", pad=3)
        axes.grid(axis="y", visible=False)
        axes.tick_params(axis="y", length=0, labelsize=9)
        axes.tick_params(axis="x", labelsize=9)
        for part in named[scene]:
            panel(axes, bench, part, place_of)
    for axes in panels[len(scenes):]:
        axes.set_visible(False)
    panels[0].set_xscale("log")
    log_axis(panels[0].xaxis)
    rows = [row for parts_ in named.values() for part in parts_ for _, row in part]
    times = [ms for row in rows for ms in row.interval_ms]
    estimates = [found[0] for row in rows if (found := estimates_ms(bench, row))]
    panels[0].set_xlim(min(times + estimates) / 1.3, max(times) * 1.3)
    panels[0].set_yticks(list(place_of.values()), list(place_of))
    panels[0].set_ylim(bottom, -0.6)
    for axes in grid[-1]:
        axes.set_xlabel("ms per frame", fontsize=9.5)
    height = figure.get_figheight()
    top = headline(figure, summary({scene: draws for scene, (draws, _) in named.items()}), SUBTITLE)
    figure.subplots_adjust(left=0.165, right=0.905, bottom=0.72 / height, top=top - 0.3 / height, wspace=0.46,
                           hspace=0.55 / (0.2 * bottom))
    save(figure, folder, "ablation", caption)
    return "ablation"
