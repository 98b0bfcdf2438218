"""The charts of accuracy, one per family: the errors of each method on each scene."""
from accuracy_rows import FAMILIES
from plot_style import BAND, INK, WIDTH_IN, head_in, headline, plt, save
from tables import short


def cell_text(rate):
    return "0" if rate == 0 else "<1" if rate < 1 else short(float(f"{rate:.2g}"))


def errors_title(scenes, methods):
    """In how many scenes ours and the other methods err."""
    def erring(ours):
        counts = [sum(bool(m and m.rate) for scene in scenes if (m := scene.of(method.name))) for method in methods if method.ours == ours] or [0]
        return "–".join(dict.fromkeys(map(str, (min(counts), max(counts)))))

    return f"Ours err in {erring(True)} of {len(scenes)} scenes, others in {erring(False)}"


def errors(accuracy, family, folder, caption):
    """Every method on every scene: the rate as a number, and as a shade."""
    scenes, methods = accuracy.of(family.name), accuracy.methods[family.name]
    if not scenes or not methods:
        return None
    subtitle = f"{family.errors}; n is the number of {family.trial}. More than 10⁶: one trial can cost many pixels. Bold: ours."
    above = head_in(subtitle) + 0.95
    height = above + 0.4 + 0.27 * len(scenes)
    figure, axes = plt.subplots(figsize=(WIDTH_IN, height))
    shades = plt.get_cmap("YlOrBr")
    norm = plt.matplotlib.colors.LogNorm(1, 1e6, clip=True)
    for line, scene in enumerate(scenes):
        for place, method in enumerate(methods):
            if (measured := scene.of(method.name)) is None:
                continue
            rate = measured.rate
            dark = float(norm(1 + rate))
            axes.add_patch(plt.Rectangle((place - 0.48, line - 0.46), 0.96, 0.92, linewidth=0, facecolor=shades(0.08 + 0.8 * dark) if rate else BAND))
            axes.text(place, line, cell_text(rate), ha="center", va="center", fontsize=7.5 if len(methods) > 12 else 8.5,
                      color="white" if dark > 0.75 else INK)
    axes.set(xlim=(-0.5, len(methods) - 0.5), ylim=(len(scenes) - 0.5, -0.5))
    axes.set_yticks(range(len(scenes)), [f"{scene.name} (n = {short(scene.trials)})" for scene in scenes], fontsize=8.5)
    axes.xaxis.tick_top()
    axes.set_xticks(range(len(methods)), [method.name for method in methods], fontsize=9, rotation=30, rotation_mode="anchor", ha="left")
    for tick, method in zip(axes.get_xticklabels(), methods):
        tick.set_fontweight("bold" if method.ours else "normal")
    axes.tick_params(length=0)
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)
    headline(figure, errors_title(scenes, methods), subtitle)
    figure.subplots_adjust(left=0.235, right=0.945, bottom=0.35 / height, top=1 - above / height)
    return save(figure, folder, f"errors-{family.name}", caption)


def draw(accuracy, folder, caption):
    """The names of the charts drawn, or None."""
    return [errors(accuracy, family, folder, caption) for family in FAMILIES.values()] if accuracy else []
