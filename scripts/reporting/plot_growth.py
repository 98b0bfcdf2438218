"""Cost against triangles, pixels and overdraw, and below it the exponent with which it grows from step to step."""
import math

from growth import LINEAR, QUANTITIES, cache_bytes, steps
from plot_style import FAINT, INK, Look, headline, plt, save
from plot_area import draw_curves, label_ends


def mark_caches(axes, quantity, machine, named):
    """Where what is gone through once a frame fills a cache."""
    low, high = axes.get_xlim()
    for level in ("L2", "L3"):
        size = cache_bytes(machine, level)
        if not size or not quantity.item_bytes or not low < size / quantity.item_bytes < high:
            continue
        x = size / quantity.item_bytes
        axes.axvline(x, color=FAINT, linewidth=1.0, linestyle=(0, (2, 2)), zorder=1)
        if named:
            axes.annotate(f"fills {level}", (x, 0), xycoords=("data", "axes fraction"), xytext=(-3, 4),
                          textcoords="offset points", rotation=90, ha="right", va="bottom", fontsize=8, color=FAINT)


def draw_steps(axes, quantity, rows, look):
    axes.axhspan(1 - LINEAR, 1 + LINEAR, color="#eef4ee", zorder=0, linewidth=0)
    axes.axhline(1, color=FAINT, linewidth=1.0, zorder=1)
    for backend, found in rows.items():
        middle, exponents, bars = [], [], []
        for step in steps(quantity, found):
            middle.append(math.sqrt(step.start * step.end))
            exponents.append(step.exponent)
            bars.append((step.low, step.high))
        axes.vlines(middle, *zip(*bars), color=look.colour(backend), linewidth=5, alpha=0.2)
        axes.plot(middle, exponents, color=look.colour(backend), marker=look.marker(backend), linewidth=1.2,
                  markeredgecolor="white", markeredgewidth=0.6)
    axes.set_ylim(-0.25, 1.6)
    axes.set_yticks([0, 0.5, 1, 1.5], ["0", "½", "1", "1½"])


def label_x(axes, quantity, rows):
    places = sorted({quantity.x_of(row) for found in rows.values() for row in found})
    axes.set_xticks(places, [quantity.label(x) for x in places], fontsize=8.5)
    axes.tick_params(axis="x", which="minor", length=0)


def growth(bench, machine, folder, caption):
    look = Look(bench.backends)
    drawn = [(quantity, rows) for quantity in QUANTITIES if (rows := {
        backend: found for backend, found in quantity.rows(bench).items() if len(found) > 1})]
    if not drawn:
        return None
    threads = next(iter(drawn[0][1].values()))[0].threads
    figure, panels = plt.subplots(2, len(drawn), squeeze=False, sharex="col", figsize=(4.4 * len(drawn), 6.6),
                                  height_ratios=(3, 2))
    top = headline(figure, "How cost grows with triangles, pixels and overdraw",
                   f"Backend alone, clear included, {threads} threads. Above: ms a frame, lower is better. Below: the "
                   "exponent from point to point; 1 is linear,\n0 is no growth. Bands and light bars: what the "
                   "repetitions leave open. Dotted: where triangle records or the frame fill a cache.")
    figure.subplots_adjust(left=0.05, right=0.945, bottom=0.11, top=top - 0.05, wspace=0.36, hspace=0.08)
    for (quantity, rows), (above, below) in zip(drawn, panels.T):
        points = {backend: [(quantity.x_of(row), row, 1.0) for row in found] for backend, found in rows.items()}
        draw_curves(above, points, look)
        draw_steps(below, quantity, rows, look)
        label_ends(above, points, look)
        label_x(below, quantity, rows)
        above.set_title(quantity.scene(bench).replace("`", ""), fontsize=9.5, color=INK)
        below.set_xlabel({"count": "triangles", "size": "image, pixels", "overdraw": "overdraw"}[quantity.key])
        mark_caches(above, quantity, machine, False)
        mark_caches(below, quantity, machine, True)
        above.tick_params(axis="x", which="both", length=0)
    panels[0][0].set_ylabel("ms")
    panels[1][0].set_ylabel("exponent")
    save(figure, folder, "growth", caption)
    return "growth"
