"""Where methods stand between speed and accuracy, and what each scene says of them."""
import math

from tables import short

TRIALS = {"coverage": "edge crossings", "visibility": "covered pixels", "facing": "faces that own a pixel",
          "clipping": "covered pixels"}
SUBTITLES = {
    "coverage": "Further left: fewer errors; further down: faster. Judged by exact arithmetic on the positions before "
                "any snapping, which costs those who\nsnap something wherever vertices lie off their grid. Filled: no "
                "pixel is wrong given the snapped positions. Ours use the widest SIMD.",
    "visibility": "Further left: fewer errors; further down: faster. Who owns a pixel, judged by exact planes on the "
                  "snapped positions; all draw\nwith the same exact coverage of these.",
    "facing": "Further left: fewer errors; further down: faster. Which faces look at the eye, judged by the exact sign of "
              "the projected area\nbefore any snapping. Filled: no face is misjudged given the snapped positions.",
    "clipping": "Further left: fewer errors; further down: faster. Judged by rays that need no clipping; differences "
                "within 1/64 px of an edge do not count.",
}


def front_line(points, right, top):
    """A step line along the points that no other beats in both coordinates, from the top edge to the right one.
    points: (x, y, x where it is drawn)."""
    best = []
    for x, y, drawn_x in sorted(points):
        if not best or y < best[-1][1]:
            best.append((drawn_x, y))
    line = [(best[0][0], top), best[0]]
    for x, y in best[1:]:
        line += [(x, line[-1][1]), (x, y)]
    return [*line, (right, line[-1][1])]


def cost_range(measured):
    """Both ends of the axis of costs."""
    costs = [cost for m in measured for c in m.costs.values() for cost in (c.low, c.high)]
    return min(costs) / 1.3, max(costs) * 1.3


def side_by_side(measured, scale):
    """Where each method stands: those whose whiskers would hide one another step aside."""
    places = [scale.at(m.rate) for m in measured]
    step = 0.011 * (scale.limit - scale.start)
    reach = [(min(c.low for c in m.costs.values()), max(c.high for c in m.costs.values())) for m in measured]
    for x in sorted(set(places)):
        lanes = []  # of methods, none of whose whiskers meet
        for i in [i for i, place in enumerate(places) if place == x]:
            free = next((lane for lane in lanes
                         if all(reach[i][1] < reach[j][0] or reach[j][1] < reach[i][0] for j in lane)), None)
            lanes.append([i]) if free is None else free.append(i)
        for k, lane in enumerate(lanes):
            for i in lane:
                places[i] = x + (k - (len(lanes) - 1) / 2) * step
    return places


def unsettled(measured):
    """Those of which the spread does not tell whether some other beats them in both errors and speed."""
    found = []
    for m in measured:
        rivals = [other.costs[1] for other in measured if other is not m and other.rate <= m.rate]
        beaten = any(rival.high < m.costs[1].low for rival in rivals)
        if not beaten and any(rival.overlaps(m.costs[1]) for rival in rivals):
            found.append(m)
    return found


def cell_text(rate):
    return "0" if rate == 0 else "<1" if rate < 1 else short(float(f"{rate:.2g}"))


def shade(rate):
    """From 0 for no errors to 1."""
    return min(1.0, math.log10(1 + rate) / 6)


CRACKS = {"t_junction": "its gaps, in pixels", "t_junction_split": "its gaps once split"}


def chart_rows(scenes):
    """(label, what stands there, how dark) of each row, the last two by method. A T-junction's rate says how many
    pixels change hands; that splitting its edge closes the crack, only its gaps say."""
    rows = []
    for scene in scenes:
        rates = {m.method.name: m.rate for m in scene.measured}
        rows.append((scene.name, {name: cell_text(rate) for name, rate in rates.items()}, rates))
        if scene.name in CRACKS and all(m.gaps is not None for m in scene.measured):
            gaps = {m.method.name: m.gaps for m in scene.measured}
            rows.append((CRACKS[scene.name], {name: short(count) for name, count in gaps.items()},
                         {m.method.name: 1e6 * m.gaps / scene.trials for m in scene.measured}))
    return rows
