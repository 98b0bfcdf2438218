#!/usr/bin/env python3
"""Draws README's picture: the corner of a cube whose vertices lie on pixel centres, by three methods, wrong pixels tinted."""
import struct
import subprocess
import tempfile
from pathlib import Path

from plot_style import plt
from program import ROOT, Parser, main_guard

METHODS = {"float_lt": "Inside if all edge values are > 0", "dda_rounded": "Scanlines, rounded to pixels", "tiled": "Edgewise"}
SIZE, CORNER, SIDE = (46, 42), (22.5, 19.5), 16  # px
FACES = (("left", "back", "right", "corner"), ("left", "corner", "bottom", "bottom_left"), ("corner", "right", "bottom_right", "bottom"))
COLOURS = (228, 232, 236), (176, 186, 198), (203, 211, 220)


def triangles():
    """The three visible faces. Their edges go down, or two pixels sideways per row, so they meet many pixel centres."""
    x, y = CORNER
    half, down = SIDE / 2, SIDE + 2
    at = {"corner": (x, y), "left": (x - SIDE, y - half), "right": (x + SIDE, y - half), "back": (x, y - SIDE), "bottom": (x, y + down),
          "bottom_left": (x - SIDE, y + down - half), "bottom_right": (x + SIDE, y + down - half)}
    for face, colour in zip(FACES, COLOURS):
        for corners in (face[:3], (face[0], *face[2:])):
            yield struct.pack("<9f4B", *(value for corner in corners for value in (*at[corner], 0.5)), *colour, 255)


def main():
    parser = Parser(prog="corner_picture.py", description=__doc__, epilog="Needs build/edgewise. Exit status: 0 drawn, 2 bad input.")
    parser.add_argument("picture", type=Path, metavar="FILE.png")
    options = parser.parse_args()
    figure, panels = plt.subplots(1, 3, figsize=(8.3, 2.72), layout="constrained")
    with tempfile.TemporaryDirectory() as folder:
        stream = Path(folder) / "corner.tri"
        records = list(triangles())
        stream.write_bytes(struct.pack("<4s3I", b"TRI1", *SIZE, len(records)) + b"".join(records))
        for panel, (method, title) in zip(panels, METHODS.items()):
            picture = Path(folder) / f"{method}.png"
            subprocess.run([ROOT / "build/edgewise", "view", stream, "--coverage", method, "--keys", "e", "-o", picture],
                           check=True, stdout=subprocess.DEVNULL)
            panel.imshow(plt.imread(picture), interpolation="nearest")
            panel.set_title(title, loc="center", fontsize=10.5)
            panel.axis("off")
    figure.savefig(options.picture, dpi=200)
    return 0


main_guard(main)
