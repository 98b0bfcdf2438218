"""Places a name beside every point of a dense chart, deterministically: off other labels and points, inside the axes."""
import math
from dataclasses import dataclass

from plot_style import FAINT, INK

DISTANCES = (9, 15, 23, 33, 45, 59, 75, 95, 120)
ANGLES = [math.radians(degrees) for degrees in (0, 20, -20, 45, -45, 180, 160, 200, 135, 225, 70, -70, 110, 250, 90, -90)]
MARGIN = 2.0  # points kept free around a label


@dataclass(frozen=True)
class Label:
    x: float  # of the point, as data
    y: float
    text: str
    colour: str = INK
    type_size: float = 9.5
    bold: bool = False


@dataclass(frozen=True)
class Box:
    left: float
    bottom: float
    right: float
    top: float

    def overlap(self, other):
        wide = min(self.right, other.right) - max(self.left, other.left)
        high = min(self.top, other.top) - max(self.bottom, other.bottom)
        return wide * high if wide > 0 and high > 0 else 0.0

    def holds(self, x, y, margin=0.0):
        return (self.left - margin < x < self.right + margin) and (self.bottom - margin < y < self.top + margin)


def along(start, end, step=4.0):
    count = max(1, int(math.dist(start, end) / step))
    return [(start[0] + i / count * (end[0] - start[0]), start[1] + i / count * (end[1] - start[1]))
            for i in range(count + 1)]


def candidates(at, size):
    """Boxes around a point with the end of the leader that would go there, the nearest first."""
    wide, high = size
    for distance in DISTANCES:
        for angle in ANGLES:
            x, y = at[0] + distance * math.cos(angle), at[1] + distance * math.sin(angle)
            side = math.cos(angle)
            left = x if side > 0.3 else x - wide if side < -0.3 else x - wide / 2
            bottom = y - high / 2 + (high / 2 * math.sin(angle))
            box = Box(left, bottom, left + wide, bottom + high)
            yield distance, box, (min(max(at[0], box.left), box.right), min(max(at[1], box.bottom), box.top))


def cost_of(distance, box, end, at, bounds, points, line_points, others):
    inside = bounds.overlap(box) / ((box.right - box.left) * (box.top - box.bottom))
    leader = along(at, end)
    grown = Box(box.left - MARGIN, box.bottom - MARGIN, box.right + MARGIN, box.top + MARGIN)
    return (distance + 4000 * (1 - inside)
            + 300 * sum(box.holds(x, y, 5) for x, y in points)
            + 10 * sum(box.holds(x, y, 1) for x, y in line_points)
            + sum(40 + 10 * grown.overlap(other) for other, _ in others if grown.overlap(other))
            + 60 * sum(other.holds(x, y, 1) for other, _ in others for x, y in leader)
            + 60 * sum(box.holds(x, y, 1) for _, other in others for x, y in other)
            + 40 * sum(math.dist(p, q) < 5 for p in points if p != at for q in leader))


def place(points, sizes, bounds, line_points, markers=()):
    """A (box, end of the leader) for each point, off the other points and markers; all in typographic points."""
    placed = [None] * len(points)
    neighbours = [sum(math.dist(p, q) < 60 for q in points) for p in points]
    order = sorted(range(len(points)), key=lambda i: (-neighbours[i], points[i]))
    for _ in range(4):  # later rounds see all other labels
        for i in order:
            others = [(box, along(points[j], end)) for j, spot in enumerate(placed) if spot and j != i
                      for box, end in [spot]]
            placed[i] = min(candidates(points[i], sizes[i]),
                            key=lambda c: cost_of(*c, points[i], bounds, [*points, *markers], line_points, others))[1:]
    return placed


def label_points(axes, labels, lines=()):
    """lines: lists of (x, y) that labels keep off; one of a single point is a marker. The axes must have their final place and limits."""
    figure = axes.figure
    scale = 72 / figure.dpi

    def in_points(x, y):
        return tuple(axes.transData.transform((x, y)) * scale)

    extent = axes.get_window_extent()
    bounds = Box(*(v * scale for v in (extent.x0, extent.y0, extent.x1, extent.y1)))
    renderer = figure.canvas.get_renderer()
    texts, sizes = [], []
    for label in labels:
        drawn = axes.annotate(label.text, (label.x, label.y), xytext=(0, 0), textcoords="offset points",
                              color=label.colour, ha="left", va="bottom", fontsize=label.type_size,
                              fontweight="bold" if label.bold else "normal", annotation_clip=False, zorder=5)
        box = drawn.get_window_extent(renderer)
        texts.append(drawn)
        sizes.append((box.width * scale, box.height * scale))
    points = [in_points(label.x, label.y) for label in labels]
    line_points = [p for line in lines for a, b in zip(line, line[1:]) for p in along(in_points(*a), in_points(*b), 6)]
    markers = [in_points(*line[0]) for line in lines if len(line) == 1]
    for text, at, (box, end) in zip(texts, points, place(points, sizes, bounds, line_points, markers)):
        text.set_position((box.left - at[0], box.bottom - at[1]))
        if math.dist(at, end) > 11:
            pull = 5 / math.dist(at, end)  # off the marker
            start = (at[0] + pull * (end[0] - at[0]), at[1] + pull * (end[1] - at[1]))
            ends = [axes.transData.inverted().transform((p[0] / scale, p[1] / scale)) for p in (start, end)]
            axes.plot(*zip(*ends), color=FAINT, linewidth=0.6, zorder=2.5, scalex=False, scaley=False)
