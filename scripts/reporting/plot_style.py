"""One look for all charts: light, colour-blind safe, one colour a backend, the same bytes for the same data."""
import colorsys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import to_hex, to_rgb  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullFormatter  # noqa: E402

from palette import FAINT, INK, MARKERS, PALETTE  # noqa: E402
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


class Look:
    """Colour and marker of each backend."""

    def __init__(self, backends):
        self.backends = backends

    def colour(self, backend):
        return PALETTE[self.backends.index(backend) % len(PALETTE)]

    def text_colour(self, backend):
        """Dark enough to read on white."""
        hue, light, saturation = colorsys.rgb_to_hls(*to_rgb(self.colour(backend)))
        return to_hex(colorsys.hls_to_rgb(hue, min(light, 0.30), saturation))

    def marker(self, backend):
        return MARKERS[self.backends.index(backend) % len(MARKERS)]

    def legend(self, figure, y, extra=()):
        handles = [plt.Line2D([], [], color=self.colour(b), marker=self.marker(b), linestyle="", markersize=7, label=b)
                   for b in self.backends]
        figure.legend(handles=[*handles, *extra], loc="upper left", bbox_to_anchor=(0.005, y), ncol=6, frameon=False,
                      handletextpad=0.4, columnspacing=1.6, fontsize=10.5)


def headline(figure, title, subtitle, y=1.0):
    """Returns the height, in figure fractions, below which the axes may begin."""
    height_in = figure.get_figheight()
    figure.text(0.012, y - 0.12 / height_in, title, fontsize=14, fontweight="bold", va="top")
    figure.text(0.012, y - 0.43 / height_in, subtitle, fontsize=10, color=FAINT, va="top")
    return y - (0.55 + 0.2 * subtitle.count("\n")) / height_in


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
    figure.text(0.012, 0.07 / figure.get_figheight(), caption, fontsize=7.5, color=FAINT, va="bottom")
    partial = Path(folder) / f".{name}.partial.svg"
    figure.savefig(partial, dpi=130, metadata={"Date": None})
    partial.replace(Path(folder) / f"{name}.svg")
    plt.close(figure)
