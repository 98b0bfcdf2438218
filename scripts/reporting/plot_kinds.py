"""What the charts of accuracy and of stability share: a look for each kind of method."""
from palette import kind_looks
from plot_style import plt

class Kinds:
    """Colour and marker of each kind of method in a family."""

    def __init__(self, family):
        self.family = family
        self.looks = kind_looks(family)

    def of(self, method):
        return self.looks[self.family.kind(method)]

    def legend(self, figure, y, methods, extra):
        """Kinds of methods, and below them what else marks a point."""
        present = {self.family.kind(method) for method in methods}
        names = {"ours": "ours (bold)", "other": "others"}
        handles = [plt.Line2D([], [], color=colour, marker=marker, linestyle="", markersize=7, label=names.get(kind, kind))
                   for kind, (colour, marker) in sorted(self.looks.items(), key=lambda item: item[0] == "other")
                   if kind in present]
        for line, row in enumerate((handles, extra)):
            figure.legend(handles=row, loc="upper left", bbox_to_anchor=(0.005, y - 0.2 * line / figure.get_figheight()),
                          ncol=len(row), frameon=False, handletextpad=0.4, columnspacing=1.3, fontsize=9.5)
