"""The figures of the report as plain data: those of the static charts and of the tables."""
from accuracy_rows import FAMILIES, read_accuracy, read_stability
from accuracy_tables import rate_text
from bench_rows import describe_machine, read_bench, read_json
from compare_rows import judge, other_work
from cost_model import estimates_ms
from ablation import said, steps, verdict
from peers import over_backend, pairs
from scaling import allowed, measured, quickest, scheduled
from speed_accuracy import SUBTITLES, TRIALS, chart_rows, cost_range, front_line, shade, unsettled
from stability_curves import axis_of_errors, failing, groups_of, kinds_and_dashes, known_methods, runs_down, trials_note
from area import all_crossings, area_curves, two_digits
from tables import THREADS
from zero_axis import ZeroAxis


class Result:
    """The results in a folder, and their name."""

    def __init__(self, folder, called=None):
        self.bench = read_bench(folder)
        self.accuracy, self.sweeps = read_accuracy(folder), read_stability(folder)
        self.machine = read_json(folder / "machine.json")
        where, commit = self.bench.context.get("machine", folder.name), self.machine.get("commit", "unknown")
        quick = ", quick" if self.bench.context.get("suite") == "quick" else ""
        self.name = f"{where}, commit {commit}{quick}" + (f" ({called})" if called else "")


def rounded(value):
    """To the precision that a chart shows."""
    return float(f"{value:.4g}")


def time(row):
    """ms: the median, the fastest and the slowest."""
    return [rounded(ms) for ms in (row.median_ms, row.low_ms, row.high_ms)]


def area(bench):
    """By threads: ns per covered pixel along the area, and the crossings of the curves."""
    found = {}
    for threads in sorted({row.threads for row in bench.sweep("area")}):
        points = area_curves(bench, threads)
        found[threads] = {
            "curves": [{"backend": backend, "points": [[x, *(rounded(ms * scale) for ms in time(row))]
                                                       for x, row, scale in curve]}
                       for backend, curve in points.items()],
            "crossings": [{"x": rounded(x), "y": rounded(y), "backends": [a, b], "area": two_digits(x)}
                          for x, y, a, b in all_crossings(points)]}
    return found


def times(bench):
    """The time of each backend on a scene, and the estimates of the cost model."""
    return [{"scene": scene, "backend": backend, "threads": threads, "ms": time(row),
             "estimates": [rounded(ms) for ms in estimates_ms(bench, row) or ()]}
            for scene in bench.scenes for backend in bench.backends for threads in THREADS
            if (row := bench.find(f"{backend}/{scene}/threads:{threads}"))]


def peers(bench):
    return [{"peer": peer, "scene": scene, "threads": threads, "ms": time(pair.peer),
             "draws": "mesh" if pair.peer.frontend else "screen triangles",
             "ratios": {backend: rounded(ratio) for backend in bench.backends
                        if (ratio := over_backend(bench, pair, backend))}}
            for (peer, scene, threads), pair in pairs(bench).items()]


def ablation(bench):
    found = []
    for scene in dict.fromkeys(row.scene for row in bench.sweep("step")):
        named = steps(bench, scene)
        befores = [None, *(row for _, row in named)]
        found.append({"scene": scene, "steps": [
            {"label": label, "ms": time(row), "estimate": rounded((estimates_ms(bench, row) or [0.0])[0]),
             "said": said(before, row),
             "verdict": verdict(before, row) if before else "start"}
            for before, (label, row) in zip(befores, named)]})
    return found


def scaling(bench):
    found, best = scheduled(bench), quickest(bench)
    return [{"scene": scene, "backend": backend, "first": best[scene] == backend,
             "points": [[cores, rounded(gain)] for cores, gain in allowed(rows).items()],
             "measured": [[threads, rounded(gain)] for threads, gain in measured(bench, scene, backend).items()
                          if threads > 1],
             "serial": rows[max(rows)].label}
            for (scene, backend), rows in found.items()]


def speed_scenes(results):
    """For each result its scenes on which speed was measured; the axes of a scene are the same in all results."""
    timed = [{(family, scene.name): scene for family in FAMILIES for _, scene in result.accuracy.timed_charts(family)}
             if result.accuracy else {} for result in results]
    axes = {}
    for key in dict.fromkeys(key for scenes in timed for key in scenes):
        seen = [m for scenes in timed if key in scenes for m in scenes[key].measured if m.costs]
        axes[key] = ZeroAxis([m.rate for m in seen]), cost_range(seen)
    return [[speed_scene(scene, *axes[key]) for key, scene in scenes.items()] for scenes in timed]


