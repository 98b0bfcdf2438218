"""Draws README's picture to a file: the corner of a cube whose vertices lie on pixel centres, by three methods, wrong pixels tinted."""
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

from plot_style import plt
from program import ROOT

METHODS = {"float_lt": "Inside if all edge values are > 0", "dda_rounded": "Scanlines, rounded to pixels", "tiled": "Edgewise"}
SIZE = 46, 42  # px
CORNER, LEFT, RIGHT, BACK = (22.5, 19.5), (6.5, 11.5), (38.5, 11.5), (22.5, 3.5)
BOTTOM, BOTTOM_LEFT, BOTTOM_RIGHT = (22.5, 37.5), (6.5, 29.5), (38.5, 29.5)
# The three visible faces. Their edges go down, or two pixels sideways per row, so they meet many pixel centres.
FACES = {(228, 232, 236): (LEFT, BACK, RIGHT, CORNER), (176, 186, 198): (LEFT, CORNER, BOTTOM, BOTTOM_LEFT),
         (203, 211, 220): (CORNER, RIGHT, BOTTOM_RIGHT, BOTTOM)}


def stream():
    """The faces as a .tri file."""
    records = [struct.pack("<9f4B", *(value for corner in corners for value in (*corner, 0.5)), *colour, 255)
               for colour, (a, b, c, d) in FACES.items() for corners in ((a, b, c), (a, c, d))]
    return struct.pack("<4s3I", b"TRI1", *SIZE, len(records)) + b"".join(records)


figure, panels = plt.subplots(1, 3, figsize=(8.3, 2.72))
with tempfile.TemporaryDirectory() as folder:
    scene, picture = Path(folder) / "corner.tri", Path(folder) / "corner.png"
    scene.write_bytes(stream())
    for panel, (method, title) in zip(panels, METHODS.items()):
        subprocess.run([ROOT / "build/edgewise", "view", scene, "--coverage", method, "--keys", "e", "-o", picture],
                       check=True, stdout=subprocess.DEVNULL)
        panel.imshow(plt.imread(picture), interpolation="nearest")
        panel.set_title(title, loc="center", fontsize=10.5)
        panel.axis("off")
figure.savefig(sys.argv[1], dpi=200)
