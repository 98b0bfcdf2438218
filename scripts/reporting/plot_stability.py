"""Charts of stability: a figure a sweep, a curve a method, from easy on the left to hard on the right."""
from accuracy_rows import FAMILIES
from palette import FAINT, INK
from plot_kinds import Kinds
from plot_style import headline, plt, save
from stability_curves import (axis_of_errors, failing, groups_of, kinds_and_dashes, known_methods, line_count, names_of,
                              place_of_failure, runs_down, tidy, trials_note)


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
    """Returns what places x and y."""
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
    """Returns (colour, marker, style) of each group."""
    looks = []
    for (members, curve), (kind, dash) in zip(groups, kinds_and_dashes(groups, kinds.family)):
        colour, marker = kinds.looks[kind]
        style = (0, dash) if dash else "-"
        looks.append((colour, marker, style))
        xs, ys = [x for x, _ in curve.points], [y_scale.at(y) for _, y in curve.points]
        ours = any(member.ours for member in members)
        axes.plot(xs, ys, color=colour, linestyle=style, linewidth=2.6 if ours else 1.5, zorder=4 if ours else 3)
        if curve.starts_to_fail is not None:
            y = next((y for x, y in curve.points if x == curve.starts_to_fail), 0.0)
            axes.plot([curve.starts_to_fail], [y_scale.at(y)], marker=marker, markersize=8, color="white",
                      markeredgecolor=colour, markeredgewidth=1.8, linestyle="", zorder=5)
    return looks


def label_curves(axes, groups, looks, y_scale, sweep):
    """Names to the right of where the curves end, each with a sample of its line."""
    low, high = axes.get_ylim()
    height_in = axes.figure.get_figheight() * axes.get_position().height
    texts = [(*names_of(members), failing(curve, sweep)) for members, curve in groups]
    heights = [(0.05 + 0.142 * sum(map(line_count, text))) / height_in for text in texts]
    ties = [-place_of_failure(curve) for _, curve in groups]  # who fails first stands at the top
    wanted = [(y_scale.at(curve.points[-1][1]) - low) / (high - low) for _, curve in groups]
    lows = stacked(wanted, heights, ties)
    for text, height, bottom, end, (colour, marker, style) in zip(texts, heights, lows, wanted, looks):
        y = bottom + height / 2
        place = {"transform": axes.transAxes, "clip_on": False}
        axes.plot([1.0, 1.03], [end, y], color=FAINT, linewidth=0.6, **place)
        axes.plot([1.035, 1.095], [y, y], color=colour, linestyle=style, linewidth=2.2, **place)
        axes.plot([1.065], [y], color="white", marker=marker, markersize=6, markeredgecolor=colour, linestyle="",
                  markeredgewidth=1.5, **place)
        top = bottom + height
        for part, weight, size, ink in zip(text, ("bold", "normal", "normal"), (8.8, 8.8, 8), (INK, INK, FAINT)):
            axes.text(1.105, top, part, transform=axes.transAxes, fontsize=size, va="top", linespacing=1.1, color=ink,
                      fontweight=weight)
            top -= line_count(part) * 0.142 / height_in


def sweep_chart(sweep, methods, folder, caption):
    groups = groups_of(sweep, methods)
    if not groups or not all(curve.points for _, curve in groups):
        return None
    kinds = Kinds(FAMILIES[sweep.family])
    lines = sum(1 + sum(map(line_count, names_of(members))) for members, _ in groups)
    figure, axes = plt.subplots(figsize=(10.4, 1.75 + max(3.4, 0.05 * len(groups) + 0.148 * lines)))
    height = figure.get_figheight()
    title = sweep.name.replace("_", " ").replace("-", " ")
    headline(figure, f"{sweep.family.capitalize()}: {title}",
             f"{sweep.idea[0].upper()}{sweep.idea[1:]}. From easy on the left to hard on the right.")
    figure.subplots_adjust(left=0.08, right=0.66, bottom=0.85 / height, top=1 - 0.85 / height)
    y_scale = set_axis(axes, sweep)
    looks = draw_curves(axes, groups, kinds, y_scale)
    label_curves(axes, groups, looks, y_scale, sweep)
    unit = f", {sweep.x['unit']}" if sweep.x["unit"] else ""
    axes.set_xlabel(f"{sweep.x['name']}{unit}")
    axes.set_ylabel(sweep.y["name"].replace("10^6", "10⁶"))
    more = ", which is to err more than rounding to 1/256 px does by itself" if max(sweep.by_snapping) > 0 else ""
    note = f"Bold: ours. Hollow marks: where a method starts to fail{more}.{trials_note(sweep)}"
    save(figure, folder, f"stability-{sweep.name}", f"{note}\n{caption}")
    return f"stability-{sweep.name}"


def draw(sweeps, accuracy, folder, caption):
    """The names of the charts drawn."""
    methods = known_methods(accuracy)
    return [name for sweep in sweeps if (name := sweep_chart(sweep, methods, folder, caption))]
