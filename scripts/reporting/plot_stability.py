"""Charts of stability: one per sweep, with one curve per method, from easy on the left to hard on the right."""
from accuracy_rows import FAMILIES
from palette import FAINT
from plot_style import WIDTH_IN, Kinds, dark, head_in, headline, plt, save
from stability_curves import (axis_of_errors, failing, groups_of, kinds_and_dashes, known_methods, line_count, names_of,
                              place_of_failure, runs_down, summary, tidy, trials_note)


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
    """Returns the axis of errors."""
    xs = [x for curve in sweep.curves for x, _ in curve.points]
    y_scale = axis_of_errors(sweep)
    if sweep.y["log"]:
        y_scale.apply_y(axes)
    else:
        axes.set_ylim(min(0.0, y_scale.low), max(y_scale.high, 1e-9) * 1.05)
    if sweep.x["log"] and min(xs) > 0:
        axes.set_xscale("log", base=10)
        axes.xaxis.set_major_formatter(lambda value, _: tidy(value))
        axes.minorticks_off()
    if runs_down(sweep):
        axes.invert_xaxis()
    return y_scale


def draw_curves(axes, groups, kinds, y_scale):
    """Returns (colour, style) of each group."""
    looks = []
    for (members, curve), (kind, dash) in zip(groups, kinds_and_dashes(groups, kinds.family)):
        colour, marker = kinds.looks[kind]
        style = (0, dash) if dash else "-"
        looks.append((colour, style))
        xs, ys = [x for x, _ in curve.points], [y_scale.at(y) for _, y in curve.points]
        ours = any(member.ours for member in members)
        axes.plot(xs, ys, color=colour, linestyle=style, linewidth=2.6 if ours else 1.5, zorder=4 if ours else 3)
        if curve.starts_to_fail is not None:
            y = next((y for x, y in curve.points if x == curve.starts_to_fail), 0.0)
            axes.plot([curve.starts_to_fail], [y_scale.at(y)], marker=marker, markersize=8, color="white",
                      markeredgecolor=colour, markeredgewidth=1.8, linestyle="", zorder=5)
    return looks


def label_curves(axes, groups, looks, y_scale, sweep):
    """Names at the ends of the curves, each with a sample of its line."""
    low, high = axes.get_ylim()
    height_in = axes.figure.get_figheight() * axes.get_position().height
    texts = [(*names_of(members), failing(curve, sweep)) for members, curve in groups]
    heights = [(0.07 + LINE_IN * sum(map(line_count, text))) / height_in for text in texts]
    ties = [-place_of_failure(curve) for _, curve in groups]  # the first to fail at the top
    wanted = [(y_scale.at(curve.points[-1][1]) - low) / (high - low) for _, curve in groups]
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
    y_scale = set_axis(axes, sweep)
    looks = draw_curves(axes, groups, kinds, y_scale)
    axes.margins(x=0.02)
    label_curves(axes, groups, looks, y_scale, sweep)
    unit = f", {sweep.x['unit']}" if sweep.x["unit"] else ""
    axes.set_xlabel(f"{sweep.x['name']}{unit}")
    axes.set_ylabel(sweep.y["name"].replace("10^6", "10⁶"))
    more = ", more often than rounding to 1/256 px does by itself" if max(sweep.by_snapping) > 0 else ""
    note = f"Bold: ours. Hollow marks: the method starts to fail{more}.{trials_note(sweep)}"
    save(figure, folder, f"stability-{sweep.name}", f"{note}\n{caption}")
    return f"stability-{sweep.name}"


def draw(sweeps, accuracy, folder, caption):
    """The names of the charts drawn."""
    methods = known_methods(accuracy)
    return [name for sweep in sweeps if (name := sweep_chart(sweep, methods, folder, caption))]
