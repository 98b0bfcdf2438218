"""The figures of the main chart: how often each coverage method cracks, and how fast it is in scalar code and with SIMD."""
import math
from typing import NamedTuple

from accuracy_rows import Pooled, pooled
from bench_rows import mean_gained
from bench_tables import GPU
from facts_tables import pooled_text

MAIN_CHART = "frontier"  # its file
LEAST_CROSSINGS = 10_000  # of shared edges; in smaller scenes a single crossing decides the rate


class CrackRates(NamedTuple):
    """Cracks per 10⁶ crossings of shared edges."""
    pooled: Pooled
    crossings: int

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
    found = [(m.cracks.at_shared_edges, scene.shared_crossings, scene.name) for scene in accuracy.of("coverage")
             if scene.shared_crossings >= LEAST_CROSSINGS and scene.in_range_of(method) and (m := scene.of(method.name)) and m.cracks]
    return CrackRates(pooled(found, 1e6), sum(crossings for _, crossings, _ in found)) if found else None


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


def speed_ups(accuracy):
    """({method: {"scalar": SpeedUp, "simd": SpeedUp}}, the reference, number of scenes)."""
    base, scenes = reference(accuracy), timed_scenes(accuracy)
    if base is None:
        return {}, None, 0
    groups = {}
    for scene in scenes:
        base_row = scene.of(base.name).scalar.row
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
    """({method: (its speed_ups(), CrackRates)}, the reference, number of scenes) of the methods with all figures. A GPU is not
    among them: its times are not those of one thread."""
    ups, base, scenes = speed_ups(accuracy)
    return ({method: (forms, cracks) for method, forms in ups.items()
             if forms and method.name != GPU and (cracks := cracks_of(accuracy, method)) and wrong_of(accuracy, method)}, base, scenes)


def said(up):
    return f"{up.middle:.2g}× ({up.low:.2g} to {up.high:.2g})"


def wrong_of(accuracy, method):
    """Pooled pixels per 10⁶ edge crossings that differ from the exact picture of the scene; None if not counted."""
    found = [(m.seen[0], scene.trials, scene.name) for scene in accuracy.pooled("coverage")
             for m in (*scene.measured, *scene.apart) if m.method == method and m.seen and scene.in_range_of(method)]
    return pooled(found, 1e6) if found else None


def points_of(found, accuracy, form):
    """{method: (wrong pixels per 10⁶ crossings, SpeedUp, whether no crack was seen)}"""
    return {method: (wrong_of(accuracy, method).rate, forms[form], cracks.rate == 0)
            for method, (forms, cracks) in found.items() if form in forms}


def frontier_table(accuracy):
    """Header and lines: watertight methods first, then the fastest first, with their speed-ups and intervals; without the engine with
    other numbers, which engine_table() shows."""
    found, base, _ = frontier_figures(accuracy)
    if not found:
        return [], []

    def title(method):
        return f"`{method.name}`" + (f", up to {method.limit_px:.0f} px" if method.limit_px else "")

    header = ["method", "cracks per 10⁶", "wrong pixels per 10⁶", f"scalar, `{base.name}` = 1×", "SIMD"]
    lines = [[title(method), pooled_text(cracks.pooled) if cracks.rate else "**0**", pooled_text(wrong_of(accuracy, method)),
              *(said(forms[form]) if form in forms else "–" for form in ("scalar", "simd"))]
             for method, (forms, cracks) in sorted(found.items(), key=lambda item: (item[1][1].rate > 0, -best(item[1][0]).middle)) if not method.engine]
    return header, lines
