"""README's first table: the answers to its questions, each with its condition."""
from frontier import ENGINES, INSIDE_TESTS, measured_in, simd_outcome
from bench_tables import OURS, THREADS, pairs
from tables import by_order, kernels, number, outcome

HEADER = ["question", "answer", "condition"]
MOST = 8
CENTRED_SCENE = "mesh_on_grid"  # its shared edges run through pixel centres


def speed_rows(bench):
    threads = max(THREADS)
    drawn = [{b: row for b in (OURS, "scanline", "naive") if (row := bench.frame(b, scene, threads))} for scene in bench.scenes]
    drawn = [rows for rows in drawn if OURS in rows and "scanline" in rows]
    condition = f"whole frames, {threads} threads, {kernels(bench.context.get('simd_target'))}"
    if drawn:
        yield ["Parallel or scanline?", f"`{OURS}` {outcome(by_order((rows[OURS], rows['scanline']) for rows in drawn))}",
               f"against `scanline`; {condition}"]
    boxed = [(rows["naive"], min(rows[OURS], rows["scanline"], key=lambda row: row.median_ms)) for rows in drawn if "naive" in rows]
    if boxed:
        yield ["Or test the whole bounding box?", f"`naive` {outcome(by_order(boxed))}",
               f"against the faster of the two; {condition}, but `naive` in scalar code"]


def exactness_rows(accuracy, target):
    exact, loose = ENGINES
    if found := simd_outcome(accuracy, exact, loose):
        yield ["What does exactness cost in time?", f"`{exact}` {outcome(found)}",
               f"against `{loose}`, float edges in the same engine; one thread, {kernels(target)}"]
    rates, plain = accuracy.rates("coverage"), INSIDE_TESTS[0]
    ours = [rates[m.name] for m in accuracy.methods.get("coverage", ()) if m.ours and m.name in rates]
    if ours and plain in rates:
        ours, theirs = max(ours), rates[plain]
        said = f"ours {number(ours.rate)}, `{plain}` {number(theirs.rate)} wrong per 10⁶ edge crossings"
        if scene := theirs.mostly_on:
            left = accuracy.rates("coverage", without=scene)
            ours_left = max(left[m.name].rate for m in accuracy.methods["coverage"] if m.ours and m.name in left)
            said += f"; without `{scene}`, which has over half of `{plain}`'s, {number(ours_left)} and {number(theirs.without)}"
        yield ["What does exactness cost in wrong pixels?", said,
               f"against the positions before snapping, {len(accuracy.pooled('coverage'))} scenes pooled"]


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
        tests = [f"`{name}` {number(m.rate)}" for name in INSIDE_TESTS if (m := measured_in(scene, name))]
        yield ["Where edges meet pixel centres?", f"{', '.join([*tests, f'ours {number(max(ours))}'])} wrong pixels per 10⁶ edge crossings",
               f"`{CENTRED_SCENE}`, whose vertices lie on the 1/256 px grid"]


def peer_rows(bench):
    for target in dict.fromkeys((bench.context.get("simd_target"), "avx2")):
        found = pairs(bench, None if target == bench.context.get("simd_target") else target)
        for peer in bench.peers:
            of = [(ours, row) for (name, _, threads), (row, ours) in found.items() if name == peer and threads == max(THREADS)]
            if of:
                yield [f"Against {peer}, ours with {kernels(target)}?", f"`{OURS}` {outcome(by_order(of))}",
                       f"{peer} is {bench.context.get(peer, 'of unknown version')}; whole frames, {max(THREADS)} threads"]


def answers(bench, accuracy):
    """Lines for HEADER; none for what was not measured."""
    told = [*exactness_rows(accuracy, bench.context.get("simd_target")), *gap_rows(accuracy)] if accuracy else []
    return [*speed_rows(bench), *told, *peer_rows(bench)][:MOST]
