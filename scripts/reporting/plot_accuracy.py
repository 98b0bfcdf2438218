"""The charts of accuracy, one per family: the errors of each method on each scene."""
import numpy as np
from matplotlib.colors import LogNorm

from accuracy_rows import FAMILIES
from plot_style import BAND, INK, chart, plt, save
from tables import short

SHADES = plt.get_cmap("YlOrBr").with_extremes(bad=BAND)  # bad: no errors


def errors_title(rates, methods):
    """In how many scenes ours and the other methods err."""
    def erring(ours):
        counts = [int(np.count_nonzero(column)) for column, method in zip(rates.T, methods) if method.ours == ours] or [0]
        return "–".join(dict.fromkeys(map(str, (min(counts), max(counts)))))

    return f"Ours err in {erring(True)} of {len(rates)} scenes, others in {erring(False)}"


def errors(accuracy, family, folder, caption):
    """Every method on every scene: the rate as a number, and as a shade."""
    scenes = accuracy.scenes[family] if accuracy else []
    if not scenes:
        return None
    methods, words = accuracy.methods[family], FAMILIES[family]
    rates = np.array([[scene.rates[method.name] for method in methods] for scene in scenes])
    figure, [[axes]] = chart(errors_title(rates, methods),
                             f"{words.errors}; n is the number of {words.trial}. More than 10⁶: one trial can cost many pixels. Bold: ours.",
                             caption, 1.1 + 0.27 * len(scenes))
    axes.pcolormesh(rates, cmap=SHADES, norm=LogNorm(0.3, 2e7), edgecolors="white", linewidth=2)
    for (line, place), rate in np.ndenumerate(rates):
        text = "0" if rate == 0 else "<1" if rate < 1 else short(float(f"{rate:.2g}"))
        axes.text(place + 0.5, line + 0.5, text, ha="center", va="center", fontsize=7.5 if len(methods) > 12 else 8.5,
                  color="white" if rate > 3e4 else INK)
    axes.invert_yaxis()
    axes.xaxis.tick_top()
    axes.set_yticks(np.arange(len(scenes)) + 0.5, [f"{scene.name} (n = {short(scene.trials)})" for scene in scenes], fontsize=8.5)
    axes.set_xticks(np.arange(len(methods)) + 0.5, [method.name for method in methods], fontsize=9, rotation=30, rotation_mode="anchor", ha="left")
    for tick, method in zip(axes.get_xticklabels(), methods):
        tick.set_fontweight("bold" if method.ours else "normal")
    axes.tick_params(length=0)
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)
    return save(figure, folder, f"errors-{family}")
