"""README's first table: the answers to its questions, each with its condition."""
from factors import cells, gains, most_threads, said
from frontier import EXACT, INSIDE_TESTS, PRICED, simd_outcome
from bench_tables import OURS, THREADS, compared_targets, timed_peers
from tables import by_order, kernels, number, outcome

HEADER = ["question", "answer", "condition"]
MOST = 8
PARALLEL = "Parallel or scanline?"
CENTRED_SCENE = "mesh_on_grid"  # its shared edges run through pixel centres


def factor_rows(bench):
    with_simd = {gain.factor: " (".join(said(gain)) + ")" for gain in gains(bench) if gain.simd}
    told = [f"{factor} {with_simd[factor]}" for factor in ("tiles over bands", "edges over spans") if factor in with_simd]
    if told:
        yield [PARALLEL, f"speed-up of {', '.join(told)}", f"median and range of all scenes, all else equal; whole frames, "
               f"{most_threads(cells(bench))} threads, {kernels(bench.context.get('simd_target'))}; [all factors](#speed)"]


def box_rows(bench):
    threads = max(THREADS)
    drawn = [{b: row for b in bench.backends if (row := bench.frame(b, scene, threads))} for scene in bench.scenes]
    boxed = [(rows.pop("naive"), min(rows.values(), key=lambda row: row.median_ms)) for rows in drawn if "naive" in rows and len(rows) > 1]
    if boxed:
        yield ["Or test the whole bounding box?", f"`naive` {outcome(by_order(boxed))}",
               f"against the fastest other backend; whole frames, {threads} threads, {kernels(bench.context.get('simd_target'))}, but "
               "`naive` in scalar code"]


def exactness_rows(accuracy, target):
    found = {name: simd_outcome(accuracy, name, EXACT) for name in PRICED if name != EXACT}
    if all(found.values()):
        yield ["What does exactness cost?", "; ".join(f"`{name}` {outcome(by)}" for name, by in found.items()),
               f"against `{EXACT}`, exact after snapping, the same loop; one thread, {kernels(target)}"]


def gap_rows(accuracy):
    turned = [(m, found["total_gaps"], found["total_double_hits"]) for m, found in (accuracy.cube or {"methods": ()})["methods"]]
    ours = [counts for m, *counts in turned if m.ours]
    if ours:
        told = [(f"`{m.name}`", *counts) for m, *counts in turned if m.name in INSIDE_TESTS] + [("ours", *map(sum, zip(*ours)))]
        yield ["Gaps / double hits when the cube turns?", ", ".join(f"{who} {gaps:,} / {doubles:,}" for who, gaps, doubles in told),
               f"{accuracy.cube['frames']:,} frames of the tutorials' cube; `float_le` takes samples on an edge as inside, `float_lt` does not"]
    scene = next((s for s in accuracy.of("coverage") if s.name == CENTRED_SCENE), None)
    ours = [m.rate for m in scene.measured if m.method.ours] if scene else []
    if ours:
        tests = [f"`{name}` {number(m.rate)}" for name in INSIDE_TESTS if (m := scene.of(name))]
        yield ["Where edges meet pixel centres?", f"{', '.join([*tests, f'ours {number(max(ours))}'])} wrong pixels per 10⁶ edge crossings",
               f"`{CENTRED_SCENE}`, whose vertices lie on the 1/256 px grid"]


def peer_rows(bench):
    for peer in timed_peers(bench):
        target, found = compared_targets(bench, peer)[-1]
        said = [outcome(by_order(of)) + f" on {threads} thread{'' if threads == 1 else 's'}" for threads in THREADS
                if (of := [(ours, row) for (_, n), (row, ours) in found.items() if n == threads])]
        yield [f"Against {peer}?", f"`{OURS}` {'; '.join(said)}",
               f"{peer} is {bench.context.get(peer, 'of unknown version')}; whole frames, ours with {kernels(target)}"]


def answers(bench, accuracy):
    """Lines for HEADER; none for what was not measured."""
    told = [*exactness_rows(accuracy, bench.context.get("simd_target")), *gap_rows(accuracy)] if accuracy else []
    return [*factor_rows(bench), *box_rows(bench), *told, *peer_rows(bench)][:MOST]
