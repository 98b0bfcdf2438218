"""One chart of all sweeps: a bar for each method, as far as it holds."""
from accuracy_rows import FAMILIES
from palette import FAINT, INK
from plot_style import headline, plt, save
from stability_curves import tidy

OURS, HELD, EMPTY = INK, "#9aa5b1", "#eef1f4"
ROW_IN, NAME_IN, CELL_IN, GAP_IN, HEAD_IN = 0.2, 1.75, 1.16, 0.06, 0.42


def held(curve):
    """The share of a sweep's places, easy ones first, before the first at which a method fails."""
    places = [x for x, _ in curve.points]
    return 1.0 if curve.starts_to_fail is None else places.index(curve.starts_to_fail) / len(places)


def verdict(curve):
    if curve.starts_to_fail is None:
        return "holds"
    return tidy(curve.starts_to_fail) if held(curve) else "fails"


def rows_of(sweeps, methods):
    """[(method, its curve in each sweep or None)]"""
    return [(method, [next((c for c in sweep.curves if c.method == method.name), None) for sweep in sweeps])
            for method in methods]


def scale_text(x):
    """The name and unit of a sweep's places, or the unit alone if a cell has no room for both."""
    whole = ", ".join(filter(None, (x["name"], x["unit"])))
    return whole if len(whole) < 24 else x["unit"]


def title(families):
    ours = [[c for method, curves in rows if method.ours for c in (curves[i],) if c] for _, of, rows in families for i in range(len(of))]
    held = sum(all(c.starts_to_fail is None for c in curves) for curves in ours)
    return f"Ours hold in {held} of {len(ours)} sweeps"


def grid(sweeps, accuracy, folder, caption):
    families = [(family, of, rows_of(of, accuracy.methods[family])) for family in FAMILIES
                if (of := [sweep for sweep in sweeps if sweep.family == family and sweep.curves])]
    if not families:
        return None
    height = 1.0 + sum(HEAD_IN + ROW_IN * len(rows) + 0.12 for _, _, rows in families) + 0.2
    columns = max(len(of) for _, of, _ in families)
    width = NAME_IN + columns * (CELL_IN + GAP_IN) + 0.1
    figure = plt.figure(figsize=(width, height))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, width), ylim=(height, 0))
    axes.axis("off")
    headline(figure, title(families),
             "A bar reaches as far as a method errs no more than rounding to 1/256 px does; the figure is the first place at "
             "which it fails. Each sweep runs from easy to hard. Bold names and dark bars: ours.")
    y = 1.0
    for family, of, rows in families:
        axes.text(0.08, y + 0.26, family.capitalize(), fontsize=10.5, fontweight="bold", va="bottom")
        for i, sweep in enumerate(of):
            x = NAME_IN + i * (CELL_IN + GAP_IN)
            axes.text(x, y + 0.14, sweep.name.replace("_", " "), fontsize=8.3, va="bottom")
            axes.text(x, y + 0.27, scale_text(sweep.x), fontsize=6.5,
                      color=FAINT, va="bottom")
        y += HEAD_IN - 0.08
        for method, curves in rows:
            axes.text(0.08, y + ROW_IN / 2, method.name, fontsize=8.6, va="center",
                      fontweight="bold" if method.ours else "normal")
            for i, curve in enumerate(curves):
                if curve is None:
                    continue
                x = NAME_IN + i * (CELL_IN + GAP_IN)
                axes.add_patch(plt.Rectangle((x, y + 0.02), CELL_IN, ROW_IN - 0.04, color=EMPTY, linewidth=0))
                axes.add_patch(plt.Rectangle((x, y + 0.02), CELL_IN * held(curve), ROW_IN - 0.04, linewidth=0,
                                             color=OURS if method.ours else HELD))
                if curve.starts_to_fail is not None:
                    inside = held(curve) > 0.55
                    axes.text(x + CELL_IN * held(curve) + (-0.03 if inside else 0.03), y + ROW_IN / 2, verdict(curve),
                              fontsize=7.2, va="center", ha="right" if inside else "left",
                              color="white" if inside and method.ours else INK)
            y += ROW_IN
        y += 0.12
    save(figure, folder, "stability-grid", caption)
    return "stability-grid"