def speed_scene(scene, scale, costs):
    timed = [m for m in scene.measured if m.costs]
    open_question = unsettled(scene.single)
    single = [(scale.at(m.rate), m.costs[1].ns) for m in timed if 1 in m.costs]
    points = [{"method": m.method.name, "x": scale.at(m.rate), "rate": m.rate, "said": rate_text(m), "hollow": bool(m.snapped_rate),
               "unsettled": m in open_question,
               "costs": {threads: [rounded(ns) for ns in cost] for threads, cost in sorted(m.costs.items())}}
              for m in timed]
    return {"family": scene.family, "scene": scene.name, "idea": scene.idea, "trials": scene.trials, "costs": costs,
            "axis": zero_axis(scale), "points": points,
            "front": front_line(single, scale.limit, costs[1]) if single else []}


def zero_axis(scale):
    ticks, labels = scale.ticks("0")
    return {"start": scale.start, "end": scale.end, "limit": scale.limit, "ticks": list(zip(ticks, labels))}


def errors(accuracy):
    """Every method on every scene, as text and as a shade from 0 to 1."""
    return {family: [{"scene": label, "cells": {name: [text, rounded(shade(rates[name]))] for name, text in texts.items()}}
                     for label, texts, rates in chart_rows(accuracy.of(family))] for family in FAMILIES}


def methods(accuracy):
    return {name: [{"name": m.name, "source": m.source, "promise": m.promise, "ours": m.ours, "kind": family.kind(m)}
                   for m in accuracy.methods[name]] for name, family in FAMILIES.items()}


def stability(results):
    """For each result its sweeps; the axes of a sweep are the same in all results."""
    drawn = [[sweep for sweep in result.sweeps if sweep.curves and all(curve.points for curve in sweep.curves)]
             for result in results]
    axes = {name: axis_of_errors(*(sweep for sweeps in drawn for sweep in sweeps if sweep.name == name))
            for name in {sweep.name for sweeps in drawn for sweep in sweeps}}
    return [[sweep_data(sweep, groups_of(sweep, known_methods(result.accuracy)), axes[sweep.name]) for sweep in sweeps]
            for result, sweeps in zip(results, drawn)]


def sweep_data(sweep, groups, scale):
    axis = zero_axis(scale) if sweep.y["log"] else None
    curves = [{"methods": [[m.name, m.ours] for m in members], "kind": kind, "dash": dash,
               "points": [[x, rounded(scale.at(y)), rounded(y)] for x, y in curve.points],
               "fails": curve.starts_to_fail, "failing": failing(curve, sweep)}
              for (members, curve), (kind, dash) in zip(groups, kinds_and_dashes(groups, FAMILIES[sweep.family]))]
    return {"name": sweep.name, "family": sweep.family, "idea": sweep.idea, "x": {**sweep.x, "down": runs_down(sweep)},
            "y": sweep.y["name"].replace("10^6", "10⁶"), "axis": axis, "curves": curves,
            "by_snapping": max(sweep.by_snapping) > 0, "note": trials_note(sweep).strip()}


def changes(before, after, least=0.03):
    """[name, ms before, ms after, ratio, verdict] of the rows that both timed, the largest changes first."""
    found = []
    for name, a in before.rows.items():
        b = after.find(name)
        if b and a.times_ms and not other_work(a, b):
            ratio, said = judge(a, b, least)
            found.append([name, rounded(a.median_ms), rounded(b.median_ms), rounded(ratio), said])
    return sorted(found, key=lambda row: (-max(row[3], 1 / row[3]), row[0]))


def families():
    return {name: {"errors": family.errors, "cost": family.cost, "trials": TRIALS[name],
                   "idea": SUBTITLES[name]} for name, family in FAMILIES.items()}


def results_data(results):
    return [{"name": result.name, "machine": describe_machine(result.machine), "backends": result.bench.backends,
             "scenes": result.bench.scenes,
             "area": area(result.bench), "times": times(result.bench), "peers": peers(result.bench),
             "peer_versions": {peer: result.bench.context.get(peer, "") for peer in result.bench.peers},
             "ablation": ablation(result.bench), "scaling": scaling(result.bench), "speed": speed,
             "methods": methods(result.accuracy) if result.accuracy else {},
             "errors": errors(result.accuracy) if result.accuracy else {},
             "stability": sweeps,
             "changes": [changes(other.bench, result.bench) if other is not result else [] for other in results]}
            for result, speed, sweeps in zip(results, speed_scenes(results), stability(results))]
