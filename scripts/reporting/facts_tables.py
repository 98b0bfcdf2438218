"""The tables of facts: what a viewer sees of methods, pixels that are not portable, and what scenes need."""
from accuracy_rows import MESHES, OUR_GRID, read_facts
from tables import gain, milliseconds, number

TIMED_SCENE = "torus-knot"  # whose times and flicker stand beside the pixels


def methods_table(accuracy, bench):
    """Header and lines: the pixels of each coverage method that a viewer sees to be wrong, still and in motion, and the milliseconds on one
    thread, in scalar code and with SIMD, without the front end. Scenes on our grid stand apart."""
    flicker, lines = accuracy.flicker.get(TIMED_SCENE, {}), []
    for method in accuracy.methods["coverage"]:
        # Beyond its range a method's integers overflow, which is another fault than the one that is counted.
        seen = [(scene.kind, *scene.pixels[method.name]) for scene in accuracy.scenes["coverage"]
                if scene.largest_side_px <= method.max_side_px]
        totals = (sum(wrong for kind, wrong, _ in seen if kind == MESHES), sum(through for kind, _, through in seen if kind == MESHES),
                  sum(wrong for kind, wrong, _ in seen if kind == OUR_GRID))
        times = [bench.find(f"lab/{TIMED_SCENE}/family:coverage/method:{method.name}/simd:{target}/threads:1")
                 for target in ("scalar", bench.context["simd_target"])]
        lines.append([f"`{method.name}`", *(f"{total:,}" for total in totals), number(flicker[method.name]) if method.name in flicker else "–",
                      " / ".join(map(milliseconds, times))])
    return ["method", "wrong pixels of meshes", "showing through", "wrong pixels on our grid", "flicker", "ms, scalar / SIMD"], lines


SHOWN_BITS = (8, 6, 4)  # of the pixels that conformant rasterizers may draw differently


def read_portable(folder):
    """{(subpixel bits, scene): the share of its pixels}"""
    return read_facts(folder, "portable", lambda data: {(int(of["subpixel_bits"]), of["scene"]): of["unstable"] / of["pixels"] for of in data})


def portable_table(found):
    """Header and lines, a line per scene."""
    return (["scene", *(f"{bits} bits, %" for bits in SHOWN_BITS)],
            [[scene, *(number(100 * found[bits, scene], 2) for bits in SHOWN_BITS)] for scene in dict.fromkeys(scene for _, scene in found)])


# What scenes need.
PLANES = ("near plane", "far plane", "guard band")
FACING, VISIBILITY, DEPTH, BITS = "facing test", "visibility", "depth buffer", "subpixel bits"
# Depth formats, as levels.
FORMATS = {"D16": "16 bits", "D24": "24 bits", "D32F": "float_z", "reversed D32F": "reversed_z", "ours": "contract31"}
VISIBILITIES = ("submission_order", "painter_mean", "painter_farthest", "depth buffer")  # the cheapest first


def read_needs(folder):
    """{scene: (entry, {depth format: its entry})}"""
    return read_facts(folder, "needs", lambda data: {
        entry["scene"]: (entry, {level["level"]: level for curve in entry["curves"] if curve["stage"] == DEPTH for level in curve["levels"]})
        for entry in data})


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
        answers = (levels.get(stage, "–") for stage in (FACING, VISIBILITY, DEPTH))
        titles = (f"`{answer}`" if answer.isidentifier() else answer for answer in answers)  # methods as code, unlike "15 bits"
        lines.append([scene, clipping(levels), *titles, levels[BITS].split()[0], said])
    return ["scene", "clipping", FACING, VISIBILITY, "depth", BITS, "speed-up over exact"], lines


def depth_table(found):
    """Header and lines: the formats that are enough for the near and far plane of scenes, all else ours. Scenes of the same answers share
    a line."""
    lines = {}
    for scene, (entry, depth) in found.items():
        levels = [depth[level] for level in FORMATS.values()]
        figures = (*(f"{entry[key]:.4g}" if key in entry else "–" for key in ("near_z", "far_z")),
                   *("enough" if level["enough"] else f"{level['worst_px']:,} wrong px" for level in levels))
        lines.setdefault(figures, []).append(scene)
    return ["scene", "near", "far", *FORMATS], [[", ".join(names), *figures] for figures, names in lines.items()]
