"""The main chart: wrong pixels against speed of each coverage method, in scalar code and with SIMD."""
from accuracy_rows import PEERS
from frontier import LEAST_CROSSINGS, MAIN_CHART, frontier_figures, points_of, timed_scenes, wrong_of
from plot_labels import Label, label_points
from plot_style import BACKENDS, BLACK, FAINT, INK, PURPLE, SKY, VERMILION, WHISKER, WIDTH_IN, ZeroAxis, foot_in, head_in, headline, plt, round_ticks, save
from tables import kernels, number, short

# Methods that differ in the number of subpixel bits alone, joined to a curve.
CURVES = {"64-bit fixed point": {0: "whole_pixel", 4: "fixed_4", 8: "fixed_8", 12: "fixed_12", 16: "fixed_16"},
          "32-bit": {4: "fixed_4_int32", 8: "fixed_8_int32"}}
BITS = {name: bits for bits, name in next(iter(CURVES.values())).items()}  # the same along every curve
# Kinds of methods: prefixes of their names, colour and marker.
KINDS = {"floating point": (("float", "double"), VERMILION, "D"), "fixed point": (("fixed", "whole"), SKY, "v"), "scanline DDA": (("dda",), PURPLE, "P"),
         "tiled, other numbers": (("engine",), "#8b1e3f", "*"), "peers": (PEERS, "#6b705c", "X"), "others": (("",), "#8c959f", "X")}
IN_A_ROW = 7  # of the legend
LABELLED = ("float_lt", "dda_16_16", "llvmpipe", "float_top_left", "fixed_8", "double_top_left")
MOST_LABELS = 8
FRONT = {"color": INK, "linewidth": 1.2, "linestyle": (0, (4, 2)), "zorder": 1.5}


def best_of(points):
    """The methods that no other beats in both errors and speed, those with the fewest errors first."""
    front = []
    for method, (wrong, up, _) in sorted(points.items(), key=lambda item: (item[1][0], -item[1][1].middle)):
        if not front or up.middle > points[front[-1]][1].middle:
            front.append(method)
    return front


def frontier_title(points, code):
    """The fastest watertight methods, as far as intervals tell them apart, and the one that errs least."""
    watertight = {method.name: up for method, (_, up, tight) in points.items() if tight and not method.engine}
    if not watertight:
        return "Coverage: wrong pixels against speed"
    order = sorted(watertight, key=lambda name: -watertight[name].middle)
    fastest = [name for name in order if watertight[name].high >= watertight[order[0]].low]
    return f"{code}: fastest without a crack: {' and '.join(fastest)}; fewest wrong pixels: {best_of(points)[0].name}"


def labels_of(points, x_of):
    """At most MOST_LABELS: ours and the front's first, then others that README names. Curves are labelled at their 8 bits."""
    curve_of = {curve[8]: name for name, curve in CURVES.items()}
    front = [m for m in best_of(points) if not m.engine]
    others = sorted((m for m in points if m.name in (*curve_of, *LABELLED)), key=lambda m: (not m.peer, m.name not in curve_of))
    order = [*(m for m in points if m.ours), *front, *others]
    chosen = list(dict.fromkeys(order))[:MOST_LABELS]
    return [Label(x_of(points[m][0]), points[m][1].middle, curve_of.get(m.name, m.name), bold=m.ours) for m in chosen]


def kind_of(method):
    """The name in the legend, colour and marker."""
    if method.name in BACKENDS:
        return f"{method.name} (ours)", *BACKENDS[method.name]
    if method.ours:
        return "ours (bold)", BLACK, "o"
    return next((kind, *look) for kind, (starts, *look) in KINDS.items() if method.name.startswith(starts))


def legend(figure, y, methods, extra):
    """Backends and kinds of methods, and below them the other marks."""
    found = sorted(dict.fromkeys(map(kind_of, methods)), key=lambda kind: kind[0] == "others")
    handles = [plt.Line2D([], [], color=colour, marker=marker, linestyle="", markersize=7, label=kind) for kind, colour, marker in found]
    for line, row in enumerate([*(handles[i:i + IN_A_ROW] for i in range(0, len(handles), IN_A_ROW)), extra]):
        figure.legend(handles=row, loc="upper left", bbox_to_anchor=(0.005, y - 0.2 * line / figure.get_figheight()),
                      ncol=len(row), frameon=False, handletextpad=0.4, columnspacing=1.3, fontsize=9.5)


