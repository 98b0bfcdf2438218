"""The charts of accuracy: errors against speed and errors by scene, family by family; and the turning cube."""
import math

from accuracy_rows import FAMILIES
from plot_labels import Label, label_points, shared_labels
from plot_style import BAND, FAINT, INK, WHISKER, WIDTH_IN, Kinds, ZeroAxis, head_in, headline, plt, round_ticks, save
from tables import number, short


def front_line(points, right, top):
    """A step line along the points (x, y) that no other beats in both coordinates, from the top edge to the right one."""
    best = []
    for x, y in sorted(points):
        if not best or y < best[-1][1]:
            best.append((x, y))
    line = [(best[0][0], top), best[0]]
    for x, y in best[1:]:
        line += [(x, line[-1][1]), (x, y)]
    return [*line, (right, line[-1][1])]


def draw_points(axes, scene, kinds):
    """Returns labels for label_points(), and the lines that they are to keep off."""
    scale = ZeroAxis([m.rate for m in scene.single])
    bounds = [m.bound for m in scene.single if m.bound is not None]
    scale.apply_x(axes, f"0\n(<{float(f'{max(bounds):.2g}'):g})" if bounds else "0")
    costs = [end for m in scene.single for end in m.costs[1].interval]
    bottom, top = min(costs) / 1.3, max(costs) * 1.3
    axes.set_yscale("log")
    axes.set_ylim(bottom, top)
    round_ticks(axes.yaxis, bottom, top, lambda value, _: f"{value:g}")
    lines = [front_line([(scale.at(m.rate), m.costs[1].ns) for m in scene.single], scale.limit, top)]
    axes.plot(*zip(*lines[0]), **FRONT, zorder=1.5)
    labels, others = [], []
    for m in scene.single:
        x, y, (colour, marker) = scale.at(m.rate), m.costs[1].ns, kinds.of(m.method)
        lines.append([(x, end) for end in m.costs[1].interval])
        axes.plot(*zip(*lines[-1]), color=colour, **WHISKER, zorder=1.8)
        face, edge = ("white", colour) if m.snapped_rate else (colour, "white")
        axes.plot([x], [y], marker=marker, linestyle="", zorder=3, markersize=7, markerfacecolor=face, markeredgecolor=edge,
                  markeredgewidth=1.5 if m.snapped_rate else 0.8)
        if m.method.ours:
            labels.append(Label(x, y, m.method.name, bold=True))
        else:
            others.append((x, y, m.method.name))
    return [*labels, *shared_labels(others, NEAR)], lines


NEAR = 1.12  # ratio of times below which marks touch
FRONT = {"color": INK, "linewidth": 1.2, "linestyle": (0, (4, 2))}


def speed_title(scene):
    """How many other methods err less than our fastest."""
    ours, others = ([m for m in scene.single if m.method.ours == whose] for whose in (True, False))
    if not ours or not others:
        return f"{scene.name}: {scene.family}"
    first = min(ours, key=lambda m: m.costs[1].ns)
    less = sum(m.rate < first.rate for m in others)
    return f"{first.method.name}: {number(first.rate, 2)} errors per 10⁶; {less} of {len(others)} others err less"


def speed_chart(scene, folder, caption):
    family = FAMILIES[scene.family]
    kinds = Kinds(family)
    subtitle = f"Further left: fewer errors; further down: faster. {family.reading}"
    above, below = 0.85 + head_in(subtitle), 1.12
    figure, axes = plt.subplots(figsize=(WIDTH_IN, above + below + 3.8))
    height = figure.get_figheight()
    top = headline(figure, speed_title(scene), subtitle)
    figure.subplots_adjust(left=0.07, right=0.985, bottom=below / height, top=1 - above / height)
    labels, lines = draw_points(axes, scene, kinds)
    axes.set_ylabel(family.cost)
    axes.set_xlabel(family.errors)
    axes.set_title(f"{scene.name}: {scene.summary}; {short(scene.trials)} {family.trial}", fontsize=10)
    label_points(axes, labels, lines)
    extra = [plt.Line2D([], [], **FRONT, label="best on one thread"),
             plt.Line2D([], [], color=FAINT, **WHISKER, label="95 % interval")]
    if any(m.snapped_rate for m in scene.measured):
        extra.append(plt.Line2D([], [], color=FAINT, marker="o", markerfacecolor="white", markeredgewidth=1.4,
                                linestyle="", markersize=7, label="hollow: errs given the snapped positions"))
    kinds.legend(figure, top, [m.method for m in scene.measured], extra)
    notes = ["0: no error seen; in brackets the 95 % upper bound, 3/N."]
    if beyond := family.beyond_note(m.rate for m in scene.measured):
        notes.append(f"{beyond[2:]}.")
    save(figure, folder, f"accuracy-{family.name}", " ".join(notes) + "\n" + caption)
    return f"accuracy-{family.name}"


