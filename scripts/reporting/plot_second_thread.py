"""What two threads lose of their time in a frame, scene by scene."""
from palette import INK, LOSSES as COLOURS
from plot_scenes import room_for
from plot_style import WIDTH_IN, head_in, headline, plt, save
from second_thread import LOSSES, SHORT_MS, TARGET, divisions
from speedups import spread

VERDICTS = {1: f"above {TARGET}×", -1: f"below {TARGET}×", 0: "not settled"}


def second_thread(bench, folder, caption):
    found = divisions(bench)
    if not found:
        return None
    subtitle = (f"Whole frames of tiled that take more than {SHORT_MS:g} ms on one thread. Bars: what two threads lose of their time. "
                "The rest, useful work, is the time of the same frame on one thread; the two are drawn alternately. Slower tasks: what "
                "no other cause explains, with the cost of recording; 0 where tasks are faster. "
                "Right: speed-up, 95 % interval, and what the rounds settle.")
    figure, axes = plt.subplots(figsize=(WIDTH_IN, 1.85 + head_in(subtitle) + 0.4 * len(found)))
    for line, division in enumerate(found):
        if line % 2:
            axes.axhspan(line - 0.5, line + 0.5, color="#f6f8fa", zorder=0)
        left = 0.0
        for cause, loss in division.losses.items():
            axes.barh(line, 100 * loss, left=left, height=0.62, color=COLOURS[cause], zorder=2)
            left += 100 * loss
        low, high = division.interval
        axes.text(1.012, line, f"{division.speed_up:.2f}× ({low:.2f} to {high:.2f}), {VERDICTS[division.order]}",
                  transform=axes.get_yaxis_transform(), fontsize=9, va="center", color=INK,
                  fontweight="bold" if division.order > 0 else "normal")
    axes.set_xlim(left=0)
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g} %")
    axes.set_yticks(range(len(found)), [division.scene for division in found])
    axes.tick_params(axis="y", length=0)
    axes.set_ylim(len(found) - 0.5, -0.5)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("lost share of two threads' time")
    height = figure.get_figheight()
    top = headline(figure, f"A second thread gains {spread([division.speed_up for division in found])}", subtitle)
    handles = [plt.Rectangle((0, 0), 1, 1, color=COLOURS[cause], label=words) for cause, words in LOSSES.items()]
    figure.legend(handles=handles, loc="upper left", bbox_to_anchor=(0.005, top - 0.02 / height), ncol=len(handles), frameon=False,
                  handlelength=1.0, handleheight=1.0, handletextpad=0.4, columnspacing=1.3, fontsize=9.5)
    figure.subplots_adjust(left=room_for([division.scene for division in found]), right=0.72, bottom=0.78 / height,
                           top=top - 0.5 / height)
    save(figure, folder, "second-thread", caption)
    return "second-thread"
