"""What the charts of accuracy and of stability share: a look for each kind of method, and for each backend."""
from palette import BACKENDS, kind_looks
from plot_style import plt


IN_A_ROW = 7  # of the legend


class Kinds:
    """Colour and marker of the methods of a family."""

    def __init__(self, family):
        self.family = family
        self.looks = kind_looks(family)

    def of(self, method):
        return BACKENDS.get(method.name) or self.looks[self.family.kind(method)]

    def legend(self, figure, y, methods, extra):
        """Backends and kinds of methods, and below them the other marks."""
        found = {(method.name if method.name in BACKENDS else self.family.kind(method)): self.of(method) for method in methods}
        names = {"ours": "ours (bold)", "other": "others", **{name: f"{name} (ours)" for name in BACKENDS}}
        handles = [plt.Line2D([], [], color=colour, marker=marker, linestyle="", markersize=7, label=names.get(kind, kind))
                   for kind, (colour, marker) in sorted(found.items(), key=lambda item: item[0] == "other")]
        rows = [handles[i:i + IN_A_ROW] for i in range(0, len(handles), IN_A_ROW)]
        for line, row in enumerate((*rows, extra)):
            figure.legend(handles=row, loc="upper left", bbox_to_anchor=(0.005, y - 0.2 * line / figure.get_figheight()),
                          ncol=len(row), frameon=False, handletextpad=0.4, columnspacing=1.3, fontsize=9.5)
