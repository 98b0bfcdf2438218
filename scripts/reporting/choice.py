"""The chart for choosing a method, as figures: each method's wrong pixels in a moving picture, and the milliseconds of that picture."""
from collections import namedtuple
from typing import NamedTuple

from tables import milliseconds, number

# How charts and tables name the methods, in their order.
TITLES = {"float_lt": "strict <", "float_le": "loose ≤", "float_top_left": "float top-left", "double_top_left": "double top-left",
          "fixed_4": "fixed 4 bits", "tiled_8": "tiled, 8 bits", "tiled_12": "tiled, 12 bits", "tiled_15": "tiled, 15 bits", "llvmpipe": "llvmpipe",
          "swiftshader": "SwiftShader"}
OURS = "tiled_"

Wrong = namedtuple("Wrong", "mean least most holes")  # wrong pixels per frame, and the holes of all frames
Point = namedtuple("Point", "method wrong row")  # with the time of the first frame


class Panel(NamedTuple):
    scene: str
    summary: str
    frames: int
    floats: Wrong | None  # what a projection in floats alone gets wrong; None if the scene has none
    wrong: dict  # by method

    def points(self, bench):
        """Of the methods that this run timed, in the order of TITLES."""
        rows = {method: bench.find(f"choice/{self.scene}/method:{method}/threads:1") for method in TITLES if method in self.wrong}
        return [Point(method, self.wrong[method], row) for method, row in rows.items() if row]


def parse_choices(choices):
    def wrong(entry, frames):
        return Wrong(int(entry["wrong_pixels"]) / frames, int(entry["least"]), int(entry["most"]), int(entry["holes"]))

    return tuple(Panel(of["name"], of["summary"], of["frames"], wrong(of["float_projection"], of["frames"]) if "float_projection" in of else None,
                       {entry["name"]: wrong(entry, of["frames"]) for entry in of["methods"]}) for of in choices)


def choice_table(accuracy, bench):
    """Header and lines: of each method and scene, the wrong pixels of a frame and its time; bold where a hole shows."""
    panels = [{point.method: point for point in panel.points(bench)} for panel in accuracy.choices]

    def cell(point):
        if not point:
            return "–"
        wrong = f"{number(point.wrong.mean, 2)} px"
        return f"{f'**{wrong}**' if point.wrong.holes else wrong}, {milliseconds(point.row)} ms"

    shown = {method: title for method, title in TITLES.items() if any(method in points for points in panels)}
    return (["method", *(f"`{panel.scene}`" for panel in accuracy.choices)],
            [[title, *(cell(points.get(method)) for points in panels)] for method, title in shown.items()])
