"""The estimated speed-up of a frame on more cores, next to what is measured on two."""
import math

from speedups import about
from plot_style import FAINT, INK, Look, headline, plt, save
from scaling import allowed, measured, quickest, scheduled

COLUMNS = 4


def wrapped(text):
    """In two lines, broken near the middle."""
    words = text.split()
    cut = min(range(1, len(words)), key=lambda i: abs(len(" ".join(words[:i])) - len(" ".join(words[i:]))))
    return " ".join(words[:cut]) + "\n" + " ".join(words[cut:])


def scaling(bench, folder, caption):
    found = scheduled(bench)
    if not found:
        return None
    look, best = Look(bench.backends), quickest(bench)
    lines = math.ceil(len(best) / COLUMNS)
    figure, panels = plt.subplots(lines, COLUMNS, squeeze=False, sharex=True, sharey=True, figsize=(11.0, 1.7 + 2.45 * lines))
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
            two = measured(bench, scene, backend).get(2)
            if two:
                axes.plot([2], [two], marker="o", markersize=8.5, markerfacecolor="none", markeredgewidth=1.5,
                          markeredgecolor=look.colour(backend), linestyle="", zorder=4)
        axes.set_xscale("log", base=2)
        axes.set_yscale("log", base=2)
        axes.set_title(scene, color=INK)
        last = found[scene, first][max(found[scene, first])]
        axes.text(0.03, 0.97, f"{first}: {wrapped(last.label)}", transform=axes.transAxes, fontsize=7.5, va="top",
                  color=look.text_colour(first), linespacing=1.15)
    corner = panels[0][0]
    corner.set_xlim(0.87, most * 1.15)
    corner.set_ylim(0.8, most * 2.5)
    corner.set_xticks(ticks, [str(n) if n in (1, 2, 4, 8, 32, 128) else "" for n in ticks])
    corner.set_yticks(ticks, [f"{n}×" if n in (1, 2, 4, 8, 32, 128) else "" for n in ticks])
    for axes in panels.flat:
        axes.tick_params(which="minor", length=0)
        axes.xaxis.set_tick_params(labelbottom=True)
    figure.supxlabel("cores", fontsize=10.5, y=0.28 / figure.get_figheight())
    height = figure.get_figheight()
    gains = [allowed(found[key])[most] for key in best.items() if most in found[key]]
    top = headline(figure, f"Estimate: {most} cores gain {about(min(gains))} to {about(max(gains))}",
                   "Whole frames, front end included. Filled: estimated from recorded tasks and barriers, without shared "
                   "bandwidth, caches and clock rate.\nRing: measured on two threads. Dotted: ideal. In words: the longest "
                   "serial part on the most cores.")
    look.legend(figure, top - 0.02 / height)
    figure.subplots_adjust(left=0.05, right=0.985, bottom=0.75 / height, top=top - 0.72 / height, wspace=0.1, hspace=0.38)
    save(figure, folder, "scaling", caption)
    return "scaling"
