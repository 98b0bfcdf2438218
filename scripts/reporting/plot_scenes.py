"""Charts by scene: the speed-up by SIMD and by culling."""
from bench_rows import gained, gained_interval, order
from bench_tables import OURS
from noise import median
from plot_style import FAINT, INK, WIDTH_IN, Look, head_in, headline, plt, round_ticks, save
from tables import VECTORS, about, kernels, spread

NORMAL_Z = "normal_z"  # the Outlaw Triad trainer's facing test
INTERVALS = "Light bars: 95 % intervals."


def speed_up_text(value, _):
    return f"{value:g}×" if value >= 1 else f"{1 / value:.3g}×\nslower"


def dots(axes, look, gains, hollow):
    """A dot per backend for each scene, in lines from top to bottom; below each the hollow one. `gains` and `hollow`:
    {scene: {backend: (row before, row after)}}"""
    sides = [(gains, True), *([(hollow, False)] if hollow else [])]
    step = (0.6 if len(sides) == 1 else 0.76) / max(1, len(look.backends) * len(sides))
    ends = [1.0]
    for line, scene in enumerate(gains):
        if line % 2:
            axes.axhspan(line - 0.5, line + 0.5, color="#f6f8fa", zorder=0)
        each = [(backend, *side) for backend in look.backends for side in sides]
        for place, (backend, of, filled) in enumerate(each):
            if not (rows := of.get(scene, {}).get(backend)):
                continue
            y = line + (place - (len(each) - 1) / 2) * step
            colour = look.colour(backend)
            ends += gained_interval(*rows)
            axes.plot(ends[-2:], [y, y], color=colour, linewidth=5, alpha=0.25, solid_capstyle="butt")
            axes.plot([gained(*rows)], [y], marker=look.marker(backend), color=colour, markersize=6.5,
                      markerfacecolor=colour if filled else "white", markeredgewidth=1.0 if filled else 1.5)
    axes.axvline(1, color=FAINT, linewidth=1.0)
    axes.set_yticks(range(len(gains)), gains)
    axes.tick_params(axis="y", length=0)
    axes.set_ylim(len(gains) - 0.5, -0.5)
    axes.grid(axis="y", visible=False)
    axes.set_xscale("log")
    low, high = min(ends) / 1.04, max(ends) * 1.04
    axes.set_xlim(low, high)
    round_ticks(axes.xaxis, low, high, speed_up_text, ratios=True)


def culling_rows(bench, mode):
    """{scene: {backend: (row of a whole frame with all its faces, row in this culling mode)}}"""
    rows = {(row.scene, row.backend, row.keys["cull"]): row for row in bench.sweep("cull")}
    found = {}
    for (scene, backend, kept), all_faces in rows.items():
        if kept == "none" and (culled := rows.get((scene, backend, mode))):
            found.setdefault(scene, {})[backend] = all_faces, culled
    return found


def culling(bench, folder, caption):
    """Filled: by the winding on the screen; hollow: by the z of normals, if timed."""
    gains, by_normal = culling_rows(bench, "back"), culling_rows(bench, NORMAL_Z)
    compared = [rows for of in gains.values() for rows in of.values()]
    if not compared:
        return None
    subtitle = "Whole frames of closed meshes, front end included: time with all faces over time with back faces culled."
    if by_normal:
        subtitle += (" Filled: by the winding on the screen. Hollow: by the z of normals before projection "
                     f"({NORMAL_Z}), with the pixels it gets wrong.")
    look = Look(bench.backends)
    figure, axes = plt.subplots(figsize=(WIDTH_IN, 1.8 + head_in(subtitle) + (0.85 if by_normal else 0.4) * len(gains)))
    dots(axes, look, gains, by_normal)
    for line, scene in enumerate(gains):
        if scene in by_normal:
            wrong = next(iter(by_normal[scene].values()))[1].counters["wrong_px"]
            axes.text(1.012, line, f"{wrong:,.0f} px wrong", transform=axes.get_yaxis_transform(), fontsize=9, color=FAINT, va="center")
    axes.set_xlabel("speed-up by culling")
    faster = sum(order(after, before) < 0 for before, after in compared)
    height = figure.get_figheight()
    top = headline(figure, f"Culling helps in {faster} of {len(compared)} cases, {about(median(gained(*rows) for rows in compared))} in median",
                   subtitle)
    look.legend(figure, top - 0.02 / height)
    margin = 0.1 + 0.0085 * max(0, max(map(len, gains)) - 10)  # for the names of scenes
    figure.subplots_adjust(left=margin, right=0.86 if by_normal else 0.975, bottom=0.95 / height, top=top - 0.42 / height)
    save(figure, folder, "culling", f"{INTERVALS}\n{caption}")
    return "culling"


def simd(bench, folder, caption):
    """Small multiples: the speed-up over scalar code, target by target."""
    look = Look(bench.backends)
    rows = [row for row in bench.sweep("target") if row.threads == 1 and not row.frontend]
    timed_targets = {row.keys["target"] for row in rows}
    targets = [target for target in ("scalar", *VECTORS) if target in timed_targets]
    by_key = {(row.scene, row.backend, row.keys["target"]): row for row in rows}
    scenes = [scene for scene in dict.fromkeys(row.scene for row in rows)
              if any((scene, backend, targets[0]) in by_key for backend in bench.backends)]
    if not scenes or len(targets) < 2:
        return None
    figure, panels = plt.subplots(1, len(scenes), sharey=True, squeeze=False, figsize=(WIDTH_IN, 4.6))
    ends, widest = [1.0], []
    for axes, scene in zip(panels[0], scenes):
        for backend in bench.backends:
            first = by_key.get((scene, backend, targets[0]))
            timed = [(place, row) for place, target in enumerate(targets) if (row := by_key.get((scene, backend, target)))]
            if not first:
                continue
            colour = look.colour(backend)
            for place, row in timed[1:]:
                ends += gained_interval(first, row)
                axes.plot([place, place], ends[-2:], color=colour, linewidth=5, alpha=0.25, solid_capstyle="butt")
            axes.plot([place for place, _ in timed], [gained(first, row) for _, row in timed], color=colour,
                      marker=look.marker(backend), markeredgecolor="white", markeredgewidth=0.6)
            if backend == OURS:
                widest.append(gained(first, timed[-1][1]))
        axes.axhline(1, color=FAINT, linewidth=1.0, zorder=1)
        axes.set_xticks(range(len(targets)), targets, fontsize=8)
        axes.set_xlim(-0.15, len(targets) - 0.85)
        axes.set_title(scene, color=INK)
        axes.set_yscale("log")
    low, high = min(ends) / 1.04, max(ends) * 1.04
    panels[0][0].set_ylim(low, high)
    round_ticks(panels[0][0].yaxis, low, high, speed_up_text, ratios=True)
    height = figure.get_figheight()
    title = (f"With {kernels(targets[-1])}, {OURS} is {spread(widest)} faster than with {kernels(targets[0])}" if widest else
             f"Speed-up by {kernels(targets[-1])} over {kernels(targets[0])}")
    top = headline(figure, title,
                   f"Time with {kernels(targets[0])} over time with each target, backend alone, 1 thread; higher is better. "
                   f"{INTERVALS}")
    look.legend(figure, top - 0.02 / height)
    figure.subplots_adjust(left=0.06, right=0.985, bottom=0.6 / height, top=top - 0.72 / height, wspace=0.12)
    save(figure, folder, "simd", caption)
    return "simd"


CHARTS = (simd, culling)
