"""Chart of cost against triangles, pixels and overdraw, with the exponents from step to step below."""
import math
import textwrap

from growth import LINEAR, QUANTITIES, cache_bytes, steps
from palette import BAND
from plot_style import FAINT, INK, WIDTH_IN, Look, head_in, headline, plt, save
from plot_area import draw_curves


def mark_caches(axes, quantity, machine, named):
    """The x at which the memory that each frame passes over fills a cache."""
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
    axes.axhspan(1 - LINEAR, 1 + LINEAR, color=BAND, zorder=0, linewidth=0)
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
    axes.set_xticks(places, [quantity.label(x) for x in places], fontsize=8, rotation=30 if quantity.key == "size" else 0)
    axes.tick_params(axis="x", which="minor", length=0)


def title(drawn):
    """The settled cases of growth beyond linear."""
    faster = [f"{backend} with {quantity.name}" for quantity, rows in drawn for backend, found in rows.items()
              if any(step.kind == "more than linear" for step in steps(quantity, found))]
    if faster:
        return f"Settled growth beyond linear: {faster[0]}" + (f", and {len(faster) - 1} more" if faster[1:] else "")
    return f"No settled growth beyond linear with {', '.join(quantity.name for quantity, _ in drawn)}"


def growth(bench, machine, folder, caption):
    look = Look(bench.backends)
    drawn = [(quantity, rows) for quantity in QUANTITIES if (rows := {
        backend: found for backend, found in quantity.rows(bench).items() if len(found) > 1})]
    if not drawn:
        return None
    threads = next(iter(drawn[0][1].values()))[0].threads
    subtitle = (f"Backend alone, clear included, {threads} threads. Top: ms per frame, lower is better; bands are 95 % "
                "intervals. Bottom: the exponent from point to point, 1 is linear and 0 no growth; light bars are 95 % "
                "intervals. Dotted: triangle records or the frame fill a cache.")
    figure, panels = plt.subplots(2, len(drawn), squeeze=False, sharex="col", figsize=(WIDTH_IN, 5.9 + head_in(subtitle)),
                                  height_ratios=(3, 2))
    height = figure.get_figheight()
    top = headline(figure, title(drawn), subtitle)
    look.legend(figure, top - 0.02 / height)
    figure.subplots_adjust(left=0.06, right=0.985, bottom=0.95 / height, top=top - 0.72 / height, wspace=0.2, hspace=0.08)
    for (quantity, rows), (above, below) in zip(drawn, panels.T):
        points = {backend: [(quantity.x_of(row), row, 1.0) for row in found] for backend, found in rows.items()}
        draw_curves(above, points, look)
        draw_steps(below, quantity, rows, look)
        label_x(below, quantity, rows)
        above.set_title(textwrap.fill(quantity.scene(bench), 34), fontsize=9, color=INK)
        below.set_xlabel({"count": "triangles", "size": "image, pixels", "overdraw": "overdraw"}[quantity.key])
        mark_caches(above, quantity, machine, False)
        mark_caches(below, quantity, machine, True)
        above.tick_params(axis="x", which="both", length=0)
    panels[0][0].set_ylabel("ms")
    panels[1][0].set_ylabel("exponent")
    save(figure, folder, "growth", caption)
    return "growth"
