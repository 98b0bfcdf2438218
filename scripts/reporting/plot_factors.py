"""README's second chart: which way of drawing wins, by the size of triangles and by overdraw."""
from bench_rows import gained_interval
from factors import SCALAR, cells, duels, most_threads
from plot_labels import Label, label_points
from plot_style import BACKENDS, FAINT, INK, WIDTH_IN, dark, head_in, headline, log_axis, plt, round_ticks, save
from tables import enumerated, kernels

PANELS = {"<1": (0, 1), "1–4": (1, 4), "≥4": (4, float("inf"))}  # overdraw
LOOKS = {"bands": BACKENDS["scanline"], "tiles": BACKENDS["tiled"]}


def in_panel(found, panel):
    low, high = PANELS[panel]
    return [duel for duel in found if low <= duel.overdraw < high]


def title(found, code):
    """How many scenes bands win, lose and leave open, by overdraw."""
    def told(of):
        orders = [duel.order for duel in of]
        return "/".join(str(orders.count(order)) for order in (-1, 1, 0))

    return f"{code}: bands won/lost/open by overdraw: " + ", ".join(f"{panel} {told(of)}" for panel in PANELS if (of := in_panel(found, panel)))


def panel(axes, found, low, high):
    axes.axhspan(1, high, color=LOOKS["bands"][0], alpha=0.06, linewidth=0)
    axes.axhspan(low, 1, color=LOOKS["tiles"][0], alpha=0.06, linewidth=0)
    axes.axhline(1, color=FAINT, linewidth=1.0)
    labels, lines = [], [[(end, 1) for end in axes.get_xlim()]]
    for duel in found:
        side, drawn_by = duel.winner
        colour, marker = LOOKS[side]
        at = duel.triangle_px, duel.ratio
        lines.append([(at[0], end) for end in interval(duel)])
        axes.plot(*zip(*lines[-1]), color=colour, linewidth=5, alpha=0.25, solid_capstyle="butt")
        axes.plot(*at, marker=marker, color=colour, markersize=7.5, markeredgewidth=1.5, markerfacecolor=colour if duel.order else "white")
        labels.append(Label(*at, f"{duel.scene}\n{drawn_by}", dark(colour), 8))
    return labels, lines


def interval(duel):
    return gained_interval(*reversed(duel.fastest))


def factors(bench, folder, caption):
    target = kernels(bench.context.get("simd_target"))
    rows = {code: found for code, simd in ((target, True), (f"{SCALAR}; spans vectorized by the compiler", False)) if (found := list(duels(bench, simd)))}
    if not rows:
        return None
    subtitle = (f"A marker is a scene, whole frames on {most_threads(cells(bench))} threads: the fastest cell with bands (with SIMD, also scanline, "
                "bands with both fills) against the fastest with tiles, without HiZ and masks. Up: bands are faster; down: tiles. Label: the scene, and what wins. "
                "Filled: settled against all of the other side. Light bars: 95 % intervals.")
    only = [duel.scene for duel in next(iter(rows.values())) if duel.only_shipped]
    subtitle += f" The backend tiled, with HiZ and masks, also beats the bands in {enumerated(only)}." if only else ""
    above, below, each = 0.5 + head_in(subtitle), 0.9, 3.2
    figure, grid = plt.subplots(len(rows), len(PANELS), sharex=True, sharey="row", squeeze=False,
                                figsize=(WIDTH_IN, above + below + each * len(rows)))
    height = figure.get_figheight()
    headline(figure, title(*next((found, code) for code, found in rows.items())), subtitle)
    figure.subplots_adjust(left=0.085, right=0.985, bottom=below / height, top=1 - above / height, wspace=0.06, hspace=0.16)
    made = []
    for line, (code, found) in zip(grid, rows.items()):
        ends = [end for duel in found for end in interval(duel)]
        low, high = min(1, *ends) / 1.35, max(1, *ends) * 1.5
        sizes = [duel.triangle_px for duel in found]
        line[0].set_yscale("log")
        line[0].set_ylim(low, high)
        round_ticks(line[0].yaxis, low, high, lambda value, _: f"{max(value, 1 / value):.3g}×", ratios=True)
        line[0].set_ylabel(f"{code}\n← tiles faster    bands faster →")
        for axes, name in zip(line, PANELS):
            axes.set_xscale("log")
            axes.set_xlim(min(sizes) / 2, max(sizes) * 10)
            made.append((axes, *panel(axes, in_panel(found, name), low, high)))
    for axes, name in zip(grid[0], PANELS):
        axes.set_title(f"overdraw {name}", color=INK)
    for axes in grid[-1]:
        log_axis(axes.xaxis)
        axes.set_xlabel("covered pixels per triangle,\nculled ones included", fontsize=9.5)
    for axes, labels, lines in made:
        label_points(axes, labels, lines)
    save(figure, folder, "factors", caption)
    return "factors"
