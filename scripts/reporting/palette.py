"""The colours and markers of all charts, drawn or interactive: for each backend, and for each kind of method."""

# Okabe and Ito, "Color Universal Design", 2008; given out in the registry's order.
PALETTE = ["#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#000000"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X"]
INK, FAINT = "#24292f", "#6e7781"
OURS, OTHER = PALETTE[0], PALETTE[3]
KIND_COLOURS, KIND_MARKERS = (PALETTE[1], PALETTE[2], PALETTE[4]), ("s", "^", "D")
# What one change more made of a time; see ablation.verdict().
VERDICTS = {"gain": PALETTE[0], "loss": PALETTE[3], "neither": "#8c959f"}


def kind_looks(family):
    """{kind of method: (colour, marker)} in a family."""
    looks = {"ours": (OURS, "o"), "other": (OTHER, "v")}
    return {**looks, **{kind: look for kind, *look in zip(family.kinds, KIND_COLOURS, KIND_MARKERS)}}
