"""Charts by scene: time, and what threads, SIMD and culling gain."""
from plot_style import FAINT, INK, Look, headline, log_axis, plt, save
from tables import NORMAL_Z, culling_gains, pixels_wrong


def room_for(names):
    """Left margin, in figure fractions, for the names of lines."""
    return 0.1 + 0.0085 * max(0, max(map(len, names)) - 10)


def scene_time(bench, folder, caption):
    """One line a scene, one place a backend: hollow 1 thread, filled 2."""
    look = Look(bench.backends)
    scenes = bench.scenes
    if not scenes:
        return None
    figure, axes = plt.subplots(figsize=(10.0, 1.6 + 0.52 * len(scenes)))
    step = 0.72 / max(1, len(bench.backends))
    for line, scene in enumerate(scenes):
        if line % 2:
            axes.axhspan(line - 0.5, line + 0.5, color="#f6f8fa", zorder=0)
        for place, backend in enumerate(bench.backends):
            y = line + (place - (len(bench.backends) - 1) / 2) * step
            rows = [row for threads in (1, 2) if (row := bench.find(f"{backend}/{scene}/threads:{threads}"))]
            axes.plot([row.median_ms for row in rows], [y] * len(rows), color=look.colour(backend), linewidth=1.6)
            for row in rows:
                axes.plot([row.low_ms, row.high_ms], [y, y], color=look.colour(backend), linewidth=5, alpha=0.2,
                          solid_capstyle="butt")
                filled = row.threads > 1
                axes.plot([row.median_ms], [y], marker=look.marker(backend), markersize=6.5, linestyle="",
                          color=look.colour(backend), markerfacecolor=look.colour(backend) if filled else "white",
                          markeredgewidth=1.5)
    axes.set_xscale("log")
    log_axis(axes.xaxis)
    axes.set_yticks(range(len(scenes)), scenes)
    axes.tick_params(axis="y", length=0)
    axes.set_ylim(len(scenes) - 0.5, -0.5)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("ms a frame, backend alone, clear included")
    height = figure.get_figheight()
    top = headline(figure, "Time per scene", "Screen triangles to finished picture; lower is better. "
                   "Hollow: 1 thread, filled: 2. Light bar: fastest to slowest repetition.")
    look.legend(figure, top - 0.02 / height)
    figure.subplots_adjust(left=room_for(scenes), right=0.975, bottom=0.78 / height, top=top - 0.42 / height)
    save(figure, folder, "scenes", caption)
    return "scenes"


def dots(axes, look, groups, value_of, hollow_of=None):
    """A dot a backend for each group, in lines from top to bottom; below each the hollow one of hollow_of, if given."""
    marks = [(value_of, True), *([(hollow_of, False)] if hollow_of else [])]
    step = (0.6 if len(marks) == 1 else 0.76) / max(1, len(look.backends) * len(marks))
    for line, group in enumerate(groups):
        if line % 2:
            axes.axhspan(line - 0.5, line + 0.5, color="#f6f8fa", zorder=0)
        each = [(backend, *mark) for backend in look.backends for mark in marks]
        for place, (backend, found, filled) in enumerate(each):
            value = found(group, backend)
            if value is None:
                continue
            y = line + (place - (len(each) - 1) / 2) * step
            axes.plot([1, value], [y, y], color=look.colour(backend), linewidth=2.2 if filled else 1.1)
            axes.plot([value], [y], marker=look.marker(backend), color=look.colour(backend), markersize=6.5,
                      markerfacecolor=look.colour(backend) if filled else "white", markeredgewidth=1.0 if filled else 1.5)
    axes.axvline(1, color=FAINT, linewidth=1.0)
    axes.set_yticks(range(len(groups)), groups)
    axes.tick_params(axis="y", length=0)
    axes.set_ylim(len(groups) - 0.5, -0.5)
    axes.grid(axis="y", visible=False)
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}×")


def gain(before, after):
    return before.median_ms / after.median_ms if before and after else None


