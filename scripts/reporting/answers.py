"""README's first table: the answers to its questions, each with its condition."""
from factors import cells, chosen, gains, most_threads
from frontier import EXACT, INSIDE_TESTS, PRICED, simd_gain
from bench_tables import OURS, THREADS, compared_targets, timed_peers
from tables import about, by_order, kernels, number, outcome

HEADER = ["question", "answer", "condition"]
MOST = 8
PARALLEL = "Parallel or scanline?"
CENTRED_SCENE = "mesh_on_grid"  # its shared edges run through pixel centres


def factor_rows(bench):
    by_factor = {}
    for gain in gains(bench):
        if gain.simd and gain.field in ("traversal", "fill"):
            by_factor.setdefault(gain.factor, []).append(f"{about(gain.median)} {gain.where} ({gain.counts})")
    if by_factor:
        yield [PARALLEL, "speed-up of " + "; of ".join(f"{factor} {', '.join(of)}" for factor, of in by_factor.items()),
               f"medians of scenes (won/lost/open) of [cells](#speed) without HiZ and masks, as implemented here; whole frames, {most_threads(cells(bench))} threads, "
               f"{kernels(bench.context.get('simd_target'))}"]


def box_rows(bench):
    """The backend `naive` and the cell of bands and edges with SIMD: both test whole boxes."""
    found, told, left_out = cells(bench), [], {}
    threads, target = most_threads(found), kernels(bench.context.get("simd_target"))
    for simd, name in ((False, "`naive`"), (True, f"with {target}")):
        boxed = []
        for scene in dict.fromkeys(cell.scene for cell in found):
            others = {(cell.traversal, cell.fill): row for cell, row in chosen(found, scene=scene, simd=simd).items()}
            cell = others.pop(("bands", "edges"), None)
            tested = cell if simd else bench.frame("naive", scene, threads)
            if tested and others:
                boxed.append((tested, min(others.values(), key=lambda row: row.median_ms)))
            else:
                left_out[scene] = None
        told += [f"{name} {outcome(by_order(boxed))}"] if boxed else []
    if told:
        yield ["Or test the whole bounding box?", "; ".join(told),
               f"`naive`, scalar, against the fastest other scalar cell; the {target} box test (bands, edges) "
               f"against the fastest other {target} cell; [cells](#speed) without HiZ and masks; whole frames, {threads} threads"
               + (f"; left out, too slow to repeat: {', '.join(left_out)}" if left_out else "")]


def exactness_rows(accuracy, target):
    found = {name: simd_gain(accuracy, name, EXACT) for name in PRICED if name != EXACT}
    if all(found.values()):
        yield ["What does exactness cost?", "speed-up by " + "; by ".join(f"`{name}` {gain}" for name, gain in found.items()),
               f"over `{EXACT}`, exact after snapping; with snapping and set-up; geometric mean, range and won/lost/open of scenes; one thread, {kernels(target)}"]


def gap_rows(accuracy):
    turned = [(m, found["total_gaps"], found["total_double_hits"]) for m, found in (accuracy.cube or {"methods": ()})["methods"]]
    ours = [counts for m, *counts in turned if m.ours]
    if ours:
        told = [(f"`{m.name}`", *counts) for m, *counts in turned if m.name in INSIDE_TESTS] + [("ours", *map(sum, zip(*ours)))]
        yield ["Gaps / double hits when the cube turns?", ", ".join(f"{who} {gaps:,} / {doubles:,}" for who, gaps, doubles in told),
               f"{accuracy.cube['frames']:,} frames of the tutorials' cube; `float_le` takes samples on an edge as inside, `float_lt` does not"]
    scene = next((s for s in accuracy.of("coverage") if s.name == CENTRED_SCENE), None)
    ours = [m.seen[0] for m in scene.measured if m.method.ours and m.seen] if scene else []
    if ours:
        tests = [f"`{name}` {m.seen[0]:,}" for name in INSIDE_TESTS if (m := scene.of(name)) and m.seen]
        yield ["Where edges meet pixel centres?", f"{', '.join([*tests, f'ours {max(ours):,}'])} wrong pixels",
               f"`{CENTRED_SCENE}`, whose vertices lie on the 1/256 px grid; {number(scene.trials)} crossings of edges with rows or columns of centres"]


def peer_rows(bench):
    for peer in timed_peers(bench):
        target, found = compared_targets(bench, peer)[-1]
        said = [outcome(by_order(of)) + f" on {threads} thread{'' if threads == 1 else 's'}" for threads in THREADS
                if (of := [(ours, row) for (_, n), (row, ours) in found.items() if n == threads])]
        yield [f"Against {peer}?", f"`{OURS}` {'; '.join(said)}",
               f"{peer} is {bench.context.get(peer, 'of unknown version')}; whole frames, ours with {kernels(target)}; frames over 0.3 s are timed once"]


def answers(bench, accuracy):
    """Lines for HEADER; none for what was not measured."""
    told = [*exactness_rows(accuracy, bench.context.get("simd_target")), *gap_rows(accuracy)] if accuracy else []
    return [*factor_rows(bench), *box_rows(bench), *told, *peer_rows(bench)][:MOST]
