"""What each factor of a rasterizer gains: pairs of the benchmark's cells, whole frames, that differ in one factor.

Cells are the rows cell/SCENE/traversal:bands|tiles/fill:spans|edges/simd:TARGET[/with:hiz[+masks]]/threads:N.
"""
from itertools import product
from typing import NamedTuple

from bench_rows import gained, order
from noise import interval, median
from tables import about, kernels

SCALAR = "scalar"
HIZ, MASKS = "hiz", "hiz+masks"
ELSEWHERE = "elsewhere"
DEEP, SMALL_PX = 4, 10  # where HiZ and masks can act: overdraw; covered pixels per triangle
TRAVERSALS, FILLS = ("bands", "tiles"), ("spans", "edges")


class Cell(NamedTuple):
    scene: str
    traversal: str
    fill: str
    simd: bool
    extra: str  # "", HIZ or MASKS
    threads: int


def cells(bench):
    """{Cell: row}"""
    return {Cell(row.scene, row.keys["traversal"], row.keys["fill"], row.keys["simd"] != SCALAR, row.keys.get("with", ""),
                 row.threads): row for row in bench.sweep("traversal")}


def most_threads(found):
    return max((cell.threads for cell in found), default=1)


def chosen(found, **levels):
    """{Cell: row} of the cells with these levels; unless `levels` say otherwise, on the most threads, and without HiZ and masks."""
    levels = {"threads": most_threads(found), "extra": "", **levels}
    return {cell: row for cell, row in found.items() if all(getattr(cell, field) == level for field, level in levels.items())}


def triangle_px(row):
    """Covered pixels per triangle, culled ones included."""
    return row.counters["covered_px"] / row.counters["triangles"]


def factors(threads):
    """(factor, where, field of a cell, level before, level after, levels of other factors, whether a row's scene is meant)"""
    def everywhere(_):
        return True

    for fill in FILLS:
        yield "tiles over bands", f"with {fill}", "traversal", *TRAVERSALS, {"fill": fill}, everywhere
    for traversal in TRAVERSALS:
        yield "edges over spans", f"in {traversal}", "fill", *FILLS, {"traversal": traversal}, everywhere
    for traversal, fill in product(TRAVERSALS, FILLS):
        yield "SIMD over scalar", f"{fill} in {traversal}", "simd", False, True, {"traversal": traversal, "fill": fill}, everywhere
    for where, deep in ((f"overdraw ≥{DEEP}", True), (ELSEWHERE, False)):
        yield "HiZ", where, "extra", "", HIZ, {}, lambda row, deep=deep: (row.counters["overdraw"] >= DEEP) == deep
    for where, small in ((f"triangles ≤{SMALL_PX} px", True), (ELSEWHERE, False)):
        yield "masks, with HiZ", where, "extra", HIZ, MASKS, {}, lambda row, small=small: (triangle_px(row) <= SMALL_PX) == small
    yield f"{threads} threads over 1", "no HiZ or masks", "threads", 1, threads, {}, everywhere


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

    @property
    def text(self):
        """The median of the scenes, and its 95 % interval over scenes."""
        low, high = (about(end).removesuffix("×") for end in interval(self.by_scene))
        return f"{about(self.median)} ({low} to {high})"

    @property
    def counts(self):
        """In how many pairs the factor is settled faster and slower."""
        return f"{self.orders.count(-1)} / {self.orders.count(1)} of {len(self.orders)}"


def gains(bench):
    """A Gain of each factor on the most threads, in all scenes."""
    found = cells(bench)
    for factor, where, field, before, after, levels, meant in factors(most_threads(found)):
        pairs = [(cell.scene, found[other], row) for cell, row in chosen(found, **{"simd": True, **levels, field: after}).items()
                 if before != after and meant(row) and (other := cell._replace(**{field: before})) in found]
        if pairs:
            yield Gain(factor, where, field, sorted((gained(other, row), scene) for scene, other, row in pairs),
                       [order(row, other) for _, other, row in pairs])


def factor_table(bench):
    """Header and lines; no lines if no cell was timed."""
    return (["factor", kernels(bench.context.get("simd_target")), "settled faster / slower"],
            [[f"{gain.factor}, {gain.where}", gain.text, gain.counts] for gain in gains(bench)])
