"""The common look of all charts: light, colour-blind safe, one colour per backend, the same bytes for the same data."""
import colorsys
import textwrap
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import to_hex, to_rgb  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullFormatter  # noqa: E402

from palette import BACKENDS, FAINT, INK, backend_looks, kind_looks  # noqa: E402
from tables import short  # noqa: E402

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
        self.looks = backend_looks(backends)

    def colour(self, backend):
        return self.looks[backend][0]

    def text_colour(self, backend):
        return dark(self.colour(backend))

    def marker(self, backend):
        return self.looks[backend][1]

    def legend(self, figure, y, extra=()):
        handles = [plt.Line2D([], [], color=self.colour(b), marker=self.marker(b), linestyle="", markersize=7, label=b)
                   for b in self.backends]
        figure.legend(handles=[*handles, *extra], loc="upper left", bbox_to_anchor=(0.005, y), ncol=6, frameon=False,
                      handletextpad=0.4, columnspacing=1.6, fontsize=10.5)


IN_A_ROW = 7  # of the legend


class Kinds:
    """Colour and marker of the methods of a family."""

    def __init__(self, family):
        self.family = family
        self.looks = kind_looks(family)

    def of(self, method):
        return BACKENDS.get(method.name) or self.looks[self.family.kind(method)]

    def legend(self, figure, y, methods, extra):
        """Backends and kinds of methods, and below them the other marks."""
        found = {(method.name if method.name in BACKENDS else self.family.kind(method)): self.of(method) for method in methods}
        names = {"ours": "ours (bold)", "other": "others", **{name: f"{name} (ours)" for name in BACKENDS}}
        handles = [plt.Line2D([], [], color=colour, marker=marker, linestyle="", markersize=7, label=names.get(kind, kind))
                   for kind, (colour, marker) in sorted(found.items(), key=lambda item: item[0] == "other")]
        rows = [handles[i:i + IN_A_ROW] for i in range(0, len(handles), IN_A_ROW)]
        for line, row in enumerate((*rows, extra)):
            figure.legend(handles=row, loc="upper left", bbox_to_anchor=(0.005, y - 0.2 * line / figure.get_figheight()),
                          ncol=len(row), frameon=False, handletextpad=0.4, columnspacing=1.3, fontsize=9.5)


def wrapped(text, type_size, width_in=WIDTH_IN):
    return textwrap.fill(text, int(133 * width_in / type_size))


def head_in(subtitle):
    """The height of a title and a subtitle, in inches."""
    return 0.55 + 0.2 * wrapped(subtitle, 10).count("\n")


def headline(figure, title, subtitle):
    """Returns the height, in figure fractions, below which the axes may begin. A long title is set in smaller type."""
    height_in, room = figure.get_figheight(), 0.976 * figure.bbox.width
    text = figure.text(0.012, 1 - 0.12 / height_in, title, fontsize=14, fontweight="bold", va="top", gid="title")
    width = text.get_window_extent(figure.canvas.get_renderer()).width
    text.set_fontsize(14 * min(1.0, room / width))
    figure.text(0.012, 1 - 0.43 / height_in, wrapped(subtitle, 10), fontsize=10, color=FAINT, va="top")
    return 1 - head_in(subtitle) / height_in


def log_axis(axis):
    axis.set_major_formatter(FuncFormatter(short))
    axis.set_minor_formatter(NullFormatter())


def spread_labels(positions, gap):
    """Moves label positions (any unit) apart to at least `gap`, keeping their order and their middle."""
    order = sorted(range(len(positions)), key=lambda i: positions[i])
    placed = [positions[i] for i in order]
    for _ in range(100):
        moved = False
        for i in range(len(placed) - 1):
            lack = gap - (placed[i + 1] - placed[i])
            if lack > 1e-9:
                placed[i] -= lack / 2
                placed[i + 1] += lack / 2
                moved = True
        if not moved:
            break
    result = [0.0] * len(positions)
    for i, index in enumerate(order):
        result[index] = placed[i]
    return result


def save(figure, folder, name, caption):
    lines = "\n".join(wrapped(line, 7.5) for line in caption.split("\n"))
    figure.text(0.012, 0.07 / figure.get_figheight(), lines, fontsize=7.5, color=FAINT, va="bottom")
    partial = Path(folder) / f".{name}.partial.svg"
    figure.savefig(partial, dpi=130, metadata={"Date": None})
    partial.replace(Path(folder) / f"{name}.svg")
    plt.close(figure)
