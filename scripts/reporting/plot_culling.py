"""Chart of the speed-up by culling, scene by scene."""
from bench_rows import gained, gained_interval, order
from noise import median
from plot_style import FAINT, WIDTH_IN, Look, head_in, headline, plt, round_ticks, save
from tables import about

NORMAL_Z = "normal_z"  # the Outlaw Triad trainer's facing test


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
    save(figure, folder, "culling", f"Light bars: 95 % intervals.\n{caption}")
    return "culling"
