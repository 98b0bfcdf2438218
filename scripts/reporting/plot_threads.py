"""Chart of the speed-up by threads, scene by scene: of the front end, of a backend and of both."""
import math

from bench_rows import gained, gained_interval
from bench_tables import OURS
from plot_style import BLACK, FAINT, GREEN, ORANGE, WIDTH_IN, foot_in, head_in, headline, plt, save
from tables import number, spread

PARTS = {"front end": ("frontend", ORANGE, "s"), OURS: (OURS, GREEN, "^"), "whole frame": (f"{OURS}+frontend", BLACK, "o")}
COLUMNS = 5


def threads(bench, folder, caption):
    every = sorted({row.threads for row in bench.sweep("threads")})

    def by_threads(who, scene):
        return {n: row for n in every if (row := bench.find(f"{who}/{scene}/threads:{n}"))}

    timed = {scene: {part: rows for part, (who, *_) in PARTS.items() if len(rows := by_threads(who, scene)) > 1 and 1 in rows}
             for scene in bench.scenes}
    timed = {scene: parts for scene, parts in timed.items() if "whole frame" in parts}
    if not timed:
        return None
    most = max(max(parts["whole frame"]) for parts in timed.values())
    lines = math.ceil(len(timed) / COLUMNS)
    subtitle = ("Dashed: the ideal. A front end of little work runs on one thread. Below a scene's name, the milliseconds on one thread: "
                f"{', '.join(PARTS)}.")
    height = 1.75 * lines + head_in(subtitle) + foot_in(caption) + 0.4
    figure, axes = plt.subplots(lines, COLUMNS, sharex=True, sharey=True, squeeze=False, figsize=(WIDTH_IN, height))
    for panel in axes.flat[len(timed):]:
        panel.set_visible(False)
    for panel, (scene, parts) in zip(axes.flat, timed.items()):
        panel.plot([1, most], [1, most], color=FAINT, linewidth=1.0, linestyle="--")
        for part, rows in parts.items():
            _, colour, marker = PARTS[part]
            counts = list(rows)
            panel.plot(counts, [gained(rows[1], rows[n]) for n in counts], color=colour, marker=marker, linewidth=1.5)
            for n in counts[1:]:
                panel.plot([n, n], gained_interval(rows[1], rows[n]), color=colour, linewidth=5, alpha=0.25, solid_capstyle="butt")
        panel.set_xscale("log", base=2)
        panel.set_yscale("log", base=2)
        counts = list(parts["whole frame"])
        panel.set_xticks(counts, counts)
        panel.set_yticks(counts, [f"{n}×" for n in counts])
        panel.minorticks_off()
        panel.set_title(f"{scene}\n{' · '.join(number(parts[part][1].median_ms, 2) for part in PARTS if part in parts)} ms", fontsize=9)
    frames = [gained(parts["whole frame"][1], parts["whole frame"][max(parts["whole frame"])]) for parts in timed.values()]
    top = headline(figure, f"Speed-up of {OURS}'s whole frames by {most} threads: {spread(frames)}", subtitle)
    handles = [plt.Line2D([], [], color=colour, marker=marker, label=part) for part, (_, colour, marker) in PARTS.items()]
    figure.legend(handles=handles, loc="upper left", bbox_to_anchor=(0.005, top), ncol=3, frameon=False, fontsize=10)
    figure.supxlabel("threads", fontsize=10.5, y=(foot_in(caption) - 0.5) / height)
    figure.subplots_adjust(left=0.05, right=0.985, bottom=(foot_in(caption) - 0.1) / height, top=top - 0.85 / height, hspace=0.55, wspace=0.12)
    save(figure, folder, "threads", f"Light bars: 95 % intervals.\n{caption}")
    return "threads"
