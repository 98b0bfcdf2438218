"""The estimated speed-up of a frame on more cores, beside the measured speed-up on two threads."""
import math
import textwrap

from plot_scenes import ends_of
from plot_style import FAINT, INK, WIDTH_IN, Look, head_in, headline, plt, save
from scaling import allowed, pair_measured, quickest, scheduled, serial_part
from speedups import about

COLUMNS = 4


SUBTITLE = ("Whole frames, front end included. Lines: estimated from recorded tasks and barriers; the estimate ignores shared "
            "bandwidth, caches and clock rate. Rings: measured on two threads, with 95 % intervals. "
            "Dotted: ideal. Text: the longest serial part on the most cores.")


def scaling(bench, folder, caption):
    found = scheduled(bench)
    if not found:
        return None
    look, best = Look(bench.backends), quickest(bench)
    lines = math.ceil(len(best) / COLUMNS)
    figure, panels = plt.subplots(lines, COLUMNS, squeeze=False, sharex=True, sharey=True, figsize=(WIDTH_IN, 1.15 + head_in(SUBTITLE) + 2.35 * lines))
    most = max(cores for rows in found.values() for cores in rows)
    ticks = [2 ** k for k in range(int(math.log2(most)) + 1)]
    for axes in panels.flat[len(best):]:
        axes.set_visible(False)
    for axes, (scene, first) in zip(panels.flat, best.items()):
        axes.plot([1, most], [1, most], color=FAINT, linewidth=1.0, linestyle=(0, (2, 2)), zorder=1)
        for (its_scene, backend), rows in found.items():
            if its_scene != scene:
                continue
            speed_up = allowed(rows)
            axes.plot(*zip(*speed_up.items()), color=look.colour(backend), marker=look.marker(backend), markersize=4,
                      linewidth=1.6, markeredgecolor="white", markeredgewidth=0.5)
            if two := pair_measured(bench, scene, backend):
                axes.plot([2, 2], ends_of(*two), color=look.colour(backend), linewidth=4, alpha=0.25, solid_capstyle="butt")
                axes.plot([2], [two[0].median_ms / two[1].median_ms], marker="o", markersize=7, markerfacecolor="none", markeredgewidth=1.5,
                          markeredgecolor=look.colour(backend), linestyle="", zorder=4)
        axes.set_xscale("log", base=2)
        axes.set_yscale("log", base=2)
        axes.set_title(scene, color=INK)
        last = found[scene, first][max(found[scene, first])]
        axes.text(0.03, 0.97, textwrap.fill(f"{first}: {serial_part(last)}", 32), transform=axes.transAxes,
                  fontsize=8, va="top",
                  color=look.text_colour(first), linespacing=1.15)
    corner = panels[0][0]
    corner.set_xlim(0.92, most * 1.08)
    corner.set_ylim(0.7, most * 3)
    corner.set_xticks(ticks, [str(n) if n in (1, 2, 4, 8, 32, 128) else "" for n in ticks])
    corner.set_yticks(ticks, [f"{n}×" if n in (1, 2, 4, 8, 32, 128) else "" for n in ticks])
    for axes in panels.flat:
        axes.tick_params(which="minor", length=0)
        axes.xaxis.set_tick_params(labelbottom=True)
    figure.supxlabel("cores", fontsize=10.5, y=0.28 / figure.get_figheight())
    height = figure.get_figheight()
    gains = [allowed(found[key])[most] for key in best.items() if most in found[key]]
    top = headline(figure, f"Estimate: {most} cores draw a frame {about(min(gains))} to {about(max(gains))} faster than one",
                   SUBTITLE)
    look.legend(figure, top - 0.02 / height)
    figure.subplots_adjust(left=0.05, right=0.985, bottom=0.75 / height, top=top - 0.62 / height, wspace=0.1, hspace=0.38)
    save(figure, folder, "scaling", caption)
    return "scaling"
