"""The share of pixels that conformant rasterizers may draw differently, by the number of subpixel bits."""
from palette import BLACK, SKY
from plot_style import INK, WIDTH_IN, headline, log_axis, plt, save, spread_labels
from portable import OURS, share
from tables import percent


def portable(found, folder, caption):
    bits = sorted(found)
    scenes = [scene for scene in found.get(OURS, ()) if all(share(found[b][scene]) > 0 for b in bits)]  # a log axis has no 0
    if len(found) < 2 or not scenes:
        return None
    left_out = " Scenes without such a pixel are left out." if len(scenes) < len(found[OURS]) else ""
    most = max(scenes, key=lambda scene: share(found[OURS][scene]))
    factor = share(found[min(found)][most]) / share(found[OURS][most])
    figure, axes = plt.subplots(figsize=(WIDTH_IN, 4.6))
    top = headline(figure, f"{OURS - min(found)} more subpixel bits leave {factor:.0f}× fewer pixels of {most} to differ",
                   "Pixels that two conformant rasterizers may draw differently, in percent of the picture, by the subpixel bits that "
                   f"both have at least.{left_out}")
    figure.subplots_adjust(left=0.09, right=0.86, bottom=0.17, top=top)
    for scene in scenes:
        axes.plot(bits, [share(found[b][scene]) for b in bits], color=BLACK if scene == most else SKY, marker="o", markersize=4,
                  linewidth=2.0 if scene == most else 1.2)
    axes.set_yscale("log")
    log_axis(axes.yaxis)
    axes.yaxis.set_major_formatter(lambda value, _: percent(value))
    axes.set_xticks(bits)
    axes.set_xlabel("subpixel bits")
    axes.set_xlim(bits[0] - 0.1, bits[-1] + 0.05)
    ends = [axes.transData.transform((bits[-1], share(found[bits[-1]][scene])))[1] for scene in scenes]
    for scene, end in zip(scenes, spread_labels(ends, 16)):
        axes.annotate(scene, (1.01, axes.transAxes.inverted().transform((0, end))[1]), xycoords="axes fraction", va="center",
                      fontsize=9.5, color=INK, fontweight="bold" if scene == most else "normal")
    save(figure, folder, "portable", caption)
    return "portable"
