"""What each factor of a rasterizer gains: pairs of the benchmark's cells, whole frames, that differ in one factor.

Cells are the rows cell/SCENE/traversal:bands|tiles/fill:spans|edges/simd:TARGET[/with:hiz[+masks]]/threads:N.
"""
from typing import NamedTuple

from bench_rows import gained, order
from noise import LEVEL, median
from tables import about, kernels, number

SCALAR = "scalar"
HIZ, MASKS = "hiz", "hiz+masks"


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


def factors(threads):
    """{title: (field of a cell, level before, level after)}"""
    return {"tiles over bands": ("traversal", "bands", "tiles"), "edges over spans": ("fill", "spans", "edges"),
            "SIMD over scalar": ("simd", False, True), "HiZ": ("extra", "", HIZ), "masks, with HiZ": ("extra", HIZ, MASKS),
            f"{threads} threads over 1": ("threads", 1, threads)}


class Gain(NamedTuple):
    """The speed-ups by a factor in cells with or without SIMD, all else equal."""
    factor: str
    simd: bool
    median: float
    least: tuple  # (speed-up, scene)
    most: tuple
    faster: int
    slower: int
    open: int

    @property
    def pairs(self):
        return self.faster + self.slower + self.open


def gains(bench):
    """A Gain of each factor on the most threads, in all scenes and at all levels of the other factors: with SIMD, then in scalar
    code."""
    found = cells(bench)
    threads = most_threads(found)
    for simd in (True, False):
        for title, (field, before, after) in factors(threads).items():
            pairs = [(cell.scene, found[plain], row) for cell, row in found.items()
                     if (cell.simd, cell.threads, getattr(cell, field)) == (simd, threads, after) and before != after
                     and (plain := cell._replace(**{field: before})) in found]
            if pairs:
                speed_ups = [(gained(plain, row), scene) for scene, plain, row in pairs]
                orders = [order(row, plain) for _, plain, row in pairs]
                yield Gain(title, simd, median(ratio for ratio, _ in speed_ups), min(speed_ups), max(speed_ups),
                           *map(orders.count, (-1, 1, 0)))


def said(gain):
    """Its median and its range: "1.1×", "0.59× in cubes to 2.9× in micro"."""
    return about(gain.median), " to ".join(f"{about(ratio)} in {scene}" for ratio, scene in (gain.least, gain.most))


def factor_table(bench):
    """Header and lines; no lines if no cell was timed."""
    with_simd = kernels(bench.context.get("simd_target"))
    return (["factor", "code", "median", "range", "won/lost/open"],
            [[gain.factor, with_simd if gain.simd else SCALAR, *said(gain), f"{gain.faster}/{gain.slower}/{gain.open}"]
             for gain in gains(bench)])


def conditions(bench, codes=(True, False)):
    """What the table's lines with SIMD, or without, are, and how many of their verdicts may be false."""
    pairs = sum(gain.pairs for gain in gains(bench) if gain.simd in codes)
    return (f"Pairs of whole frames on {most_threads(cells(bench))} threads that differ in one factor, as Edgewise implements it; of "
            f"{pairs} verdicts, at most {number(LEVEL * pairs, 2)} false ones are expected.")


class Duel(NamedTuple):
    """The fastest cell with bands against the fastest with tiles, in one scene."""
    scene: str
    triangle_px: float
    overdraw: float
    bands: tuple  # (Cell, row)
    tiles: tuple
    plain_tiles: object  # the row of the fastest tiles without HiZ
    all_bands: tuple  # rows
    all_tiles: tuple

    @property
    def order(self):
        """-1 if the fastest bands are faster than all tiles, 1 if the fastest tiles are than all bands, 0 if neither is settled."""
        if all(order(self.bands[1], row) < 0 for row in self.all_tiles):
            return -1
        return int(all(order(self.tiles[1], row) < 0 for row in self.all_bands))

    @property
    def ratio(self):
        """The speed-up of bands over tiles."""
        return gained(self.tiles[1], self.bands[1])

    @property
    def winner(self):
        return (self.bands if self.ratio > 1 else self.tiles)[0]


def duels(bench, simd):
    """On the most threads, in the suite's order."""
    found = cells(bench)
    threads = most_threads(found)

    def median_ms(pair):
        return pair[1].median_ms

    for scene in dict.fromkeys(cell.scene for cell in found):
        bands, tiles = ([(cell, row) for cell, row in found.items() if (cell.scene, cell.simd, cell.threads, cell.traversal) ==
                         (scene, simd, threads, traversal)] for traversal in ("bands", "tiles"))
        plain = [pair for pair in tiles if not pair[0].extra]
        if bands and plain:
            first = min(bands, key=median_ms)
            seen = first[1].counters
            yield Duel(scene, seen["covered_px"] / seen["triangles"], seen["overdraw"], first, min(tiles, key=median_ms),
                       min(plain, key=median_ms)[1], *(tuple(row for _, row in side) for side in (bands, tiles)))
