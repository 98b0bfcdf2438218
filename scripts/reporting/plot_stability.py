"""The chart of stability: for each sweep, from easy to hard, a bar for each method, as far as it holds."""
import math

from accuracy_rows import FAMILIES
from plot_style import FAINT, INK, WIDTH_IN, headline, plt, save
from tables import enumerated, short


def raised(base, power):
    return base + str(int(power)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def tidy(value):
    """Rounds no place of a sweep: 2⁻¹⁰ is not 10⁻³, and 1,024 is not 1.02k."""
    mantissa, power = math.frexp(value)
    if mantissa == 0.5 and value < 0.5:
        return raised("2", power - 1)
    if value == 0 or 1e-3 <= value < 1000:
        return f"{value:.3g}"
    if value >= 1000:
        return f"{value:,.0f}" if value % 100 else short(value)
    digits, power = f"{value:.0e}".split("e")
    return ("" if digits == "1" else digits + "·") + raised("10", power)


OURS, HELD, EMPTY = INK, "#9aa5b1", "#eef1f4"
ROW_IN, NAME_IN, GAP_IN, HEAD_IN = 0.2, 1.75, 0.06, 0.62


def held(curve):
    """The share of a sweep's places, easy ones first, before the first at which a method fails."""
    places = [x for x, _ in curve.points]
    return 1.0 if curve.starts_to_fail is None else places.index(curve.starts_to_fail) / len(places)


def verdict(curve):
    if curve.starts_to_fail is None:
        return "holds"
    return tidy(curve.starts_to_fail) if held(curve) else "fails"


def rows_of(sweeps, methods):
    """[(method, its curve in each sweep or None)] of the methods in any of them."""
    rows = [(method, [next((c for c in sweep.curves if c.method == method.name), None) for sweep in sweeps]) for method in methods]
    return [(method, curves) for method, curves in rows if any(curves)]


OFF_GRID = "_off_grid"


def blocks_of(sweeps):
    """[(name, family, sweeps)]: those of coverage with vertices on our grid, and off it."""
    found = []
    for family in FAMILIES:
        of = [sweep for sweep in sweeps if sweep.family == family and sweep.curves]
        off = [sweep for sweep in of if sweep.name == "pan" or sweep.name.endswith(OFF_GRID)]
        if off:
            found.append((f"{family.capitalize()}, vertices on the 1/256 px grid", family, [sweep for sweep in of if sweep not in off]))
            found.append((f"{family.capitalize()}, vertices anywhere", family, off))
        elif of:
            found.append((family.capitalize(), family, of))
    return found


def scale_text(x):
    """The name and unit of a sweep's places, or the unit alone if a cell has no room for both."""
    whole = ", ".join(filter(None, (x["name"], x["unit"])))
    return whole if len(whole) < 24 else x["unit"]


def finding(name, sweeps, methods):
    """"Facing: ours and float_area hold in 2/3 sweeps". Ours are one, and hold where all of them do."""
    holding = [{curve.method for curve in sweep.curves if curve.starts_to_fail is None} for sweep in sweeps]
    members = {}
    for method in methods:
        members.setdefault("ours" if method.ours else method.name, set()).add(method.name)
    held = {who: sum(of <= holds for holds in holding) for who, of in members.items()}
    most = max(held.values())
    best = [who for who, count in held.items() if count == most]
    ours, verb = "ours" in best, "holds" if len(best) == 1 and best != ["ours"] else "hold"
    if len(best) > 3:
        best = ["ours", f"{len(best) - 1} others"] if ours else [f"{len(best)} methods"]
    return (f"{name}: {enumerated(best)} {verb} in {most}/{len(sweeps)} sweeps"
            + ("" if ours else f", ours in {held['ours']}/{len(sweeps)}"))


def grid(sweeps, accuracy, folder, caption):
    if accuracy is None:
        return None
    blocks = [(block, of, rows_of(of, accuracy.methods[family])) for block, family, of in blocks_of(sweeps)]
    if not blocks:
        return None
    height = 1.0 + sum(HEAD_IN + ROW_IN * len(rows) + 0.12 for _, _, rows in blocks) + 0.2
    cell_in = (WIDTH_IN - NAME_IN - 0.1) / max(len(of) for _, of, _ in blocks) - GAP_IN
    figure = plt.figure(figsize=(WIDTH_IN, height))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, WIDTH_IN), ylim=(height, 0))
    axes.axis("off")
    first = blocks[0][1][0].family
    headline(figure, finding(first.capitalize(), [sweep for sweep in sweeps if sweep.family == first], accuracy.methods[first]),
             "A bar reaches as far as a method errs in at most 1 of 10⁴ trials against the positions that the caller gave (visibility: the snapped "
             "ones). The figure is the first place at which it fails. Each sweep runs from easy to hard. Bold names and dark bars: ours.")
    y = 1.0
    for block, of, rows in blocks:
        axes.text(0.08, y + 0.18, finding(block, of, [method for method, _ in rows]), fontsize=10.5, fontweight="bold", va="bottom")
        for i, sweep in enumerate(of):
            x = NAME_IN + i * (cell_in + GAP_IN)
            axes.text(x, y + 0.34, sweep.name.removesuffix(OFF_GRID).replace("_", " "), fontsize=8.3, va="bottom")
            ends = " to ".join(tidy(sweep.curves[0].points[end][0]) for end in (0, -1))
            axes.text(x, y + 0.47, f"{scale_text(sweep.x)}: {ends}", fontsize=6.5, color=FAINT, va="bottom")
        y += HEAD_IN - 0.08
        for method, curves in rows:
            axes.text(0.08, y + ROW_IN / 2, method.name, fontsize=8.6, va="center",
                      fontweight="bold" if method.ours else "normal")
            for i, curve in enumerate(curves):
                if curve is None:
                    continue
                x = NAME_IN + i * (cell_in + GAP_IN)
                axes.add_patch(plt.Rectangle((x, y + 0.02), cell_in, ROW_IN - 0.04, color=EMPTY, linewidth=0))
                axes.add_patch(plt.Rectangle((x, y + 0.02), cell_in * held(curve), ROW_IN - 0.04, linewidth=0,
                                             color=OURS if method.ours else HELD))
                if curve.starts_to_fail is not None:
                    inside = held(curve) > 0.55
                    axes.text(x + cell_in * held(curve) + (-0.03 if inside else 0.03), y + ROW_IN / 2, verdict(curve),
                              fontsize=7.2, va="center", ha="right" if inside else "left",
                              color="white" if inside and method.ours else INK)
            y += ROW_IN
        y += 0.12
    save(figure, folder, "stability-grid", caption)
    return "stability-grid"
