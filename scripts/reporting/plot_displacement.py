"""The strip of displacement: how many pixels change only because vertices are rounded, by the number of subpixel bits."""
import math

from palette import BLACK, FAINT, SKY
from plot_style import WIDTH_IN, dark, head_in, headline, plt, save
from tables import number, short

# Exact coverage of vertices rounded to so many bits: all that differs from the unsnapped truth is displaced.
METHODS = {0: "whole_pixel", 4: "fixed_4", 8: "fixed_8", 12: "fixed_12", 16: "fixed_16"}
OURS = 8


def displacement(accuracy):
    """({bits: wrong pixels per 10⁶ edge crossings}, number of scenes, number of crossings)."""
    scenes = accuracy.pooled("coverage")
    trials = sum(scene.trials for scene in scenes)
    rates = {}
    for bits, name in METHODS.items():
        errors = [m.rate * scene.trials for scene in scenes for m in scene.measured if m.method.name == name]
        if trials and len(errors) == len(scenes):
            rates[bits] = sum(errors) / trials
    return rates, len(scenes), trials


def strip(accuracy, folder, caption):
    rates, scenes, trials = displacement(accuracy) if accuracy else ({}, 0, 0)
    if rates.keys() != METHODS.keys() or not all(rates.values()):  # a log axis has no 0
        return None
    subtitle = (f"Pixels that change because vertices are rounded, per 10⁶ edge crossings; {scenes} scenes, {short(trials)} "
                "crossings.")
    above, below = 0.1 + head_in(subtitle), 0.6
    figure, axes = plt.subplots(figsize=(WIDTH_IN, above + below + 1.25))
    height = figure.get_figheight()
    headline(figure, f"Rounding to {OURS} subpixel bits displaces {number(rates[OURS])} pixels per 10⁶ crossings", subtitle)
    figure.subplots_adjust(left=0.13, right=0.985, bottom=below / height, top=1 - above / height)
    lines = range(len(rates))
    axes.barh(lines, rates.values(), color=[BLACK if bits == OURS else SKY for bits in rates], height=0.68)
    axes.set_xscale("log")
    axes.set_xlim(10 ** math.floor(math.log10(min(rates.values()))), max(rates.values()) * 2.5)
    axes.xaxis.set_major_formatter(lambda value, _: short(value))
    axes.set_yticks(lines, [f"{bits} bits" + (" (ours)" if bits == OURS else "") for bits in rates])
    axes.tick_params(axis="y", length=0)
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    for line, (bits, rate) in zip(lines, rates.items()):
        axes.text(rate * 1.06, line, number(rate), va="center", fontsize=9.5, color=dark(BLACK if bits == OURS else FAINT))
    save(figure, folder, "displacement", caption)
    return "displacement"
