"""Places a name beside every point of a chart, deterministically: off other names, points and bars, inside the axes."""
import math
from dataclasses import dataclass

from matplotlib.text import Text
from matplotlib.transforms import Bbox

from plot_style import FAINT, INK

DISTANCES = (9, 15, 23, 33, 45, 59, 75)  # from the point, in typographic points
ANGLES = [math.radians(degrees) for degrees in (0, 20, -20, 45, -45, 180, 160, 200, 135, 225, 70, -70, 110, 250, 90, -90)]
NEAR = 11  # no leader


@dataclass(frozen=True)
class Label:
    x: float  # of the point, as data
    y: float
    text: str
    colour: str = INK
    bold: bool = False


def candidates(at, width, height):
    """(distance, box) around a point, the nearest first."""
    for distance in DISTANCES:
        for angle in ANGLES:
            across, up = math.cos(angle), math.sin(angle)
            left = at[0] + distance * across - width * (0 if across > 0.3 else 1 if across < -0.3 else 0.5)
            yield distance, Bbox.from_bounds(left, at[1] + distance * up + (up - 1) * height / 2, width, height)


def end_of(at, box):
    """Where a leader from the point meets the box."""
    return tuple(min(max(value, low), high) for value, low, high in zip(at, box.min, box.max))


def along(start, end, step=6.0):
    parts = max(1, int(math.dist(start, end) / step))
    return [tuple(a + i / parts * (b - a) for a, b in zip(start, end)) for i in range(parts + 1)]


def area_shared(box, other):
    shared = Bbox.intersection(box, other)
    return shared.width * shared.height if shared else 0.0


def place(points, sizes, bounds, line_points):
    """A box for each point; all in typographic points."""
    placed = {}

    def cost(i, distance, box):
        crossed = [*points, *line_points, *(p for j in placed for p in along(points[j], end_of(points[j], placed[j])))]
        leader = along(points[i], end_of(points[i], box))
        away = [math.dist(p, end_of(p, box)) for p in points]  # a label should be nearest to its own point
        return (distance + 80 * (min(away) < away[i]) + 9 * (box.width * box.height - area_shared(bounds, box)) + 40 * box.padded(2).count_contains(crossed)
                + sum(40 + 10 * area_shared(box.padded(2), other) + 60 * other.count_contains(leader) for other in placed.values()
                      if box.padded(2).overlaps(other) or other.count_contains(leader)))

    for i in sorted(range(len(points)), key=lambda i: -sum(math.dist(points[i], p) < 60 for p in points)):  # crowded ones first
        placed[i] = min(candidates(points[i], *sizes[i]), key=lambda found: cost(i, *found))[1]
    return [placed[i] for i in range(len(points))]


def label_points(axes, labels, lines=()):
    """lines: lists of (x, y) that labels keep off. The axes must have their final place and limits."""
    scale = 72 / axes.figure.dpi

    def in_points(x, y):
        return tuple(axes.transData.transform((x, y)) * scale)

    renderer = axes.figure.canvas.get_renderer()
    texts = [axes.annotate(label.text, (label.x, label.y), xytext=(0, 0), textcoords="offset points", color=label.colour, ha="left", va="bottom",
                           fontsize=9.5, fontweight="bold" if label.bold else "normal", zorder=5,
                           arrowprops={"arrowstyle": "-", "color": FAINT, "linewidth": 0.6, "shrinkA": 0, "shrinkB": 5}) for label in labels]
    sizes = [Text.get_window_extent(text, renderer).size * scale for text in texts]
    points = [in_points(label.x, label.y) for label in labels]
    line_points = [p for line in lines for a, b in zip(line, line[1:]) for p in along(in_points(*a), in_points(*b))]
    bounds = Bbox(axes.get_window_extent().get_points() * scale)
    for text, at, box in zip(texts, points, place(points, sizes, bounds, line_points)):
        text.set_position(box.min - at)
        if math.dist(at, end_of(at, box)) <= NEAR:
            text.arrow_patch.set_visible(False)
