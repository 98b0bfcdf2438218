"""Charts of stability: one per sweep, with one curve per method, from easy on the left to hard on the right; and one of all
sweeps, with a bar for each method, as far as it holds."""
import math
import textwrap

from accuracy_rows import FAMILIES, Method
from plot_style import FAINT, INK, WIDTH_IN, Kinds, ZeroAxis, dark, head_in, headline, plt, save
from tables import enumerated, short


def groups_of(sweep, methods):
    """Methods whose curves are the same, as one: (methods, curve), in the registry's order."""
    groups = {}
    for curve in sweep.curves:
        members, _ = groups.setdefault((curve.points, curve.starts_to_fail), ([], curve))
        members.append(methods.get((sweep.family, curve.method)) or Method(curve.method, "", "", curve.exact))
    return list(groups.values())


# Lengths of dashes and gaps, in widths of the line; given out within a kind of method.
DASHES = ((), (5, 1.5), (1.5, 1.2), (5, 1.5, 1, 1.5), (8, 2), (3, 1, 1, 1, 1, 1), (9, 1.5, 3, 1.5))


def kinds_and_dashes(groups, family):
    """(kind, dash) of each group, so that no two lines look alike."""
    found, used = [], {}
    for members, _ in groups:
        kind = "ours" if any(member.ours for member in members) else family.kind(members[0])
        found.append((kind, DASHES[used.get(kind, 0) % len(DASHES)]))
        used[kind] = used.get(kind, 0) + 1
    return found


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


def names_of(members):
    """Ours, then the others."""
    return [textwrap.fill(", ".join(m.name for m in members if m.ours == ours), 31) for ours in (True, False)]


def line_count(text):
    return text.count("\n") + 1 if text else 0


def place_of_failure(curve):
    """The index of the first point at which a method fails."""
    return next((i for i, (x, _) in enumerate(curve.points) if x == curve.starts_to_fail), len(curve.points))


def summary(groups):
    """The sweep's finding: "ours hold; fixed_8_int32 breaks at 182"."""
    own, others = ([(place_of_failure(curve), tidy(curve.starts_to_fail), m.name) for members, curve in groups for m in members
                    if m.ours == whose and curve.starts_to_fail is not None] for whose in (True, False))
    breaking = [found for found in others if found[0] > 0]
    return (f"ours {f'break at {min(own)[1]}' if own else 'hold'}; "
            + (f"{min(breaking)[2]} breaks at {min(breaking)[1]}" if breaking else f"{len(others)} others fail at once"))


def failing(curve, sweep):
    if curve.starts_to_fail is None:
        return "holds"
    return f"fails at {tidy(curve.starts_to_fail)} {sweep.x['unit']}".rstrip()


def trials_note(sweep):
    trials = [n for curve in sweep.curves for n in curve.trials if n]
    if not trials or not sweep.y["log"]:
        return ""
    low, high = short(min(trials)), short(max(trials))
    return f" 0: no error in {low if low == high else f'{low} to {high}'} trials per point; the 95 % upper bound is 3/N."


LINE_IN = 0.15  # of a label


def stacked(wanted, heights, ties):
    """Lower ends for boxes of these heights, near where they are wanted (their middles), without overlap, on [0, 1];
    `ties` order those that are wanted at one place."""
    order = sorted(range(len(wanted)), key=lambda i: (round(wanted[i], 6), ties[i], i))
    low = [wanted[i] - heights[i] / 2 for i in order]
    room = [heights[i] for i in order]
    for _ in range(200):
        for i in range(len(low) - 1):
            lack = low[i] + room[i] - low[i + 1]
            if lack > 0:
                low[i], low[i + 1] = low[i] - lack / 2, low[i + 1] + lack / 2
        low = [max(0.0, low[0]), *low[1:]]
        if low[-1] + room[-1] > 1:
            low[-1] = 1 - room[-1]
    result = [0.0] * len(wanted)
    for i, index in enumerate(order):
        result[index] = low[i]
    return result


def set_axis(axes, sweep):
    """Returns the function from a number of errors to its place."""
    xs = [x for curve in sweep.curves for x, _ in curve.points]
    ys = [y for curve in sweep.curves for _, y in curve.points]
    scale = ZeroAxis(ys)
    if sweep.y["log"]:
        scale.apply_y(axes)
    else:
        axes.set_ylim(0, max(*ys, 1e-9) * 1.05)
    if sweep.x["log"] and min(xs) > 0:
        axes.set_xscale("log", base=10)
        axes.xaxis.set_major_formatter(lambda value, _: tidy(value))
        axes.minorticks_off()
    if xs[0] > xs[len(sweep.curves[0].points) - 1]:  # from easy to hard
        axes.invert_xaxis()
    return scale.at if sweep.y["log"] else float


