"""The figures of the main chart: how often each coverage method cracks, and how fast it is in scalar code and with SIMD."""
import math
from typing import NamedTuple

from accuracy_rows import Pooled, pooled
from bench_rows import mean_gained
from tables import by_order, number, short

LEAST_CROSSINGS = 10_000  # of shared edges; in smaller scenes a single crossing decides the rate
# The tutorials' inside tests; and one engine with exact edges and with the first test's float edges.
INSIDE_TESTS = ("float_lt", "float_le")
ENGINES = ("engine_exact", "engine_float")


class CrackRates(NamedTuple):
    """Cracks per 10⁶ crossings of shared edges."""
    pooled: Pooled
    worst: float  # of one scene
    worst_scene: str
    crossings: int
    scenes: int
    t_junctions: int  # samples, in all scenes within the method's range
    folds: int

    @property
    def rate(self):
        return self.pooled.rate


class SpeedUp(NamedTuple):
    """Over the reference, the geometric mean of the scenes, with its interval."""
    middle: float
    low: float
    high: float


def cracks_of(accuracy, method):
    """None if no scene shows it."""
    measured = [(m.cracks, scene) for scene in accuracy.of("coverage") for m in (*scene.measured, *scene.apart)
                if m.method == method and m.cracks and scene.in_range_of(method)]
    found = [(cracks.at_shared_edges, scene) for cracks, scene in measured if scene.shared_crossings >= LEAST_CROSSINGS]
    if not found:
        return None
    crossings = sum(scene.shared_crossings for _, scene in found)
    worst, worst_scene = max(((1e6 * cracks / scene.shared_crossings, scene.name) for cracks, scene in found),
                             key=lambda pair: pair[0])
    rate = pooled([(cracks, scene.shared_crossings, scene.name) for cracks, scene in found], 1e6)
    return CrackRates(rate, worst, worst_scene, crossings, len(found), *(sum(getattr(cracks, count) for cracks, _ in measured)
                                                                         for count in ("t_junctions", "folds")))


def timed_scenes(accuracy):
    return [scene for scene in accuracy.of("coverage") if any(m.scalar for m in scene.measured)]


def reference(accuracy):
    """The fastest method of others in scalar code: the one with the smallest product of its medians in all timed scenes."""
    scenes = timed_scenes(accuracy)
    products = {}
    for method in accuracy.methods.get("coverage", ()):
        times = [m.scalar.ns for scene in scenes for m in scene.measured if m.method == method and m.scalar]
        if times and len(times) == len(scenes) and not method.ours:
            products[method] = math.prod(times)
    return min(products, key=products.get) if products else None


def measured_in(scene, name):
    return next((m for m in (*scene.measured, *scene.apart) if m.method.name == name), None)


def simd_outcome(accuracy, name, other):
    """Of one method against another, both with SIMD on one thread: by_order() of the scenes; None if a scene lacks one of them, or
    none is timed."""
    compared = [[m and m.simd for m in (measured_in(scene, name), measured_in(scene, other))] for scene in timed_scenes(accuracy)]
    return by_order((a.row, b.row) for a, b in compared) if compared and all(map(all, compared)) else None


def speed_ups(accuracy):
    """({method: {"scalar": SpeedUp, "simd": SpeedUp}}, the reference, number of scenes)."""
    base, scenes = reference(accuracy), timed_scenes(accuracy)
    if base is None:
        return {}, None, 0
    groups = {}
    for scene in scenes:
        base_row = measured_in(scene, base.name).scalar.row
        for m in (*scene.measured, *scene.apart):
            # A peer has one form, with vectors of its own.
            peer = (("scalar" if m.method.source.endswith("scalar") else "simd", m.scalar),)
            for form, cost in peer if m.method.peer else (("scalar", m.scalar), ("simd", m.simd)):
                if cost:
                    groups.setdefault(m.method, {}).setdefault(form, []).append((base_row, cost.row))
    return ({method: {form: SpeedUp(*mean_gained(of)) for form, of in forms.items() if len(of) == len(scenes)}
             for method, forms in groups.items()}, base, len(scenes))


def best(forms):
    """The faster form of a method."""
    return max(forms.values(), key=lambda up: up.middle)


def frontier_figures(accuracy):
    """({method: (its speed_ups(), CrackRates)}, the reference, number of scenes) of the methods with both figures."""
    ups, base, scenes = speed_ups(accuracy)
    return ({method: (forms, cracks) for method, forms in ups.items() if forms and (cracks := cracks_of(accuracy, method))},
            base, scenes)


def frontier_table(accuracy):
    """Header and lines: every method's cracks and its two speed-ups with their intervals, the fastest first."""
    found, base, _ = frontier_figures(accuracy)
    if not found:
        return [], []

    def said(up):
        return f"{up.middle:.2g}× ({up.low:.2g} to {up.high:.2g})"

    def title(method):
        return f"`{method.name}`" + (f", up to {method.limit_px:.0f} px" if method.limit_px else "")

    def form(forms, name, otherwise):
        return said(forms[name]) if name in forms else otherwise

    header = ["method", "cracks per 10⁶ crossings", "without the scene of most", "worst scene", "crossings", "at T-junctions", "folds",
              f"scalar, `{base.name}` = 1×", "SIMD"]
    lines = [[title(method), number(cracks.rate, 2),
              f"{number(cracks.pooled.without, 2)} (`{cracks.pooled.mostly_on}`)" if cracks.pooled.mostly_on else "–",
              f"{number(cracks.worst, 2)} (`{cracks.worst_scene}`)" if cracks.worst else "–",
              short(cracks.crossings), f"{cracks.t_junctions:,}", f"{cracks.folds:,}", form(forms, "scalar", "–"),
              form(forms, "simd", "–" if method.peer else method.simd_note or "–")]
             for method, (forms, cracks) in sorted(found.items(), key=lambda item: -best(item[1][0]).middle)]
    return header, lines
