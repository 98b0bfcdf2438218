"""The findings on README's first screen: what the charts say, each in a sentence or two."""
from statistics import median

from accuracy_lessons import fastest as fastest_measured, listed
from peers import pairs, times
from tables import THREADS, number

# The tutorials' inside tests, and the scene that shows what becomes of shared edges.
TUTORIAL_TESTS = ("float_lt", "float_le")
TIDY_SCENE = "mesh_on_grid"


def spread(ratios):
    return f"{times(min(ratios))} to {times(max(ratios))}"


def speed_finding(bench):
    """Parallel or scanline? Over the scenes that all backends drew, on the most threads."""
    threads = max(THREADS)
    ms = {scene: {b: row.median_ms for b in bench.backends if (row := bench.find(f"{b}/{scene}/threads:{threads}"))}
          for scene in bench.scenes}
    ms = {scene: of for scene, of in ms.items() if {"scanline", "naive", "tiled"} <= of.keys()}
    if not ms:
        return ""
    # How many times longer than tiled scanline takes, the largest ratio first.
    ahead = sorted(((of["scanline"] / of["tiled"], scene) for scene, of in ms.items()), reverse=True)
    won = [(ratio, scene) for ratio, scene in ahead if ratio > 1]
    text = (f"**Parallel or scanline?** On {threads} threads `tiled` is the faster on {len(won)} of {len(ms)} scenes"
            + (f", by {times(won[0][0])} at most (`{won[0][1]}`)" if won else ""))
    if len(won) < len(ms):
        ratio, scene = ahead[-1]
        text += f"; `scanline` on the others, by {times(1 / ratio)} at most (`{scene}`)"
    return text + (". Asking of every pixel of the bounding box, as `naive` does, takes "
                   f"{spread([of['naive'] / min(of.values()) for of in ms.values()])} as long as the faster of them.")


def accuracy_finding(accuracy):
    """Are the tutorials' tests wrong, and does it cost speed to be right?"""
    scene = next((s for s in accuracy.of("coverage") if s.name == TIDY_SCENE), None) if accuracy else None
    if scene is None:
        return ""
    measured = {m.method.name: m for m in scene.measured}
    ours = [m for m in scene.measured if m.method.ours]
    tests = [measured[name] for name in TUTORIAL_TESTS if name in measured]
    if not ours or not tests:
        return ""
    wrong = " and ".join(f"{number(m.rate)} (`{m.method.name}`)" for m in tests)
    text = (f"**Gaps when the cube turns?** Of 10⁶ edge crossings of a mesh whose vertices lie tidily, the tutorials' inside "
            f"tests get {wrong} pixels wrong; {listed(m.method.name for m in ours)} "
            f"{number(max(m.rate for m in ours))}.")
    if scene.single:
        us, others = ([m for m in scene.single if m.method.ours == whose] for whose in (True, False))
        if us and others:
            best, rival = fastest_measured(us)[0], fastest_measured(others)[0]
            text += (f" Per covered pixel `{best.method.name}`, with SIMD, takes {best.costs[1].ns / rival.costs[1].ns:.2f} "
                     f"times as long as the fastest of the others, `{rival.method.name}`, in plain C++.")
    return text


def peer_finding(bench):
    found = [(key, p) for key, p in pairs(bench).items() if key[2] == max(THREADS)]
    if not found:
        return ""
    texts = []
    for peer in dict.fromkeys(key[0] for key, _ in found):
        ratios = [p.ratio for key, p in found if key[0] == peer]
        texts.append(f"**Against {peer}**, a software OpenGL, which draws the same pixels: it takes {spread(ratios)} as long "
                     f"on {max(THREADS)} threads ({times(median(ratios))} in the median of {len(ratios)} scenes).")
    return " ".join(texts)


def findings(bench, accuracy):
    return [text for text in (speed_finding(bench), accuracy_finding(accuracy), peer_finding(bench)) if text]
