"""The chart of stability: for each sweep, from easy to hard, a bar for each method, as far as it holds."""
import math

from accuracy_rows import FAMILIES
from plot_style import FAINT, INK, WIDTH_IN, head_in, headline, plt, save, wrapped
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
ROW_IN, NAME_IN, GAP_IN, HEAD_IN, LINE_IN = 0.2, 1.75, 0.06, 0.36, 0.15
TEXT = 8.2  # the type of a block's lines


def held(curve):
    """The share of a sweep's places, easy ones first, before the first at which a method fails."""
    places = [x for x, _ in curve.points]
    return 1.0 if curve.starts_to_fail is None else places.index(curve.starts_to_fail) / len(places)


def verdict(curve):
    return "" if curve.starts_to_fail is None else tidy(curve.starts_to_fail) if held(curve) else "fails"


# Suffixes of coverage sweeps, and where their vertices lie.
PLACES = {"": "vertices anywhere", "_on_halves": "vertices at pixel centres and halves", "_on_our_grid": "vertices on our grid of 1/256 px"}


def place_of(sweep):
    return next(suffix for suffix in reversed(PLACES) if sweep.name.endswith(suffix))


def blocks_of(sweeps):
    """[(name, sweeps)]: those of coverage by where their vertices lie."""
    found = {}
    for sweep in sorted((sweep for sweep in sweeps if sweep.curves), key=lambda sweep: [*FAMILIES].index(sweep.family)):
        where = f", {PLACES[place_of(sweep)]}" if sweep.family == "coverage" else ""
        found.setdefault(sweep.family.capitalize() + where, []).append(sweep)
    return list(found.items())


def rows_of(sweeps):
    """{method: its curve in each sweep}"""
    return {curve.method: [next(c for c in sweep.curves if c.method == curve.method) for sweep in sweeps] for curve in sweeps[0].curves}


def finding(name, sweeps):
    """"Coverage: ours_8 holds in 0/5 sweeps, ours_15 in 5/5"."""
    counts = [(method.name, sum(curve.starts_to_fail is None for curve in curves)) for method, curves in rows_of(sweeps).items() if method.ours]
    return f"{name}: " + ", ".join(f"{who} {'in' if i else 'holds in'} {count}/{len(sweeps)}{'' if i else ' sweeps'}"
                                   for i, (who, count) in enumerate(counts))


def title_of(sweep):
    return sweep.name.removesuffix(place_of(sweep)).replace("_", " ")


def told(sweeps):
    """(lines about methods that all sweeps judge alike, and about why ours fail; rows_of() the other methods)"""
    rows = rows_of(sweeps)
    alike = {"Hold in all": [m for m, curves in rows.items() if all(held(c) == 1 for c in curves)],
             "Fail from the start in all": [m for m, curves in rows.items() if all(held(c) == 0 for c in curves)]}
    lines = [f"{said}: {enumerated([m.name for m in methods])}." for said, methods in alike.items() if methods]
    for why in dict.fromkeys(sweep.why for sweep in sweeps if sweep.why):
        failing = [title_of(sweep) for sweep in sweeps if sweep.why == why and any(c.method.ours and held(c) < 1 for c in sweep.curves)]
        if failing:
            lines.append(f"Why ours fail in {enumerated(failing)}: {why}.")
    return lines, {m: curves for m, curves in rows.items() if not any(m in methods for methods in alike.values())}


def scale_text(sweep):
    """The name, unit and ends of a sweep's places; without the name if a cell has no room for it."""
    ends = " to ".join(tidy(sweep.curves[0].points[end][0]) for end in (0, -1))
    whole = f"{', '.join(filter(None, (sweep.x['name'], sweep.x['unit'])))}: {ends}"
    return whole if len(whole) < 32 else f"{sweep.x['unit']}: {ends}"


def summed_up(blocks):
    """"vertices anywhere: ours_15 holds; vertices at pixel centres and halves: ours_8 holds", of the first two blocks."""
    least = [(name, next((m.name for m, curves in rows_of(of).items() if m.ours and all(held(c) == 1 for c in curves)), "none of ours"))
             for name, of, *_ in blocks[:2]]
    return "; ".join(f"{name.split(', ')[-1]}: {who} holds" for name, who in least)


def grid(sweeps, folder, caption):
    blocks = [(name, of, *told(of)) for name, of in blocks_of(sweeps)]
    if not blocks:
        return None
    fewest = min(curve.trials for sweep in sweeps for curve in sweep.curves)
    subtitle = (f"A bar reaches as far as a method errs in at most 1 of 10⁴ trials against the positions that the caller gave (visibility: the "
                f"snapped ones), of at least {short(fewest)} at each place. The figure is the first place at which it fails. Each sweep runs from easy "
                "to hard. Bold names and dark bars: ours.")
    texts = [wrapped("\n".join(lines), TEXT) for _, _, lines, _ in blocks]
    heights = [0.44 + LINE_IN * len(text.splitlines()) + (HEAD_IN + ROW_IN * len(rows) if rows else 0) for text, (*_, rows) in zip(texts, blocks)]
    cell_in = (WIDTH_IN - NAME_IN - 0.1) / max(len(of) for _, of, *_ in blocks) - GAP_IN
    figure = plt.figure(figsize=(WIDTH_IN, head_in(subtitle) + 0.3 + sum(heights)))
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, WIDTH_IN), ylim=(figure.get_figheight(), 0))
    axes.axis("off")
    headline(figure, summed_up(blocks).capitalize(), subtitle)
    y = head_in(subtitle) + 0.05
    for (name, of, _, rows), text, height in zip(blocks, texts, heights):
        axes.text(0.08, y + 0.2, finding(name, of), fontsize=10.5, fontweight="bold", va="bottom")
        axes.text(0.08, y + 0.31, text, fontsize=TEXT, va="top", linespacing=1.3)
        if rows:
            draw_rows(axes, of, rows, cell_in, y + height - ROW_IN * len(rows) - 0.14)
        y += height
    return save(figure, folder, "stability-grid", caption)


def draw_rows(axes, sweeps, rows, cell_in, y):
    """The sweeps' names, and below them, from y, a row of bars for each method."""
    middles = [y + ROW_IN * (line + 0.5) for line in range(len(rows))]
    for method, middle in zip(rows, middles):
        axes.text(0.08, middle, method.name, fontsize=8.6, va="center", fontweight="bold" if method.ours else "normal")
    for i, (sweep, curves) in enumerate(zip(sweeps, zip(*rows.values()))):
        x = NAME_IN + i * (cell_in + GAP_IN)
        axes.text(x, y - 0.16, title_of(sweep), fontsize=8.6, va="bottom")
        axes.text(x, y - 0.03, scale_text(sweep), fontsize=6.8, color=FAINT, va="bottom")
        axes.barh(middles, cell_in, ROW_IN - 0.04, x, color=EMPTY)
        bars = axes.barh(middles, [cell_in * held(curve) for curve in curves], ROW_IN - 0.04, x,
                         color=[OURS if curve.method.ours else HELD for curve in curves])
        for bar, curve in zip(bars, curves):
            inside = held(curve) > 0.55
            axes.text(bar.get_x() + bar.get_width() + (-0.03 if inside else 0.03), bar.get_y() + bar.get_height() / 2, verdict(curve), fontsize=7.5,
                      va="center", ha="right" if inside else "left", color="white" if inside and curve.method.ours else INK)
