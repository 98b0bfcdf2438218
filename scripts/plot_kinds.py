"""What the charts of accuracy and of stability share: a look for each kind of method, and log axes that show 0."""
import math

from plot_style import PALETTE, plt
from tables import short

OURS, OTHER = PALETTE[0], PALETTE[3]
KIND_COLOURS, KIND_MARKERS = (PALETTE[1], PALETTE[2], PALETTE[4]), ("s", "^", "D")
BAND = "#eef4ee"


class Kinds:
    """Colour and marker of each kind of method in a family."""

    def __init__(self, family):
        self.family = family
        self.looks = {"ours": (OURS, "o"), "other": (OTHER, "v")}
        self.looks.update({kind: look for kind, *look in zip(family.kinds, KIND_COLOURS, KIND_MARKERS)})

    def of(self, method):
        return self.looks[self.family.kind(method)]

    def legend(self, figure, y, methods, extra):
        """Kinds of methods, and below them what else marks a point."""
        present = {self.family.kind(method) for method in methods}
        names = {"ours": "ours (bold)", "other": "others"}
        handles = [plt.Line2D([], [], color=colour, marker=marker, linestyle="", markersize=7, label=names.get(kind, kind))
                   for kind, (colour, marker) in sorted(self.looks.items(), key=lambda item: item[0] == "other")
                   if kind in present]
        for line, row in enumerate((handles, extra)):
            figure.legend(handles=row, loc="upper left", bbox_to_anchor=(0.005, y - 0.2 * line / figure.get_figheight()),
                          ncol=len(row), frameon=False, handletextpad=0.4, columnspacing=1.3, fontsize=9.5)


class ZeroAxis:
    """Places for values from 0 up on a log axis that begins with a band for 0; in decades."""

    def __init__(self, values):
        seen = [math.log10(v) for v in values if v > 0] or [0.0, 1.0]
        self.low, self.high = math.floor(min(seen)), math.ceil(max(seen) - 1e-9)
        if self.high - self.low < 2:
            self.low, self.high = self.low - 1, self.low + 2
        decades = self.high - self.low
        self.end = self.low - 0.035 * decades  # of the band
        self.start = self.end - 0.15 * decades
        self.zero = (self.start + self.end) / 2
        self.limit = self.high + 0.04 * decades

    def at(self, value):
        return math.log10(value) if value > 0 else self.zero

    def ticks(self, zero):
        step = max(1, math.ceil((self.high - self.low) / 8))
        places = list(range(self.low, self.high + 1, step))
        return [self.zero, *places], [zero, *(short(10.0 ** k) for k in places)]

    def apply_x(self, axes, zero="0"):
        axes.set_xticks(*self.ticks(zero))
        axes.set_xlim(self.start, self.limit)
        axes.axvspan(self.start, self.end, color=BAND, zorder=0, linewidth=0)

    def apply_y(self, axes):
        axes.set_yticks(*self.ticks("0"))
        axes.set_ylim(self.start, self.limit)
        axes.axhspan(self.start, self.end, color=BAND, zorder=0, linewidth=0)
