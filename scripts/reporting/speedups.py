"""Comparisons in words: the faster side, the speed-up, and whether the repetitions settle it."""
from bench_rows import order

# Of each SIMD target: its name in sentences, and the width of its vectors in bits.
VECTORS = {"sse4": ("SSE4", 128), "avx2": ("AVX2", 256), "avx512": ("AVX-512", 512)}


def kernels(target):
    """"AVX-512", or "scalar code"."""
    return VECTORS[target][0] if target in VECTORS else "scalar code" if target == "scalar" else target or "unknown SIMD"


def with_width(target):
    """"AVX-512, 512 bits"."""
    return f"{kernels(target)}, {VECTORS[target][1]} bits" if target in VECTORS else kernels(target)


def about(ratio):
    """With two digits, as many as the noise allows."""
    return f"{ratio:.2f}×" if ratio < 1.095 else f"{ratio:.1f}×" if ratio < 9.95 else f"{float(f'{ratio:.2g}'):,.0f}×"


def spread(ratios):
    ends = list(dict.fromkeys(map(about, (min(ratios), max(ratios)))))
    return " to ".join(ends)


def outcome(compared, what):
    """"wins 9 of 15 scenes, 1.1× to 2.6× faster; 6 are too close to call": `compared` has pairs of rows, ours first."""
    won, lost, close = [], [], []
    for ours, other in compared:
        (close, won, lost)[-order(ours, other)].append(other.median_ms / ours.median_ms)
    text = f"wins {'all ' if len(won) == len(compared) else f'{len(won)} of '}{len(compared)} {what}"
    if won:
        text += f", {spread(won)} faster"
    if lost:
        text += f"; it loses {len(lost)}, {spread([1 / ratio for ratio in lost])} slower"
    if close:
        text += f"; {len(close)} {'is' if len(close) == 1 else 'are'} too close to call"
    return text


def narrower_sentence(bench):
    """How much faster whole frames are with the widest vectors than with narrower ones; empty if these were not timed."""
    of_target = {}
    for row in bench.sweep("target"):
        if row.frontend and (widest := bench.frame(row.backend, row.scene, row.threads)):
            of_target.setdefault(row.keys["target"], []).append((widest, row))
    best = kernels(bench.context.get("simd_target"))
    said = [f"Against {kernels(target)}, {best} {outcome(of_target[target], 'rows')}." for target in reversed(VECTORS) if target in of_target]
    return f"Whole frames of `tiled` on one and on two threads: {' '.join(said)}" if said else ""


def speed_up(ratio):
    """A speed-up in a table, "2.6× slower" if below 1."""
    return about(ratio) if ratio >= 1 else f"{about(1 / ratio)} slower"


def mark(ratio, settled):
    return speed_up(ratio) + ("" if settled else " (not settled)")