def draw_curves(axes, groups, kinds, place_of):
    """Returns (colour, style) of each group."""
    looks = []
    for (members, curve), (kind, dash) in zip(groups, kinds_and_dashes(groups, kinds.family)):
        colour, marker = kinds.looks[kind]
        style = (0, dash) if dash else "-"
        looks.append((colour, style))
        xs, ys = [x for x, _ in curve.points], [place_of(y) for _, y in curve.points]
        ours = any(member.ours for member in members)
        axes.plot(xs, ys, color=colour, linestyle=style, linewidth=2.6 if ours else 1.5, zorder=4 if ours else 3)
        if curve.starts_to_fail is not None:
            y = next((y for x, y in curve.points if x == curve.starts_to_fail), 0.0)
            axes.plot([curve.starts_to_fail], [place_of(y)], marker=marker, markersize=8, color="white",
                      markeredgecolor=colour, markeredgewidth=1.8, linestyle="", zorder=5)
    return looks


def label_curves(axes, groups, looks, place_of, sweep):
    """Names at the ends of the curves, each with a sample of its line."""
    low, high = axes.get_ylim()
    height_in = axes.figure.get_figheight() * axes.get_position().height
    texts = [(*names_of(members), failing(curve, sweep)) for members, curve in groups]
    heights = [(0.07 + LINE_IN * sum(map(line_count, text))) / height_in for text in texts]
    ties = [-place_of_failure(curve) for _, curve in groups]  # the first to fail at the top
    wanted = [(place_of(curve.points[-1][1]) - low) / (high - low) for _, curve in groups]
    lows = stacked(wanted, heights, ties)
    for text, height, bottom, end, (colour, style) in zip(texts, heights, lows, wanted, looks):
        y = bottom + height / 2
        place = {"color": colour, "transform": axes.transAxes, "clip_on": False}
        axes.plot([0.983, 1.035], [end, y], linewidth=0.7, **place)
        axes.plot([1.04, 1.088], [y, y], linewidth=2.0, linestyle=style, **place)
        top = bottom + height
        for part, weight, ink in zip(text, ("bold", "normal", "normal"), (dark(colour), dark(colour), FAINT)):
            axes.text(1.095, top, part, transform=axes.transAxes, fontsize=9, va="top", linespacing=1.1, color=ink,
                      fontweight=weight)
            top -= line_count(part) * LINE_IN / height_in


def sweep_chart(sweep, methods, folder, caption):
    groups = groups_of(sweep, methods)
    if not groups or not all(curve.points for _, curve in groups):
        return None
    kinds = Kinds(FAMILIES[sweep.family])
    lines = sum(1 + sum(map(line_count, names_of(members))) for members, _ in groups)
    subtitle = f"{sweep.summary[0].upper()}{sweep.summary[1:]}. From easy on the left to hard on the right."
    figure, axes = plt.subplots(figsize=(WIDTH_IN, 1.25 + head_in(subtitle) + max(3.4, 0.07 * len(groups) + 0.16 * lines)))
    height = figure.get_figheight()
    title = f"{sweep.name.replace('_', ' ').capitalize()}: {summary(groups)}"
    top = headline(figure, title, subtitle)
    figure.subplots_adjust(left=0.085, right=0.67, bottom=0.9 / height, top=top - 0.15 / height)
    place_of = set_axis(axes, sweep)
    axes.axhline(place_of(sweep.y["tolerance"]), color=FAINT, linewidth=0.9, linestyle=(0, (4, 3)), zorder=1)
    looks = draw_curves(axes, groups, kinds, place_of)
    axes.margins(x=0.02)
    label_curves(axes, groups, looks, place_of, sweep)
    unit = f", {sweep.x['unit']}" if sweep.x["unit"] else ""
    axes.set_xlabel(f"{sweep.x['name']}{unit}")
    axes.set_ylabel(sweep.y["name"].replace("10^6", "10⁶"))
    note = f"Bold: ours. Hollow marks: the method starts to fail, above {tidy(sweep.y['tolerance'])}.{trials_note(sweep)}"
    save(figure, folder, f"stability-{sweep.name}", f"{note}\n{caption}")
    return f"stability-{sweep.name}"


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


def draw(sweeps, accuracy, folder, caption):
    """The names of the charts drawn, or None."""
    if accuracy is None:
        return []
    methods = {(family, m.name): m for family, found in accuracy.methods.items() for m in found}
    return [*(sweep_chart(sweep, methods, folder, caption) for sweep in sweeps), grid(sweeps, accuracy, folder, caption)]
