"""The findings on README's first screen, each in a sentence or two, made from the results."""
from accuracy_findings import before_snapping_clause, listed, numbered
from bench_rows import order
from frontier import simd_outcome
from speedups import about, kernels, outcome, spread, with_width
from peers import OURS, pairs
from tables import THREADS, number

# The tutorials' inside tests, and the scene with shared edges through pixel centres.
TUTORIAL_TESTS = ("float_lt", "float_le")
CENTRED_SCENE = "mesh_on_grid"
# The same engine with exact edges and with the tutorials' float edges.
ENGINES = ("engine_exact", "engine_float")
NARROW_ENGINE = "engine_int32"


def speed_finding(bench):
    """Parallel or scanline? Over the scenes that `tiled` and `scanline` drew, on the most threads."""
    threads = max(THREADS)
    drawn = [{b: row for b in (OURS, "scanline", "naive") if (row := bench.frame(b, scene, threads))}
             for scene in bench.scenes]
    drawn = [rows for rows in drawn if OURS in rows and "scanline" in rows]
    if not drawn:
        return ""
    text = (f"**Parallel or scanline?** In whole frames on {threads} threads, with {kernels(bench.context.get('simd_target'))} in all "
            f"backends, `{OURS}` {outcome([(rows[OURS], rows['scanline']) for rows in drawn], 'scenes against `scanline`')}.")
    boxed = [(rows["naive"], min(rows[OURS], rows["scanline"], key=lambda row: row.median_ms)) for rows in drawn if "naive" in rows]
    slower = [slow.median_ms / fast.median_ms for slow, fast in boxed if order(fast, slow) < 0]
    if slower:
        text += (f" `naive`, which tests every pixel of the bounding box, is {spread(slower)} slower than the faster of the "
                 f"two on {len(slower)} of {len(boxed)} scenes.")
    for scene in bench.scenes:
        draws = [bench.find(f"{backend}/{scene}/threads:{threads}") for backend in ("naive", OURS, "scanline")]
        if not bench.frame("naive", scene, threads) and all(draws):
            slow, *fast = (row.median_ms for row in draws)
            if slow > min(fast):
                text += (f" On `{scene}`, where whole frames of `naive` are too slow to repeat, its draw alone is "
                         f"{about(slow / min(fast))} slower than the faster of the two.")
    return text


def turned(name, cube):
    """A method's errors on the turning cube: "leaves 3 gaps and hits 2 pixels twice"."""
    gaps, doubles = (cube[name][key] for key in ("total_gaps", "total_double_hits"))
    said = [*([f"leaves {numbered(gaps, 'gap')}"] if gaps else []),
            *([f"draws {numbered(doubles, 'pixel')} twice"] if doubles else [])]
    return f"`{name}` {' and '.join(said) or 'errs nowhere'}"


def crack_finding(accuracy):
    """Gaps between neighbours on the turning cube, and on edges through pixel centres."""
    if accuracy is None:
        return ""
    sentences = []
    if accuracy.cube:
        cube = {method.name: found for method, found in accuracy.cube["methods"]}
        ours = [method.name for method, _ in accuracy.cube["methods"] if method.ours]
        tests = [turned(name, cube) for name in TUTORIAL_TESTS if name in cube]
        wrong = sum(cube[name][key] for name in ours for key in ("total_gaps", "total_double_hits"))
        if tests and ours:
            sentences.append(f"In {accuracy.cube['frames']:,} frames of the tutorials' cube {', '.join(tests)}; "
                             + (f"{listed(ours)} do neither." if wrong == 0 else f"ours err at {numbered(wrong, 'pixel')}."))
    scene = next((s for s in accuracy.of("coverage") if s.name == CENTRED_SCENE), None)
    measured = {m.method.name: m for m in scene.measured} if scene else {}
    tests = [measured[name] for name in TUTORIAL_TESTS if name in measured]
    ours = [m for m in measured.values() if m.method.ours]
    if tests and ours:
        wrong = " and ".join(f"{number(m.rate)} (`{m.method.name}`)" for m in tests)
        sentences.append(f"Where edges run through pixel centres (`{scene.name}`), those tests get {wrong} pixels wrong per 10⁶ "
                         f"edge crossings, ours {number(max(m.rate for m in ours))}.")
    return f"**Gaps when the cube turns?** {' '.join(sentences)}" if sentences else ""


def engine_outcome(accuracy, ours, other):
    """ "1.2× slower on `mesh`, no significant difference on `torus-knot`" of two methods with SIMD; empty if not measured."""
    found = simd_outcome(accuracy, ours, other)
    if found is None:
        return ""
    won, lost, close = found
    said = [f"{about(1 / ratio)} slower on `{name}`" for name, ratio in lost.items()]
    said += [f"{about(ratio)} faster on `{name}`" for name, ratio in won.items()]
    said += [f"no significant difference on {listed(close)}"] if close else []
    return ", ".join(said)


def narrow_edges_sentence(accuracy):
    """What 32-bit edge values would save that are not rebased per tile; empty if not measured."""
    said = engine_outcome(accuracy, ENGINES[0], NARROW_ENGINE) if accuracy else ""
    return (f"Our backends take no shortcut for scenes whose edge values fit 32 bits. `{ENGINES[0]}`, which rebases them per tile, "
            f"against `{NARROW_ENGINE}`, which does not: {said}.") if said else ""


def engine_sentence(accuracy):
    """The cost of exact edges in the engine that runs both kinds of numbers; empty if not measured."""
    exact, loose = ENGINES
    said = engine_outcome(accuracy, exact, loose)
    return (f"In the same SIMD engine ({kernels(accuracy.machine.get('simd_best'))}, one thread), exact coverage against float edges "
            f"(`{loose}`): {said}.") if said else ""


def exactness_finding(accuracy):
    """The cost of exactness: time in the same engine, and errors against unsnapped positions."""
    if accuracy is None:
        return ""
    sentences = [engine_sentence(accuracy), before_snapping_clause(accuracy, TUTORIAL_TESTS[0])]
    return " ".join(["**What does exactness cost?**", *filter(None, sentences)]) if any(sentences) else ""


def peer_finding(bench):
    texts = []
    for peer in bench.peers:
        sentences = []
        for target, found in ((bench.context.get("simd_target"), pairs(bench)), ("avx2", pairs(bench, "avx2"))):
            of = [p for (name, _, threads), p in found.items() if name == peer and threads == max(THREADS)]
            if of:
                sentences.append((with_width(target), outcome([(p.ours, p.peer) for p in of], "scenes, in whole frames")))
        if sentences:
            (width, said), *narrower = sentences
            text = (f"**Against {peer}** ({bench.context.get(peer, 'unknown version')}): on {max(THREADS)} threads, `{OURS}` with "
                    f"{width}, {said}.")
            texts.append(" ".join([text, *(f"With {width}, it {said}." for width, said in narrower)]))
    return " ".join(texts)


def findings(bench, accuracy):
    found = speed_finding(bench), crack_finding(accuracy), exactness_finding(accuracy), peer_finding(bench)
    return [text for text in found if text]
