"""Places a name beside every point of a chart, deterministically: off other names, points and lines, inside the axes. All in pixels."""
import math

import numpy as np
from matplotlib.text import Text
from matplotlib.transforms import Bbox

DISTANCES = (9, 15, 23, 33, 45, 59, 75)  # from the point
ANGLES = np.radians([0, 20, -20, 45, -45, 180, 160, 200, 135, 225, 70, -70, 110, 250, 90, -90])
NEAR = 11  # no leader


def candidates(at, size):
    """(distance, box) around a point, the nearest first."""
    for distance in DISTANCES:
        for across, up in zip(np.cos(ANGLES), np.sin(ANGLES)):
            left = at[0] + distance * across - size[0] * (0 if across > 0.3 else 1 if across < -0.3 else 0.5)
            yield distance, Bbox.from_bounds(left, at[1] + distance * up + (up - 1) * size[1] / 2, *size)


def along(start, end):
    return np.linspace(start, end, 2 + int(math.dist(start, end) / 6))


def area_shared(box, other):
    shared = Bbox.intersection(box, other)
    return shared.width * shared.height if shared else 0.0


def place(points, sizes, bounds, lines):
    """A box for each point. `lines`: points along them."""
    boxes, crossed = [], np.array([*points, *lines])

    def cost(i, distance, box):
        room, ends = box.padded(2), np.clip(points, box.min, box.max)  # where leaders from the points would meet the box
        away = np.hypot(*(ends - points).T)  # a label should be nearest to its own point
        return (distance + 80 * (min(away) < away[i]) + 40 * room.count_contains(crossed) + 9 * (box.width * box.height - area_shared(bounds, box))
                + sum(10 * area_shared(room, other) + 60 * other.count_contains(along(points[i], ends[i])) for other in boxes))

    for i, (at, size) in enumerate(zip(points, sizes)):
        boxes.append(min(candidates(at, size), key=lambda found: cost(i, *found))[1])
    return boxes


def joined(texts):
    """Annotations of one colour whose points lie on one another become one."""
    kept = []
    for text in texts:
        at, *places = text.axes.transData.transform([text.xy, *(other.xy for other in kept)])
        near = [other for other, there in zip(kept, places) if math.dist(at, there) < 4 and other.get_color() == text.get_color()]
        if near:
            near[0].set_text(f"{near[0].get_text()}\n{text.get_text()}")
            text.remove()
        else:
            kept.append(text)
    return kept


def place_labels(texts):
    """Moves annotations, off the lines of their axes, which must have their final place and limits."""
    axes, texts = texts[0].axes, joined(texts)
    renderer = axes.figure.canvas.get_renderer()
    points = axes.transData.transform([text.xy for text in texts])
    sizes = [Text.get_window_extent(text, renderer).size for text in texts]
    lines = [axes.transData.transform(line.get_xydata()) for line in axes.lines]
    crossed = [p for line in lines for ends in zip(line, line[1:]) for p in along(*ends)]
    for text, at, box in zip(texts, points, place(points, sizes, axes.bbox, crossed)):
        text.set_position(box.min - at)
        text.arrow_patch.set_visible(math.dist(at, np.clip(at, box.min, box.max)) > NEAR)