def draw_panel(axes, points, scale):
    """Returns the lines that labels keep off."""
    lines = []
    for curve in CURVES.values():
        of = {method.name: method for method in points}
        line = [(scale.at(points[of[name]][0]), points[of[name]][1].middle) for name in curve.values() if name in of]
        axes.plot(*zip(*line), color=FAINT, linewidth=1.2, zorder=1.6) if len(line) > 1 else None
        lines.append(line)
    front = [(scale.at(points[m][0]), points[m][1].middle) for m in best_of(points)]
    steps = [corner for (x, y), (next_x, _) in zip(front, [*front[1:], (scale.limit, 0)]) for corner in ((x, y), (next_x, y))]
    axes.plot(*zip(*steps), **FRONT)
    lines.append(steps)
    for method, (wrong, up, tight) in points.items():
        x, (_, colour, marker) = scale.at(wrong), kind_of(method)
        lines += [[(x, up.low), (x, up.high)], [(x, up.middle)]]
        axes.plot([x, x], [up.low, up.high], color=colour, **WHISKER, zorder=1.8)
        axes.plot([x], [up.middle], marker=marker, linestyle="", zorder=3, markersize=7, markerfacecolor=colour if tight else "white",
                  markeredgecolor="white" if tight else colour, markeredgewidth=0.8 if tight else 1.5)
        if method.name in BITS:
            axes.annotate(str(BITS[method.name]), (x, up.middle), xytext=(0, -11), textcoords="offset points", ha="center", fontsize=7.5,
                          color=FAINT)
    return lines


def without_dominant(found, accuracy):
    """For each scene that has over half of the wrong pixels of labelled methods, a sentence with their rates without it."""
    scenes = {}
    for method in found:
        wrong = wrong_of(accuracy, method)
        if wrong.mostly_on and method.name in LABELLED:
            scenes.setdefault(wrong.mostly_on, []).append(f"{method.name} {number(wrong.without, 2)}")
    return " ".join(f"Over half on {scene}; without it: {', '.join(rates)}." for scene, rates in scenes.items())


def frontier(accuracy, bench, folder, caption):
    found, base, scenes = frontier_figures(accuracy) if accuracy else ({}, None, 0)
    panels = {form: points for form in ("scalar", "simd") if (points := points_of(found, accuracy, form))}
    if len(panels) < 2:
        return None
    counts = sorted(cracks.crossings for _, cracks in found.values())
    crossings = " to ".join(dict.fromkeys(map(short, (counts[0], counts[-1]))))
    subtitle = (f"Further left: fewer pixels that differ from the exact picture of the scene; further up: faster on one thread, "
                f"geometric mean of {scenes} scenes ({', '.join(scene.name for scene in timed_scenes(accuracy))}). Filled: no crack seen in "
                f"{crossings} crossings of shared edges, T-junctions apart; hollow: cracks. Grey numbers: subpixel bits. Ours and other numbers get "
                f"vertices that are snapped already.")
    bound = max((3e6 / cracks.crossings for _, cracks in found.values() if cracks.rate == 0), default=3e6 / counts[-1])
    peers = [f"{method.name}: {method.source}." for method in found if method.peer]
    peers += ["Peers draw whole frames, from vertices."] if peers else []
    notes = (f"{' '.join([*peers, without_dominant(found, accuracy), ''])}No crack seen: the 95 % upper bound is at most {number(bound, 2)} per 10⁶. "
             f"Left out: from cracks, scenes with fewer than {short(LEAST_CROSSINGS)} crossings of shared edges; from wrong pixels, scenes with under 1 % of the largest scene's crossings; for 32-bit methods, scenes beyond their range.\n{caption}")
    above, below = 1.2 + head_in(subtitle), foot_in(notes)
    figure, axes_of = plt.subplots(1, 2, sharey=True, figsize=(WIDTH_IN, above + below + 4.4))
    height = figure.get_figheight()
    code = kernels(bench.context.get("simd_target"))
    top = headline(figure, frontier_title(panels["simd"], code), subtitle)
    figure.subplots_adjust(left=0.085, right=0.985, bottom=below / height, top=1 - above / height, wspace=0.05)
    scale = ZeroAxis([wrong for points in panels.values() for wrong, _, _ in points.values()], band=0.2)
    speeds = [edge for points in panels.values() for _, up, _ in points.values() for edge in (up.low, up.high)]
    bottom, limit = min(speeds) / 1.25, max(speeds) * 1.35
    for axes, (form, points) in zip(axes_of, panels.items()):
        scale.apply_x(axes, "0")
        axes.set_yscale("log")
        axes.set_ylim(bottom, limit)
        round_ticks(axes.yaxis, bottom, limit, lambda value, _: f"{value:g}×")
        axes.set_title("scalar code" if form == "scalar" else f"{code}, and peers with their own vectors",
                       fontsize=10)
        axes.set_xlabel("wrong pixels per 10⁶ edge crossings")
        label_points(axes, labels_of(points, scale.at), draw_panel(axes, points, scale))
    axes_of[0].set_ylabel(f"speed, {base.name} in scalar code = 1×")
    extra = [plt.Line2D([], [], **FRONT, label="fewest errors at a speed (Pareto front)"),
             plt.Line2D([], [], color=FAINT, **WHISKER, label="95 % interval"),
             plt.Line2D([], [], color=INK, marker="o", linestyle="", markersize=7, label="no crack seen"),
             plt.Line2D([], [], color=INK, marker="o", markerfacecolor="white", linestyle="", markersize=7, label="cracks")]
    legend(figure, top, list(found), extra)
    save(figure, folder, MAIN_CHART, notes)
    return MAIN_CHART
