"""The common look of all charts: light, colour-blind safe, one meaning for a colour, the same bytes for the same data."""
import io
import re
import textwrap

import matplotlib.pyplot as plt

from program import write_bytes

# Okabe and Ito, "Color Universal Design", 2008.
BLUE, ORANGE, GREEN = "#0072B2", "#E69F00", "#009E73"
INK, FAINT = "#24292f", "#6e7781"
BAND = "#f0f2f4"  # behind a special part of an axis
WIDTH_IN = 10.0  # of every chart, unless it says otherwise

plt.rcParams.update({
    "backend": "Agg", "figure.dpi": 72, "figure.constrained_layout.use": True,
    "font.family": "DejaVu Sans", "font.size": 10.5, "text.color": INK, "axes.labelcolor": INK,
    "axes.edgecolor": "#afb8c1", "axes.spines.top": False, "axes.spines.right": False,
    "axes.titlesize": 11, "axes.titlelocation": "left", "axes.axisbelow": True,
    "xtick.color": FAINT, "ytick.color": FAINT, "xtick.labelcolor": INK, "ytick.labelcolor": INK,
    "axes.grid": True, "grid.color": "#e6e9ec",
    "lines.linewidth": 2.0, "lines.markersize": 5.0, "svg.hashsalt": "edgewise",
})


def wrapped(text, type_size, width_in=WIDTH_IN):
    return "\n".join(textwrap.fill(line, int(128 * width_in / type_size)) for line in text.split("\n"))


def chart(title, subtitle, caption, content_in, shape=(1, 1), width_in=WIDTH_IN, **settings):
    """A figure with its texts, and between them a grid of axes, with their labels `content_in` high. A long title is set in smaller type."""
    subtitle, caption = wrapped(subtitle, 10, width_in), wrapped(caption, 7.5, width_in)
    above, below = 0.6 + 0.2 * subtitle.count("\n"), 0.25 + 0.13 * caption.count("\n")
    height = above + content_in + below
    figure, grid = plt.subplots(*shape, squeeze=False, figsize=(width_in, height), **settings)
    figure.get_layout_engine().set(rect=(0.005, below / height, 0.99, content_in / height))
    figure.text(0.012, 1 - 0.12 / height, title, fontsize=min(14, 108 * width_in / len(title)), fontweight="bold", va="top", gid="title")
    figure.text(0.012, 1 - 0.43 / height, subtitle, fontsize=10, color=FAINT, va="top")
    figure.text(0.012, 0.07 / height, caption, fontsize=7.5, color=FAINT, va="bottom")
    return figure, grid


def smaller(svg):
    """The same drawing in two thirds of the bytes: lengths with two digits after the point, which are hundredths of a pixel."""
    svg = re.sub(r"(scale\([^)]*\))|\d+\.\d{3,}", lambda found: found[1] or f"{float(found[0]):.2f}".rstrip("0").rstrip("."), svg)
    return re.sub(r"([A-Z]) (?=[-\d])", r"\1", re.sub(r"\s*\n\s*", "\n", svg)).replace("DejaVuSans", "d")


def save(figure, folder, name):
    """Returns the name."""
    svg = io.StringIO()
    figure.savefig(svg, format="svg", metadata={"Date": None})
    plt.close(figure)
    write_bytes(folder / f"{name}.svg", smaller(svg.getvalue()).encode())
    return name
