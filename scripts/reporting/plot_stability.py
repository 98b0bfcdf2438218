"""The chart of stability: for each sweep, from easy to hard, a bar for each method, as far as it holds."""
import math

from plot_style import FAINT, INK, chart, save, wrapped
from tables import enumerated, number, short

HELD, EMPTY = "#9aa5b1", "#eef1f4"
LINE_IN = 0.195  # the height of a line of text or of a row of bars
NAMES, GAP = 0.14, 0.006  # the width of the column of names, and between cells, in parts of the chart
LOOKS = {"finding": {"fontsize": 10.5, "fontweight": "bold"}, "text": {"fontsize": 8.2}, "sweep": {"fontsize": 8.6}, "method": {"fontsize": 8.6},
         "our method": {"fontsize": 8.6, "fontweight": "bold"}, "scale": {"fontsize": 6.8, "color": FAINT}}
# Suffixes of coverage sweeps, and where their vertices lie.
PLACES = {"_on_halves": "vertices at pixel centres and halves", "_on_our_grid": "vertices on our grid of 1/256 px", "": "vertices anywhere"}


def tidy(value):
    """Rounds no place of a sweep: 2⁻¹⁰ is not 10⁻³, and 1,024 is not 1.02k."""
    mantissa, power = math.frexp(value)
    if mantissa == 0.5 and value < 0.1:
        return f"$2^{{{power - 1}}}$"
    if 0 < value < 1e-3:
        digits, power = f"{value:.0e}".split("e")
        return "$" + ("" if digits == "1" else digits + r"\cdot ") + f"10^{{{int(power)}}}$"
    return short(value) if value % 1000 == 0 else number(value, 7)


def named(sweep):
    """The block of a sweep, and its title there: those of coverage by where their vertices lie."""
    suffix = next(suffix for suffix in PLACES if sweep.name.endswith(suffix))
    where = f", {PLACES[suffix]}" if sweep.family == "coverage" else ""
    return sweep.family.capitalize() + where, sweep.name.removesuffix(suffix).replace("_", " ")


def lines_of(name, sweeps):
    """The lines of a block: their look, their texts by column, and the curves of all columns but the first."""
    rows = {curves[0].method: curves for curves in zip(*(sweep.curves for sweep in sweeps), strict=True)}
    hold, fail = ([method for method, curves in rows.items() if all(curve.held == share for curve in curves)] for share in (1, 0))
    best = max((method for method in rows if method.ours), key=lambda method: sum(curve.held == 1 for curve in rows[method]))
    yield "finding", [f"{name}: {best.name} holds in {sum(curve.held == 1 for curve in rows[best])} of {len(sweeps)} sweeps"], ()
    told = [f"{said}: {enumerated([method.name for method in methods])}."
            for said, methods in (("Hold in all", hold), ("Fail from the start in all", fail)) if methods]
    for why in dict.fromkeys(sweep.why for sweep in sweeps if sweep.why):
        failing = [named(sweep)[1] for sweep in sweeps if sweep.why == why and any(curve.method.ours and curve.held < 1 for curve in sweep.curves)]
        told += [f"Why ours fail in {enumerated(failing)}: {why}."] if failing else []
    for line in wrapped("\n".join(told), LOOKS["text"]["fontsize"]).splitlines():
        yield "text", [line], ()
    differing = [method for method in rows if method not in hold + fail]
    if differing:
        yield "sweep", ["", *(named(sweep)[1] for sweep in sweeps)], ()
        yield "scale", ["", *(f"{sweep.unit}: {' to '.join(map(tidy, sweep.ends))}" for sweep in sweeps)], ()
    for method in differing:
        yield "our method" if method.ours else "method", [method.name], rows[method]
    yield "text", [], ()


def draw_bar(axes, x, y, width, curve):
    ours, inside = curve.method.ours, curve.held > 0.55
    axes.barh([y, y], [width, width * curve.held], 0.8, x, color=[EMPTY, INK if ours else HELD])
    verdict = "" if curve.starts_to_fail is None else tidy(curve.starts_to_fail) if curve.held else "fails"
    axes.text(x + width * curve.held + (-0.003 if inside else 0.003), y, verdict, fontsize=7.5, va="center", ha="right" if inside else "left",
              color="white" if inside and ours else INK)


def grid(sweeps, folder, caption):
    by_block = {}
    for sweep in sweeps:
        by_block.setdefault(named(sweep)[0], []).append(sweep)
    if not by_block:
        return None
    lines = [line for block in by_block.items() for line in lines_of(*block)]
    fewest = min(curve.trials for sweep in sweeps for curve in sweep.curves)
    subtitle = ("A bar reaches as far as a method errs in at most 1 of 10⁴ trials against the positions that the caller gave (visibility: the "
                f"snapped ones), of at least {short(fewest)} at each place. The figure is the first place at which it fails. Each sweep runs from "
                "easy to hard. Headlines name the first of ours that holds in most sweeps. Bold names and dark bars: ours.")
    figure, [[axes]] = chart(lines[0][1][0], subtitle, caption, LINE_IN * len(lines))
    axes.set(xlim=(0, 1), ylim=(len(lines), -1))
    axes.axis("off")
    most = max(map(len, by_block.values()))
    cell = (1 - NAMES) / most
    columns = [NAMES + i * cell for i in range(most)]
    for y, (look, texts, curves) in enumerate(lines):
        for x, text in zip((0, *columns), texts):
            axes.text(x, y, text, va="center", **LOOKS[look])
        for x, curve in zip(columns, curves):
            draw_bar(axes, x, y, cell - GAP, curve)
    return save(figure, folder, "stability-grid")
