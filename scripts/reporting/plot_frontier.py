"""The main chart: cracks against speed, each coverage method in scalar code and with SIMD."""
from accuracy_rows import FAMILIES
from frontier import ENGINES, INSIDE_TESTS, LEAST_CROSSINGS, best, frontier_figures, simd_outcome, timed_scenes
from plot_labels import Label, label_points, shared_labels
from plot_style import FAINT, GREEN, INK, WHISKER, WIDTH_IN, Kinds, ZeroAxis, head_in, headline, plt, round_ticks, save
from tables import kernels, number, short

NEAR = 1.15  # ratio of speeds below which points at one x share a label
# Others with a label beside ours, the peers, and the title's: those that README names, and the fastest of each kind.
LABELLED = (*INSIDE_TESTS, *ENGINES, "dda_16_16", "dda_rounded", "fixed_8", "float_top_left")
WORST = {"linewidth": 0.9, "linestyle": (0, (1.5, 1.5))}


def leaders(found):
    """Our fastest and the fastest other method with SIMD; None if either is missing."""
    simd = {method: ups["simd"].middle for method, (ups, _) in found.items() if "simd" in ups and not method.apart}
    ours, others = ([m for m in simd if m.ours == whose] for whose in (True, False))
    return (max(ours, key=simd.get), max(others, key=simd.get)) if ours and others else None


def frontier_title(found, accuracy):
    """Scene by scene, both with SIMD."""
    if not (pair := leaders(found)):
        return "Coverage: cracks against speed"
    first, other = pair
    outcome = simd_outcome(accuracy, first.name, other.name)
    return (f"{first.name}: {number(found[first][1].rate, 2)} cracks per 10⁶; beats {other.name} in {len(outcome[-1])} of "
            f"{sum(map(len, outcome.values()))} scenes")


def called(method):
    """Of a peer with its vector width: "llvmpipe, 256 bits"."""
    width = method.source.rpartition(", ")[2] if method.peer else ""
    return f"{method.name}, {width}" if width.endswith("bits") else method.name


def labels_of(found, x_of):
    """Ours by themselves; named others that lie close together at one x share a label, by the faster form."""
    named = {*LABELLED, *(method.name for method in leaders(found) or ())}
    places = {method: (x_of(cracks.rate), best(ups).middle) for method, (ups, cracks) in found.items()}
    return [*(Label(*place, method.name, bold=True) for method, place in places.items() if method.ours),
            *shared_labels([(*place, called(method)) for method, place in places.items()
                            if not method.ours and (method.peer or method.name in named)], NEAR)]


def without_dominant(found):
    """For each scene that has over half of the cracks of some methods, a sentence with their rates without it."""
    scenes = {}
    for method, (_, cracks) in found.items():
        if cracks.pooled.mostly_on and method.name in LABELLED:
            scenes.setdefault(cracks.pooled.mostly_on, []).append(f"{method.name} {number(cracks.pooled.without, 2)}")
    return " ".join(f"Over half on {scene}; without it: {', '.join(rates)}." for scene, rates in scenes.items())


def frontier(accuracy, bench, folder, caption):
    found, base, scenes = frontier_figures(accuracy) if accuracy else ({}, None, 0)
    if not found:
        return None
    kinds = Kinds(FAMILIES["coverage"])
    scale = ZeroAxis([rate for _, cracks in found.values() for rate in (cracks.rate, cracks.worst)], band=0.4)
    most = max(found.values(), key=lambda item: item[1].crossings)[1]
    subtitle = (f"Further left: fewer cracks; further up: faster on one thread, geometric mean of {scenes} scenes "
                f"({', '.join(scene.name for scene in timed_scenes(accuracy))}). A crack is a sample at an edge that two triangles share, "
                f"which neither draws, or both; {most.scenes} scenes and {short(most.crossings)} crossings of shared edges pooled; "
                f"the dotted line ends at the worst scene. Hollow: scalar code; filled: {kernels(bench.context.get('simd_target'))}, of peers their own vectors.")
    above, below = 0.95 + head_in(subtitle), 1.0
    figure, axes = plt.subplots(figsize=(WIDTH_IN, above + below + 5.0))
    height = figure.get_figheight()
    top = headline(figure, frontier_title(found, accuracy), subtitle)
    figure.subplots_adjust(left=0.085, right=0.985, bottom=below / height, top=1 - above / height)
    scale.apply_x(axes, "0")
    axes.set_yscale("log")
    speeds = [edge for forms, _ in found.values() for up in forms.values() for edge in (up.low, up.high)]
    bottom, limit = min(speeds) / 1.25, max(speeds) * 1.35
    axes.set_ylim(bottom, limit)
    round_ticks(axes.yaxis, bottom, limit, lambda value, _: f"{value:g}×")
    axes.axhline(1, color=FAINT, linewidth=0.8, zorder=1)
    lines = []
    for method, (forms, cracks) in found.items():
        x, (colour, marker) = scale.at(cracks.rate), kinds.of(method)
        axes.plot([x] * len(forms), [up.middle for up in forms.values()], color=colour, linewidth=1.0, zorder=2)
        if cracks.worst > cracks.rate:
            lines.append([(x, best(forms).middle), (scale.at(cracks.worst), best(forms).middle)])
            axes.plot(*zip(*lines[-1]), color=colour, **WORST, zorder=1.6)
        for form, up in forms.items():
            lines.append([(x, up.low), (x, up.high)])
            axes.plot(*zip(*lines[-1]), color=colour, **WHISKER, zorder=1.8)
            face, edge = (colour, "white") if form == "simd" else ("white", colour)
            axes.plot([x], [up.middle], marker=marker, linestyle="", zorder=3, markersize=7, markerfacecolor=face,
                      markeredgecolor=edge, markeredgewidth=0.8 if form == "simd" else 1.5)
    axes.text(scale.start, max(speeds) * 1.3, " fast and watertight", color=GREEN, fontsize=9.5, va="top", fontweight="bold")
    axes.set_ylabel(f"speed, {base.name} in scalar code = 1×")
    axes.set_xlabel("cracks per 10⁶ crossings of shared edges")
    label_points(axes, labels_of(found, scale.at), lines)
    extra = [plt.Line2D([], [], color=FAINT, **WHISKER, label="95 % interval"),
             plt.Line2D([], [], color=FAINT, **WORST, label="worst scene"),
             plt.Line2D([], [], color=INK, marker="o", markerfacecolor="white", linestyle="", markersize=7, label="scalar"),
             plt.Line2D([], [], color=INK, marker="o", linestyle="", markersize=7, label="SIMD")]
    kinds.legend(figure, top, list(found), extra)
    bound = max((3e6 / cracks.crossings for _, cracks in found.values() if cracks.rate == 0), default=3e6 / most.crossings)
    peers = [f"{method.name}: {method.source}." for method in found if method.peer]
    save(figure, folder, "frontier", f"{' '.join([*peers, without_dominant(found), ''])}0: no crack seen; the 95 % upper bound is at most "
         f"{number(bound, 2)} per 10⁶. Left out: scenes with fewer than {short(LEAST_CROSSINGS)} crossings, and for 32-bit methods scenes beyond their range.\n{caption}")
    return "frontier"
