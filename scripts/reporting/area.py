"""Curves over a benchmark's sweeps, their crossings, and the fastest backend at each point."""
import math

from bench_rows import order


def curves(bench, key, threads, x_of, scale_of=lambda row: 1.0):
    """Per backend the points (x, row, scale) by growing x; times are to be multiplied by scale."""
    points = {backend: [] for backend in bench.backends}
    for row in bench.sweep(key):
        if row.threads == threads and row.backend in points and not row.frontend:
            points[row.backend].append((x_of(row), row, scale_of(row)))
    return {backend: sorted(found, key=lambda point: point[0]) for backend, found in points.items() if found}


def area_curves(bench, threads):
    """ns per covered pixel along the triangles' area."""
    return curves(bench, "area", threads, lambda row: float(row.keys["area"]),
                  lambda row: 1e6 / row.counters["covered_px"])


def crossings(first, second):
    """The settled crossings of two curves over the same x, by straight lines on log axes.

    Left and right of a crossing the repetitions must settle the order of the two, the other way round.
    """
    by_x = {x: row for x, row, _ in second}
    decided = None  # (side, index of the point) that was last clear of noise
    shared = [(x, row, by_x[x], scale) for x, row, scale in first if x in by_x]
    logs = [(math.log(x), math.log(a.median_ms * scale), math.log(b.median_ms * scale)) for x, a, b, scale in shared]
    for index, (_, a, b, _) in enumerate(shared):
        side = order(a, b)
        if side and decided and side != decided[0]:
            for (x0, a0, b0), (x1, a1, b1) in reversed(list(zip(logs[decided[1]:index], logs[decided[1] + 1:index + 1]))):
                before, after = a0 - b0, a1 - b1
                if before * after < 0:
                    t = before / (before - after)
                    yield math.exp(x0 + t * (x1 - x0)), math.exp(a0 + t * (a1 - a0))
                    break
        if side:
            decided = side, index


def all_crossings(points):
    """(x, y, backend, other backend) of each, by growing x; `points` as of curves()."""
    names = list(points)
    return sorted((x, y, a, b) for i, a in enumerate(names) for b in names[i + 1:]
                  for x, y in crossings(points[a], points[b]))


def wins(points, backend):
    """(at how many x the backend is settled as the fastest, number of x that all drew); `points` as of curves()."""
    own, *others = ({x: row for x, row, _ in points[name]} for name in sorted(points, key=lambda name: name != backend))
    shared = [x for x in own if all(x in rows for rows in others)]
    return sum(all(order(own[x], rows[x]) < 0 for rows in others) for x in shared), len(shared)


def two_digits(px):
    return f"{float(f'{px:.2g}'):,.{0 if px >= 10 else 1}f}"
