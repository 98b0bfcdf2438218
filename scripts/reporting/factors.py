"""What each factor of a rasterizer gains: pairs of the benchmark's cells, whole frames, that differ in one factor.

Cells are the rows cell/SCENE/traversal:bands|tiles/fill:spans|edges/simd:TARGET[/with:hiz[+masks]]/threads:N.
"""
from collections import namedtuple
from typing import NamedTuple

from bench_rows import gained, order
from noise import interval, median
from tables import about, kernels

SCALAR = "scalar"
HIZ, MASKS = "hiz", "hiz+masks"
ELSEWHERE = "elsewhere"
DEEP, SMALL_PX = 4, 10  # where HiZ and masks can act: overdraw; covered pixels per triangle, culled ones included

Cell = namedtuple("Cell", "scene traversal fill simd extra threads")  # simd: whether it is used; extra: "", HIZ or MASKS


def cells(bench):
    """{Cell: row}"""
    return {Cell(row.scene, row.keys["traversal"], row.keys["fill"], row.keys["simd"] != SCALAR, row.keys.get("with", ""),
                 row.threads): row for row in bench.sweep("traversal")}


def chosen(found, **levels):
    """{Cell: row} of the cells with these levels."""
    return {cell: row for cell, row in found.items() if levels.items() <= cell._asdict().items()}


def factors(threads):
    """(factor, field of a cell, level before, level after, where: the group of cells that a cell and its row belong to)"""
    def depth(_, row):
        return f"overdraw ≥{DEEP}" if row.counters["overdraw"] >= DEEP else ELSEWHERE

    def size(_, row):
        return f"triangles ≤{SMALL_PX} px" if row.counters["covered_px"] <= SMALL_PX * row.counters["triangles"] else ELSEWHERE

    return (("tiles over bands", "traversal", "bands", "tiles", lambda cell, _: f"with {cell.fill}"),
            ("edges over spans", "fill", "spans", "edges", lambda cell, _: f"in {cell.traversal}"),
            ("SIMD over scalar", "simd", False, True, lambda cell, _: f"{cell.fill} in {cell.traversal}"),
            ("HiZ", "extra", "", HIZ, depth),
            ("masks, with HiZ", "extra", HIZ, MASKS, size),
            (f"{threads} threads over 1", "threads", 1, threads, lambda *_: "no HiZ or masks"))


class Gain(NamedTuple):
    """The speed-ups by a factor in cells with SIMD: each pair is of two cells of a scene that differ in nothing else."""
    factor: str
    where: str
    field: str  # of a cell
    pairs: list  # (speed-up, scene), the smallest first
    orders: list  # order() of each pair

    @property
    def by_scene(self):
        """The median speed-up of each scene."""
        return [median(ratio for ratio, name in self.pairs if name == scene) for scene in dict.fromkeys(scene for _, scene in self.pairs)]

    @property
    def median(self):
        return median(self.by_scene)


def gains(bench):
    """The Gains of each factor in all scenes; unless it is about them, on the most threads, without HiZ and masks."""
    found = cells(bench)
    most = max((cell.threads for cell in found), default=1)
    for factor, field, before, after, where_of in factors(most):
        groups = {}
        for cell, row in chosen(found, **{"simd": True, "extra": "", "threads": most, field: after}).items():
            other = cell._replace(**{field: before})
            if other in found and other != cell:
                groups.setdefault(where_of(cell, row), []).append((cell.scene, found[other], row))
        for where, pairs in sorted(groups.items(), key=lambda group: group[0] == ELSEWHERE):
            yield Gain(factor, where, field, sorted((gained(other, row), scene) for scene, other, row in pairs),
                       [order(row, other) for _, other, row in pairs])


def told(gain):
    """A line: the median of the scenes and its interval over scenes, and in how many pairs the factor is settled faster and slower."""
    low, high = (about(end).removesuffix("×") for end in interval(gain.by_scene))
    return [f"{gain.factor}, {gain.where}", f"{about(gain.median)} ({low} to {high})",
            f"{gain.orders.count(-1)} / {gain.orders.count(1)} of {len(gain.orders)}"]


def factor_table(bench):
    """Header and lines; no lines if no cell was timed."""
    return ["factor", kernels(bench.context["simd_target"]), "settled faster / slower"], list(map(told, gains(bench)))
