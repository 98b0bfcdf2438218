"""Speed and accuracy of methods: the front between the two, and the errors on each scene."""
import math

from tables import short

TRIALS = {"coverage": "edge crossings", "visibility": "covered pixels", "facing": "visible faces",
          "clipping": "covered pixels"}
SUBTITLES = {
    "coverage": "Further left: fewer errors; further down: faster. Errors are counted against the exact picture of the "
                "unsnapped positions. Filled: none given the snapped positions. All but naive use SIMD; the "
                "title is about one thread.",
    "visibility": "Further left: fewer errors; further down: faster. The visible triangle of a pixel is judged by exact "
                  "planes on the snapped positions. All methods share the same exact coverage.",
    "facing": "Further left: fewer errors; further down: faster. Front faces are judged by the exact sign of the projected "
              "area before any snapping. Filled: no misjudged face given the snapped positions.",
    "clipping": "Further left: fewer errors; further down: faster. Pixels are judged by rays that need no clipping; "
                "differences within 1/64 px of an edge do not count.",
}


def front_line(points, right, top):
    """A step line along the points (x, y) that no other beats in both coordinates, from the top edge to the right one."""
    best = []
    for x, y in sorted(points):
        if not best or y < best[-1][1]:
            best.append((x, y))
    line = [(best[0][0], top), best[0]]
    for x, y in best[1:]:
        line += [(x, line[-1][1]), (x, y)]
    return [*line, (right, line[-1][1])]


def cost_range(measured):
    """Both ends of the axis of costs."""
    costs = [cost for m in measured for c in m.costs.values() for cost in c.interval]
    return min(costs) / 1.3, max(costs) * 1.3


def unsettled(measured):
    """The methods for which noise leaves open whether another one beats them in both errors and speed."""
    found = []
    for m in measured:
        orders = {m.costs[1].order(other.costs[1]) for other in measured if other is not m and other.rate <= m.rate}
        if 0 in orders and 1 not in orders:
            found.append(m)
    return found


def cell_text(rate):
    return "0" if rate == 0 else "<1" if rate < 1 else short(float(f"{rate:.2g}"))


def shade(rate):
    """From 0 for no errors to 1."""
    return min(1.0, math.log10(1 + rate) / 6)


CRACKS = {"t_junction": "its gaps, in pixels", "t_junction_split": "its gaps once split"}


def chart_rows(scenes):
    """(label, text of each method, rate of each method) of each row. A T-junction has a second row with its gaps, since its
    rate does not show that splitting the edge closes the crack."""
    rows = []
    for scene in scenes:
        rates = {m.method.name: m.rate for m in scene.measured}
        rows.append((scene.name, {name: cell_text(rate) for name, rate in rates.items()}, rates))
        if scene.name in CRACKS and all(m.gaps is not None for m in scene.measured):
            gaps = {m.method.name: m.gaps for m in scene.measured}
            rows.append((CRACKS[scene.name], {name: short(count) for name, count in gaps.items()},
                         {m.method.name: 1e6 * m.gaps / scene.trials for m in scene.measured}))
    return rows
