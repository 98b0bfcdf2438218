"""The colours and markers of all charts. A colour has one meaning in all of them."""

# Okabe and Ito, "Color Universal Design", 2008.
BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9"
BLACK, INK, FAINT = "#000000", "#24292f", "#6e7781"
BAND = "#f0f2f4"  # behind a special part of an axis

BACKENDS = {"scanline": (BLUE, "o"), "naive": (ORANGE, "s"), "tiled": (GREEN, "^")}
ADDED = (("#7f5539", "D"), ("#8a8f00", "v"), ("#5c4d9a", "P"), ("#6b705c", "X"))  # for backends that a user adds

OURS = (BLACK, "o")  # a method of the library that is no backend, or several that share a curve
KINDS = ((VERMILION, "D"), (SKY, "v"), (PURPLE, "P"), ("#8b1e3f", "*"), ("#6b705c", "X"))
OTHER = ("#8c959f", "X")

# Whether a step of the ablation made the backend faster; see ablation.verdict().
VERDICTS = {"gain": BLACK, "loss": "#b3261e", "neither": "#8c959f"}


def backend_looks(backends):
    """{backend: (colour, marker)}"""
    added = [backend for backend in backends if backend not in BACKENDS]
    return {backend: BACKENDS.get(backend) or ADDED[added.index(backend) % len(ADDED)] for backend in backends}


def kind_looks(family):
    """{kind of method: (colour, marker)} in a family."""
    return {"ours": OURS, "other": OTHER, **dict(zip(family.kinds, KINDS))}
