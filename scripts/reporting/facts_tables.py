"""The tables of facts: what a viewer sees of methods, pixels that are not portable, and what scenes need."""
from accuracy_rows import MESHES, OUR_GRID, SCALAR, SIMD
from bench_rows import facts_of
from program import parsed
from tables import gain, milliseconds, number

TIMED_SCENE = "torus-knot"  # whose times and flicker stand beside the pixels


def methods_table(accuracy):
    """Header and lines: the pixels of each coverage method that a viewer sees to be wrong, still and in motion, and the milliseconds on one
    thread, in scalar code and with SIMD, without the front end. Scenes on our grid stand apart."""
    scenes, flicker, lines = accuracy.of("coverage"), accuracy.flicker.get(TIMED_SCENE, {}), []
    timed = next((scene for scene in scenes if scene.name == TIMED_SCENE), None)
    for method in accuracy.methods["coverage"]:
        seen = [(scene.kind, scene.of(method.name)) for scene in scenes if scene.of(method.name) and scene.in_range_of(method)]

        def total(of, what):
            return f"{sum(getattr(measured, what) for kind, measured in seen if kind == of):,}"

        times = timed and timed.of(method.name)
        lines.append([f"`{method.name}`", total(MESHES, "wrong"), total(MESHES, "through"), total(OUR_GRID, "wrong"),
                      number(flicker[method.name]) if method.name in flicker else "–",
                      " / ".join(milliseconds(times.forms.get(form)) for form in (SCALAR, SIMD)) if times else "–"])
    return ["method", "wrong pixels of meshes", "showing through", "wrong pixels on our grid", "flicker", "ms, scalar / SIMD"], lines


# Pixels that conformant rasterizers may draw differently.
SHOWN_BITS = (8, 6, 4)


def parse_portable(data):
    """{subpixel bits: {scene: entry}}"""
    found = {}
    for entry in data:
        found.setdefault(int(entry["subpixel_bits"]), {})[entry["scene"]] = entry
    return found


def read_portable(folder):
    """Empty if not measured."""
    path = facts_of(folder) / "portable.json"
    return parsed(path, parse_portable, "edgewise portable") if path.exists() else {}


def portable_table(found):
    """Header and lines, a line per scene."""
    shown = [found[bits] for bits in SHOWN_BITS if bits in found]
    return (["scene", *(f"{bits} bits, %" for bits in SHOWN_BITS if bits in found)],
            [[scene, *(number(100 * of[scene]["unstable"] / of[scene]["pixels"], 2) for of in shown)] for scene in (shown[0] if shown else ())])


# What scenes need.
PLANES = ("near plane", "far plane", "guard band")
FACING, VISIBILITY, DEPTH, BITS = "facing test", "visibility", "depth buffer", "subpixel bits"
# Depth formats, as levels.
FORMATS = {"D16": "16 bits", "D24": "24 bits", "D32F": "float_z", "reversed D32F": "reversed_z", "ours": "contract31"}
VISIBILITIES = ("submission_order", "painter_mean", "painter_farthest", "depth buffer")  # the cheapest first
METHODS = ("submission_order", "painter_", "float_", "reversed_z", "contract31", "normal_", "snapped_area", "double_")


def parse_needs(data):
    """{scene: (entry, {depth format: its entry})}"""
    found = {}
    for entry in data:
        [depth] = (curve["levels"] for curve in entry["curves"] if curve["stage"] == DEPTH)
        found[entry["scene"]] = entry, {level["level"]: level for level in depth}
    return found


def read_needs(folder):
    """Empty if not measured."""
    path = facts_of(folder) / "needs.json"
    return parsed(path, parse_needs, "edgewise needs") if path.exists() else {}


def titled(answer):
    return f"`{answer}`" if answer.startswith(METHODS) else answer


def clipping(levels):
    needed = [f"{levels[plane]} at the {plane}" for plane in PLANES if levels.get(plane, "nothing") != "nothing"]
    return ", ".join(needed) or ("nothing" if PLANES[0] in levels else "–")


def pipelines_table(found, bench):
    """Header and lines: of each scene the least precise pipeline; of several the fastest or, where they were not timed, the one of the
    cheapest visibility."""
    lines = []
    for scene, (entry, _) in found.items():
        exact, *rows = (bench.find(f"needs/{scene}/pipeline:{which}/threads:1") for which in ("exact", *range(1, len(entry["minima"]) + 1)))
        if rows:
            row, levels = min(zip(rows, entry["minima"]), key=lambda one: (one[0].median_ms if one[0] else float("inf"),
                                                                           VISIBILITIES.index(one[1][VISIBILITY])))
            said = gain(exact, row) if exact and row else "–"
        else:
            levels, said = entry["closest"]["levels"], f"not right: {entry['closest']['worst_px']:,} wrong px in a frame"
        lines.append([scene, clipping(levels), *(titled(levels.get(stage, "–")) for stage in (FACING, VISIBILITY, DEPTH)), levels[BITS].split()[0], said])
    return ["scene", "clipping", FACING, VISIBILITY, "depth", BITS, "speed-up over exact"], lines


def depth_table(found):
    """Header and lines: the formats that are enough for the near and far plane of scenes, all else ours. Scenes of the same answers share
    a line."""
    def cell(level):
        return "enough" if level["enough"] else f"{level['worst_px']:,} wrong px"

    lines = {}
    for scene, (entry, depth) in found.items():
        figures = (*(f"{entry[key]:.4g}" if key in entry else "–" for key in ("near_z", "far_z")), *(cell(depth[level]) for level in FORMATS.values()))
        lines.setdefault(figures, []).append(scene)
    return ["scene", "near", "far", *FORMATS], [[", ".join(names), *figures] for figures, names in lines.items()]