def gain_chart(bench, folder, caption, name, groups, value_of, title, subtitle, label, hollow_of=None, notes=None):
    """`notes`: what stands on the right of a group."""
    if not any(value_of(group, backend) for group in groups for backend in bench.backends):
        return None
    look = Look(bench.backends)
    figure, axes = plt.subplots(figsize=(10.0, 2.0 + (0.85 if hollow_of else 0.4) * len(groups)))
    dots(axes, look, groups, value_of, hollow_of)
    for line, group in enumerate(groups if notes else ()):
        axes.text(1.012, line, notes[group], transform=axes.get_yaxis_transform(), fontsize=9, color=FAINT, va="center")
    axes.set_xlabel(label)
    height = figure.get_figheight()
    top = headline(figure, title, subtitle)
    look.legend(figure, top - 0.02 / height)
    figure.subplots_adjust(left=room_for(groups), right=0.86 if notes else 0.975, bottom=0.78 / height,
                           top=top - 0.42 / height)
    save(figure, folder, name, caption)
    return name


def threads(bench, folder, caption):
    def value_of(scene, backend):
        return gain(*(bench.find(f"{backend}/{scene}/threads:{n}") for n in (1, 2)))

    return gain_chart(bench, folder, caption, "threads", bench.scenes, value_of, "What the second thread gains",
                      "Time on 1 thread over time on 2, backend alone; 2× is ideal.", "speed-up")


def culling(bench, folder, caption):
    """By the winding on the screen, and hollow by the z of normals where that was timed."""
    by_winding, by_normal = culling_gains(bench, "back"), culling_gains(bench, NORMAL_Z)

    def value_in(gains):
        return lambda scene, backend: gains.get(scene, {}).get(backend)

    told = "Whole frames of closed meshes, front end included: time without culling over time with back faces culled"
    if not by_normal:
        return gain_chart(bench, folder, caption, "culling", list(by_winding), value_in(by_winding), "What culling gains",
                          f"{told}.", "speed-up")
    notes = {scene: pixels_wrong(bench, scene) if scene in by_normal else "" for scene in by_winding}
    return gain_chart(bench, folder, caption, "culling", list(by_winding), value_in(by_winding), "What culling gains",
                      f"{told}.\nFilled: by the winding on the screen. Hollow: by the z of normals before projection "
                      f"({NORMAL_Z}), with the pixels it gets wrong.", "speed-up", value_in(by_normal), notes)


def simd(bench, folder, caption):
    """Small multiples: speed-up over the slowest target, target by target."""
    look = Look(bench.backends)
    rows = bench.sweep("target")
    scenes = list(dict.fromkeys(row.scene for row in rows))
    targets = list(dict.fromkeys(row.keys["target"] for row in rows))
    if not scenes or len(targets) < 2:
        return None
    by_key = {(row.scene, row.backend, row.keys["target"]): row for row in rows}
    figure, panels = plt.subplots(1, len(scenes), sharey=True, squeeze=False, figsize=(10.0, 4.2))
    for axes, scene in zip(panels[0], scenes):
        for backend in bench.backends:
            gains = [gain(by_key.get((scene, backend, targets[0])), by_key.get((scene, backend, t))) for t in targets]
            places = [i for i, g in enumerate(gains) if g is not None]
            axes.plot(places, [gains[i] for i in places], color=look.colour(backend), marker=look.marker(backend),
                      markeredgecolor="white", markeredgewidth=0.6)
        axes.axhline(1, color=FAINT, linewidth=1.0, zorder=1)
        axes.set_xticks(range(len(targets)), targets, fontsize=9)
        axes.set_xlim(-0.3, len(targets) - 0.7)
        axes.set_title(scene, color=INK)
        axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}×")
    panels[0][0].set_ylim(bottom=0)
    height = figure.get_figheight()
    top = headline(figure, "What SIMD gains", f"Time with {targets[0]} kernels over time with each target's, backend "
                   "alone, 1 thread; higher is better.")
    look.legend(figure, top - 0.02 / height)
    figure.subplots_adjust(left=0.06, right=0.985, bottom=0.6 / height, top=top - 0.72 / height, wspace=0.12)
    save(figure, folder, "simd", caption)
    return "simd"


CHARTS = (scene_time, threads, simd, culling)