def cube_title(rows):
    """The worst frames of ours and of the worst method."""
    found = [(method, counts["gaps"][1], counts["double_hits"][1]) for method, counts in rows]
    method, gaps, doubles = max(found, key=lambda row: row[1] + row[2])
    ours = [(g, d) for m, g, d in found if m.ours] or [(0, 0)]
    return (f"Ours: {max(g for g, _ in ours):,.0f} gaps, {max(d for _, d in ours):,.0f} double hits; {method.name}: up to {gaps:,.0f} and "
            f"{doubles:,.0f}")


def turning_cube(accuracy, folder, caption):
    """Gaps and double hits per frame: a line from the median frame to the worst."""
    if not accuracy.cube or not accuracy.cube["methods"]:
        return None
    kinds = Kinds(FAMILIES["coverage"])
    rows = accuracy.cube["methods"]
    figure, panels = plt.subplots(1, 2, sharey=True, figsize=(WIDTH_IN, 2.1 + 0.26 * len(rows)))
    for axes, key, title in zip(panels, ("gaps", "double_hits"), ("Gaps", "Double hits")):
        scale = ZeroAxis([value for _, found in rows for value in found[key]])
        scale.apply_x(axes)
        for line, (method, found) in enumerate(rows):
            colour, marker = kinds.of(method)
            median, worst = (scale.at(value) for value in found[key])
            axes.plot([median, worst], [line, line], color=colour, linewidth=1.6)
            axes.plot([worst], [line], marker=marker, color=colour, markersize=7, markerfacecolor="white",
                      markeredgewidth=1.5)
            axes.plot([median], [line], marker=marker, color=colour, markersize=5)
        axes.set_title(title)
        axes.set_xlabel("pixels per frame")
        axes.set_yticks(range(len(rows)), [method.name for method, _ in rows])
        axes.tick_params(axis="y", length=0)
        axes.set_ylim(len(rows) - 0.5, -0.5)
    height = figure.get_figheight()
    top = headline(figure, cube_title(rows), f"{accuracy.cube['frames']:,} frames of the tutorials' cube, judged by exact "
                   "arithmetic on the positions before any snapping. Filled: the median frame; hollow: the worst frame.")
    figure.subplots_adjust(left=0.15, right=0.985, bottom=0.9 / height, top=top - 0.35 / height, wspace=0.06)
    note = "Cracks at edges that two triangles share; pixels lost at a moved outline do not count."
    save(figure, folder, "turning-cube", f"{note}\n{caption}")
    return "turning-cube"


def cell_text(rate):
    return "0" if rate == 0 else "<1" if rate < 1 else short(float(f"{rate:.2g}"))


def shade(rate):
    """From 0 for no errors to 1."""
    return min(1.0, math.log10(1 + rate) / 6)


CRACKS = {"t_junction": "its crack, in pixels", "t_junction_split": "its crack once split"}


def chart_rows(scenes):
    """(label, text of each method, rate of each method) of each row. A T-junction has a second row with its crack, since its
    rate does not show that splitting the edge closes the crack."""
    rows = []
    for scene in scenes:
        rates = {m.method.name: m.rate for m in scene.measured}
        rows.append((scene.name, {name: cell_text(rate) for name, rate in rates.items()}, rates))
        if scene.name in CRACKS and all(m.cracks for m in scene.measured):
            cracks = {m.method.name: m.cracks.t_junctions for m in scene.measured}
            rows.append((CRACKS[scene.name], {name: short(count) for name, count in cracks.items()},
                         {name: 1e6 * count / scene.trials for name, count in cracks.items()}))
    return rows


