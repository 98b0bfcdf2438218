"""README's first table: the answers to its questions, each with its condition."""
from facts_tables import pooled_text
from factors import cells, chosen, gains, most_threads
from frontier import EXACT, INSIDE_TESTS, PRICED, simd_gain, wrong_of
from bench_tables import OURS, THREADS, compared_targets, faster, timed_peers
from tables import about, by_order, enumerated, kernels, outcome

HEADER = ["question", "answer", "condition"]
MOST = 8
PARALLEL, BOXES = "Parallel or scanline?", "Or test the whole bounding box?"  # of cells
ON_AND_OFF_GRID = ("mesh_on_grid", "mesh")


def factor_rows(bench):
    target, by_code = kernels(bench.context.get("simd_target")), {}
    for gain in gains(bench):
        if gain.field in ("traversal", "fill"):
            of = by_code.setdefault(f"with {target}" if gain.simd else "In scalar code", {})
            of.setdefault(gain.factor, []).append(f"{about(gain.median)} {gain.where} ({gain.counts})")
    if by_code:
        told = (f"{code}: " + "; ".join(f"{factor} {', '.join(said)}" for factor, said in of.items()) for code, of in by_code.items())
        yield [PARALLEL, "speed-up " + ". ".join(told),
               "medians of scenes (won/lost/open) of [cells](#speed) without HiZ and masks, as implemented here (scalar tiles with "
               "edges: the vector kernel with one lane); the size of triangles decides, too: "
               f"[chart](#speed); whole frames, {most_threads(cells(bench))} threads"]


def box_rows(bench):
    """The cells of bands and edges, which test whole boxes."""
    found, told, left_out = cells(bench), [], {}
    threads, target = most_threads(found), kernels(bench.context.get("simd_target"))
    for simd, name in ((False, "in scalar code"), (True, f"with {target}")):
        boxed = []
        for scene in dict.fromkeys(cell.scene for cell in found):
            others = {(cell.traversal, cell.fill): row for cell, row in chosen(found, scene=scene, simd=simd).items()}
            tested = others.pop(("bands", "edges"), None)
            if tested and others:
                boxed.append((tested, min(others.values(), key=lambda row: row.median_ms)))
            else:
                left_out[scene] = None
        told += [f"{name} {outcome(by_order(boxed))}"] if boxed else []
    if told:
        yield [BOXES, "; ".join(told),
               f"bands with edges against the fastest other cell; [cells](#speed) without HiZ and masks; whole frames, {threads} threads"
               + (f"; left out, too slow to repeat: {', '.join(left_out)}" if left_out else "")]


def rated(pooled):
    """A rate, and in brackets that without the scene with over half of the errors."""
    rate, *without = pooled_text(pooled).split("; ")
    return rate + "".join(f" ({said})" for said in without)


def exactness_rows(accuracy, target):
    found = {name: simd_gain(accuracy, name, EXACT) for name in PRICED if name != EXACT}
    if all(found.values()):
        of = {method.name: method for method in accuracy.methods["coverage"]}
        wrong = ", ".join(f"`{name}` {rated(wrong_of(accuracy, of[name]))}" for name in PRICED)
        kernel = simd_gain(accuracy, "engine_float", "engine_exact")
        yield ["What does exactness cost?", "speed-up by " + "; by ".join(f"`{name}` {gain}" for name, gain in found.items())
               + (f"; in `{OURS}`'s kernel, by floats {kernel}" if kernel else "") + f". Wrong pixels per 10⁶ crossings: {wrong}",
               f"over `{EXACT}`, exact after snapping, in a loop with snapping and set-up; geometric mean, range and won/lost/open of scenes; wrong pixels without scenes of few crossings, `double_tie` among them; one thread, {kernels(target)}"]


def gap_rows(accuracy):
    turned = (accuracy.cube or {"methods": ()})["methods"]
    ours = [counts for m, *counts in turned if m.ours]
    if ours:
        told = [(f"`{m.name}`", *counts) for m, *counts in turned if m.name in INSIDE_TESTS] + [("ours", *map(max, zip(*ours)))]
        yield ["Gaps / double hits / wrong samples when the cube turns?", ", ".join(f"{who} {' / '.join(f'{n:,}' for n in of)}" for who, *of in told),
               f"{accuracy.cube['frames']:,} frames of the tutorials' cube, all added; wrong against the exact projection of its vertices, of which methods get floats, and ours snap these to 1/256 px; "
               "`float_le` takes samples on an edge as inside, `float_lt` does not"]
    told = []
    for scene in (s for s in accuracy.of("coverage") if s.name in ON_AND_OFF_GRID):
        ours = [m.seen for m in scene.measured if m.method.ours and m.seen]
        of = [(f"`{name}`", m.seen) for name in INSIDE_TESTS if (m := scene.of(name)) and m.seen] + [("ours", max(ours))] if ours else []
        wrong = [f"{who} {px:,} / {holes:,}" for who, (px, holes) in of if px]
        right = [who for who, (px, _) in of if not px]
        told += [f"`{scene.name}`: " + ", ".join(wrong + ([f"0 by {enumerated(right)}"] if right else []))] if of else []
    if told:
        yield ["Wrong pixels / of these holes where edges meet pixel centres?", "; ".join(told),
               "two meshes that cover the picture; a quarter of the vertices of `mesh_on_grid` lie on centres, all on the 1/256 px grid, those of `mesh` anywhere; "
               "a hole shows another surface; [more scenes](results/README.md#accuracy)"]


def peer_rows(bench):
    for peer in timed_peers(bench):
        target, found = compared_targets(bench, peer)[-1]
        left_out = [scene for scene, threads in found if threads == THREADS[-1] and (scene, THREADS[0]) not in found]
        yield [f"Against {peer}?", f"`{OURS}` {faster(found)}",
               f"{peer} is {bench.context.get(peer, 'of unknown version')}; whole frames, ours with {kernels(target)}, and clusters out of view skipped; of two draws of a frame over 0.3 s the faster counts, and only a ratio over 2 is settled"
               + (f"; left out on {THREADS[0]} thread: {', '.join(left_out)}" if left_out and len(left_out) < len(found) // 2 else "")]


def answers(bench, accuracy):
    """Lines for HEADER; none for what was not measured."""
    told = [*exactness_rows(accuracy, bench.context.get("simd_target")), *gap_rows(accuracy)] if accuracy else []
    return [*factor_rows(bench), *box_rows(bench), *told, *peer_rows(bench)][:MOST]
