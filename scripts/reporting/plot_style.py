"""The common look of all charts: light, colour-blind safe, one meaning for a colour, the same bytes for the same data."""
import re
import textwrap
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Okabe and Ito, "Color Universal Design", 2008.
BLUE, ORANGE, GREEN = "#0072B2", "#E69F00", "#009E73"
INK, FAINT = "#24292f", "#6e7781"
BAND = "#f0f2f4"  # behind a special part of an axis
WIDTH_IN = 10.0  # of every chart, unless it says otherwise
# An interval, as a light bar.
WHISKER = {"linewidth": 3.0, "alpha": 0.3, "solid_capstyle": "butt"}

plt.rcParams.update({
    "figure.facecolor": "white", "axes.facecolor": "white", "savefig.facecolor": "white",
    "font.family": "DejaVu Sans", "font.size": 10.5, "text.color": INK, "axes.labelcolor": INK,
    "axes.edgecolor": "#afb8c1", "axes.linewidth": 0.8, "axes.spines.top": False, "axes.spines.right": False,
    "axes.titlesize": 11, "axes.titlelocation": "left", "axes.axisbelow": True,
    "xtick.color": FAINT, "ytick.color": FAINT, "xtick.labelcolor": INK, "ytick.labelcolor": INK,
    "axes.grid": True, "grid.color": "#e6e9ec", "grid.linewidth": 0.8,
    "lines.linewidth": 2.0, "lines.markersize": 5.0, "svg.hashsalt": "edgewise", "svg.fonttype": "path",
})


def wrapped(text, type_size, width_in=WIDTH_IN):
    return "\n".join(textwrap.fill(line, int(128 * width_in / type_size)) for line in text.split("\n"))


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


def foot_in(caption, width_in=WIDTH_IN):
    """The height of an axis' label and a caption, in inches."""
    return 0.75 + 0.13 * wrapped(caption, 7.5, width_in).count("\n")


def smaller(svg):
    """The same drawing in two thirds of the bytes: lengths with two digits after the point, which are hundredths of a pixel."""
    svg = re.sub(r"(scale\([^)]*\))|\d+\.\d{3,}", lambda found: found[1] or f"{float(found[0]):.2f}".rstrip("0").rstrip("."), svg)
    return re.sub(r"([A-Z]) (?=[-\d])", r"\1", re.sub(r"\s*\n\s*", "\n", svg)).replace("DejaVuSans", "d")


def save(figure, folder, name, caption):
    """Returns the name."""
    lines = wrapped(caption, 7.5, figure.get_figwidth())
    figure.text(0.012, 0.07 / figure.get_figheight(), lines, fontsize=7.5, color=FAINT, va="bottom")
    partial = Path(folder) / f".{name}.partial.svg"
    figure.savefig(partial, dpi=130, metadata={"Date": None})
    partial.write_text(smaller(partial.read_text(encoding="utf-8")), encoding="utf-8")
    partial.replace(Path(folder) / f"{name}.svg")
    plt.close(figure)
    return name