def errors_title(accuracy, family):
    """In how many scenes ours and the other methods err."""
    erring, total = accuracy.scenes_with_errors(family.name), len(accuracy.of(family.name))

    def scenes(ours):
        counts = [erring[m.name] for m in accuracy.methods[family.name] if m.ours == ours] or [0]
        return "–".join(dict.fromkeys(map(str, (min(counts), max(counts)))))

    return f"Ours err in {scenes(True)} of {total} scenes, others in {scenes(False)}"


def all_scenes(accuracy, family, folder, caption):
    """Every method on every scene: the rate as a number, and as a shade."""
    scenes, methods = chart_rows(accuracy.of(family.name)), accuracy.methods[family.name]
    if not scenes or not methods:
        return None
    slanted = len(methods) > 8 or max(len(method.name) for method in methods) > 14  # or they run into one another
    note = family.beyond_note(rate for _, _, rates in scenes for rate in rates.values())
    subtitle = (f"{family.errors[0].upper()}{family.errors[1:]}, scene by scene; n is the number of {family.trial}. "
                "Bold: ours." + (" Italics: pixels of the crack." if any(label in CRACKS.values() for label, _, _ in scenes) else ""))
    above = head_in(subtitle) + (0.95 if slanted else 0.5)
    figure, axes = plt.subplots(figsize=(WIDTH_IN, above + (0.55 if note else 0.4) + 0.27 * len(scenes)))
    shades = plt.get_cmap("YlOrBr")
    for line, (_, texts, rates) in enumerate(scenes):
        for place, method in enumerate(methods):
            rate = rates.get(method.name)
            if rate is None:
                continue
            dark = shade(rate)
            axes.add_patch(plt.Rectangle((place - 0.48, line - 0.46), 0.96, 0.92, linewidth=0,
                                         facecolor=shades(0.08 + 0.8 * dark) if rate else BAND))
            axes.text(place, line, texts[method.name], ha="center", va="center", fontsize=7.5 if len(methods) > 12 else 8.5,
                      color="white" if dark > 0.75 else INK)
    axes.set_xlim(-0.5, len(methods) - 0.5)
    axes.set_ylim(len(scenes) - 0.5, -0.5)
    trials = {scene.name: f" (n = {short(scene.trials)})" for scene in accuracy.of(family.name)}
    axes.set_yticks(range(len(scenes)), [label + trials.get(label, "") for label, _, _ in scenes], fontsize=8.5)
    for tick, (label, _, _) in zip(axes.get_yticklabels(), scenes):
        tick.set_fontstyle("italic" if label in CRACKS.values() else "normal")
    axes.xaxis.tick_top()
    axes.set_xticks(range(len(methods)), [method.name for method in methods], fontsize=9)
    for tick, method in zip(axes.get_xticklabels(), methods):
        tick.set(fontweight="bold" if method.ours else "normal", rotation_mode="anchor", rotation=30 if slanted else 0,
                 ha="left" if slanted else "center")
    axes.tick_params(length=0)
    axes.grid(visible=False)
    for spine in axes.spines.values():
        spine.set_visible(False)
    height = figure.get_figheight()
    headline(figure, errors_title(accuracy, family), subtitle)
    figure.subplots_adjust(left=0.235, right=0.945 if slanted else 0.985, bottom=(0.5 if note else 0.35) / height,
                           top=1 - above / height)
    save(figure, folder, f"errors-{family.name}", f"{note[2:]}.\n{caption}" if note else caption)
    return f"errors-{family.name}"


def draw(accuracy, folder, caption):
    """The names of the charts drawn, or None."""
    if accuracy is None:
        return []
    scenes = [all_scenes(accuracy, family, folder, caption) for family in FAMILIES.values()]
    charts = [speed_chart(scene, folder, caption) for family in FAMILIES.values()
              if family.reading and (scene := accuracy.main_scene(family.name))]
    return [*charts, *scenes, turning_cube(accuracy, folder, caption)]
