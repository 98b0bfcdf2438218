"""The common look of all charts: light, colour-blind safe, one meaning for a colour, the same bytes for the same data."""
import colorsys
import math
import re
import textwrap
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import to_hex, to_rgb  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullFormatter  # noqa: E402

from tables import short  # noqa: E402

# Okabe and Ito, "Color Universal Design", 2008.
BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9"
INK, FAINT = "#24292f", "#6e7781"
BAND = "#f0f2f4"  # behind a special part of an axis

BACKENDS = {"scanline": (BLUE, "o"), "naive": (ORANGE, "s"), "tiled": (GREEN, "^")}
ADDED = (("#7f5539", "D"), ("#8a8f00", "v"), ("#5c4d9a", "P"), ("#6b705c", "X"))  # for backends that a user adds

plt.rcParams.update({
    "figure.facecolor": "white", "axes.facecolor": "white", "savefig.facecolor": "white",
    "font.family": "DejaVu Sans", "font.size": 10.5, "text.color": INK, "axes.labelcolor": INK,
    "axes.edgecolor": "#afb8c1", "axes.linewidth": 0.8, "axes.spines.top": False, "axes.spines.right": False,
    "axes.titlesize": 11, "axes.titlelocation": "left", "axes.axisbelow": True,
    "xtick.color": FAINT, "ytick.color": FAINT, "xtick.labelcolor": INK, "ytick.labelcolor": INK,
    "axes.grid": True, "grid.color": "#e6e9ec", "grid.linewidth": 0.8,
    "lines.linewidth": 2.0, "lines.markersize": 5.0, "svg.hashsalt": "edgewise", "svg.fonttype": "path",
})


WIDTH_IN = 10.0  # of every chart


def dark(colour):
    """Dark enough to read on white."""
    hue, light, saturation = colorsys.rgb_to_hls(*to_rgb(colour))
    return to_hex(colorsys.hls_to_rgb(hue, min(light, 0.30), saturation))


class Look:
    """Colour and marker of each backend."""

    def __init__(self, backends):
        self.backends = backends
        added = [backend for backend in backends if backend not in BACKENDS]
        self.looks = {backend: BACKENDS.get(backend) or ADDED[added.index(backend) % len(ADDED)] for backend in backends}

    def colour(self, backend):
        return self.looks[backend][0]

    def marker(self, backend):
        return self.looks[backend][1]

    def legend(self, figure, y, extra=()):
        handles = [plt.Line2D([], [], color=self.colour(b), marker=self.marker(b), linestyle="", markersize=7, label=b)
                   for b in self.backends]
        figure.legend(handles=[*handles, *extra], loc="upper left", bbox_to_anchor=(0.005, y), ncol=6, frameon=False,
                      handletextpad=0.4, columnspacing=1.6, fontsize=10.5)


def wrapped(text, type_size, width_in=WIDTH_IN):
    return textwrap.fill(text, int(128 * width_in / type_size))


def head_in(subtitle, width_in=WIDTH_IN):
    """The height of a title and a subtitle, in inches."""
    return 0.55 + 0.2 * wrapped(subtitle, 10, width_in).count("\n")


def headline(figure, title, subtitle):
    """Returns the height, in figure fractions, below which the axes may begin. A long title is set in smaller type."""
    height_in, width_in, room = figure.get_figheight(), figure.get_figwidth(), 0.976 * figure.bbox.width
    text = figure.text(0.012, 1 - 0.12 / height_in, title, fontsize=14, fontweight="bold", va="top", gid="title")
    width = text.get_window_extent(figure.canvas.get_renderer()).width
    text.set_fontsize(14 * min(1.0, room / width))
    figure.text(0.012, 1 - 0.43 / height_in, wrapped(subtitle, 10, width_in), fontsize=10, color=FAINT, va="top")
    return 1 - head_in(subtitle, width_in) / height_in


# An interval, as a light bar.
WHISKER = {"linewidth": 3.0, "alpha": 0.3, "solid_capstyle": "butt"}


def round_ticks(axis, low, high, text, ratios=False):
    """Few round numbers on a log axis whose limits are set already; of `ratios` below 1 the reciprocal is round."""
    steps = (1, 1.5, 2, 3, 5, 7) if high / low < 12 else (1, 2, 5)
    ticks = {step * 10.0 ** k for k in range(-4, 5) for step in steps}
    if ratios:
        ticks = {end for tick in ticks if tick >= 1 for end in (tick, 1 / tick)}
    axis.set_ticks(sorted(tick for tick in ticks if low <= tick <= high))
    axis.set_ticks([], minor=True)
    axis.set_major_formatter(text)


def log_axis(axis):
    axis.set_major_formatter(FuncFormatter(short))
    axis.set_minor_formatter(NullFormatter())


class ZeroAxis:
    """Positions, in decades, of values ≥ 0 on a log axis that begins with a band for 0."""

    def __init__(self, values, band=0.18):
        """`band`: the width of the band, as a part of the log axis."""
        seen = [math.log10(v) for v in values if v > 0] or [0.0, 1.0]
        self.low, self.high = math.floor(min(seen)), max(seen)
        self.high = max(self.high, self.low + 1)
        decades = self.high - self.low
        self.end = self.low - 0.035 * decades  # of the band
        self.start = self.end - band * decades
        self.zero = (self.start + self.end) / 2
        self.limit = self.high + 0.04 * decades

    def at(self, value):
        return math.log10(value) if value > 0 else self.zero

    def ticks(self, zero):
        step = max(1, math.ceil((self.high - self.low) / 8))
        places = list(range(self.low, math.floor(self.high + 1e-9) + 1, step))
        return [self.zero, *places], [zero, *(short(10.0 ** k) for k in places)]

    def apply_x(self, axes, zero="0"):
        axes.set_xticks(*self.ticks(zero))
        axes.set_xlim(self.start, self.limit)
        axes.axvspan(self.start, self.end, color=BAND, zorder=0, linewidth=0)


def caption_lines(caption, width_in=WIDTH_IN):
    return "\n".join(wrapped(line, 7.5, width_in) for line in caption.split("\n"))


def foot_in(caption, width_in=WIDTH_IN):
    """The height of an axis' label and a caption, in inches."""
    return 0.75 + 0.13 * caption_lines(caption, width_in).count("\n")


def smaller(svg):
    """The same drawing in two thirds of the bytes: lengths with two digits after the point, which are hundredths of a pixel."""
    svg = re.sub(r"(scale\([^)]*\))|\d+\.\d{3,}", lambda found: found[1] or f"{float(found[0]):.2f}".rstrip("0").rstrip("."), svg)
    return re.sub(r"([A-Z]) (?=[-\d])", r"\1", re.sub(r"\s*\n\s*", "\n", svg)).replace("DejaVuSans", "d")


def save(figure, folder, name, caption):
    lines = caption_lines(caption, figure.get_figwidth())
    figure.text(0.012, 0.07 / figure.get_figheight(), lines, fontsize=7.5, color=FAINT, va="bottom")
    partial = Path(folder) / f".{name}.partial.svg"
    figure.savefig(partial, dpi=130, metadata={"Date": None})
    partial.write_text(smaller(partial.read_text(encoding="utf-8")), encoding="utf-8")
    partial.replace(Path(folder) / f"{name}.svg")
    plt.close(figure)
