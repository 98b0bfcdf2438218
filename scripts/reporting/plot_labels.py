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
        others = [other for j, other in placed.items() if j != i]
        leaders = [p for j in placed if j != i for p in along(points[j], end_of(points[j], placed[j]))]
        own = along(points[i], end_of(points[i], box))
        return (distance + 4000 * (1 - area_shared(bounds, box) / (box.width * box.height))
                + 300 * box.padded(5).count_contains(points)
                + 10 * (box.padded(1).count_contains(line_points) if line_points else 0)
                + sum(40 + 10 * area_shared(box.padded(2), other) for other in others if box.padded(2).overlaps(other))
                + 60 * sum(other.count_contains(own) for other in others)
                + 60 * (box.count_contains(leaders) if leaders else 0)
                + 40 * sum(math.dist(p, q) < 5 for p in (*points[:i], *points[i + 1:], *leaders) for q in own))

    crowded_first = sorted(range(len(points)), key=lambda i: (-sum(math.dist(points[i], p) < 60 for p in points), points[i]))
    for _ in range(4):  # later rounds see all other labels
        for i in crowded_first:
            least = math.inf
            for distance, box in candidates(points[i], *sizes[i]):
                if distance >= least:  # the nearest come first
                    break
                if (found := cost(i, distance, box)) < least:
                    least, best = found, box
            placed[i] = best
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
