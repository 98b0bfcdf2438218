"""The charts of accuracy, one per family: the errors of each method on each scene."""
import math

from accuracy_rows import FAMILIES, LEAST_SHARE
from plot_style import BAND, INK, WIDTH_IN, head_in, headline, plt, save
from tables import percent, short


def cell_text(rate):
    return "0" if rate == 0 else "<1" if rate < 1 else short(float(f"{rate:.2g}"))


def shade(rate):
    """From 0 for no errors to 1."""
    return min(1.0, math.log10(1 + rate) / 6)


CRACKS = {"t_junction": "its crack, in pixels", "t_junction_split": "its crack once split"}


POOLED = "pooled"


def chart_rows(accuracy, family):
    """(label, text of each method, rate of each method) of each row: of the pooled scenes, then of each scene. A T-junction has a
    second row with its crack, since its rate does not show that splitting the edge closes the crack."""
    pooled = {method.name: found.rate for method in accuracy.methods[family] if (found := accuracy.rate(family, method))}
    rows = [(POOLED, {name: cell_text(rate) for name, rate in pooled.items()}, pooled)] if pooled else []
    for scene in accuracy.of(family):
        rates = {m.method.name: m.rate for m in scene.measured}
        rows.append((scene.name, {name: cell_text(rate) for name, rate in rates.items()}, rates))
        if scene.name in CRACKS and scene.family == "coverage":
            cracks = {m.method.name: m.t_junctions for m in scene.measured}
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
    scenes, methods = chart_rows(accuracy, family.name), accuracy.methods[family.name]
    if not scenes or not methods:
        return None
    slanted = len(methods) > 8 or max(len(method.name) for method in methods) > 14  # or they run into one another
    note = family.beyond if any(rate > 1e6 for _, _, rates in scenes for rate in rates.values()) else ""
    subtitle = (f"{family.errors[0].upper()}{family.errors[1:]}, scene by scene; n is the number of {family.trial}. "
                f"First row: the scenes with at least {percent(LEAST_SHARE)} of the largest one's. Bold: ours."
                + (" Italics: pixels of the crack." if any(label in CRACKS.values() for label, _, _ in scenes) else ""))
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
    save(figure, folder, f"errors-{family.name}", f"{note}\n{caption}" if note else caption)
    return f"errors-{family.name}"


def draw(accuracy, folder, caption):
    """The names of the charts drawn, or None."""
    if accuracy is None:
        return []
    return [all_scenes(accuracy, family, folder, caption) for family in FAMILIES.values()]
