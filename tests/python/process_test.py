"""Edgewise beside the rest of a process: its exit."""
import subprocess
import sys

import pytest

# Loops of threads that the interpreter's end interrupts.
LOOPS = {
    "draw on 1 thread": "mine.draw(camera, size, ids=True)",
    "draw on 2 threads": "mine.draw(camera, size, ids=True, threads=2)",
    "draw on 3 threads": "mine.draw(camera, size, ids=True, threads=3)",
    "draw of one scene": "shared.draw(camera, size, ids=True)",
    "queries": "mine.barycentrics(frame, camera), edgewise.pixel_hash(frame), edgewise.visible_triangles(frame)",
    "files": "edgewise.write_image(file, frame.payload), edgewise.read_image(file)",
    "needs": "mine.needs(camera, size)",
}
PROGRAM = """
import sys, threading, time
sys.path.insert(0, sys.argv[1])
import edgewise
from support import triangles
positions, indices, colours = triangles(1500)
shared, size = edgewise.Scene(positions, indices), (320, 240)
camera = shared.camera(4 / 3)
frame = shared.draw(camera, size, ids=True)
def loop(i):
    mine, file = edgewise.Scene(positions, indices), f"{sys.argv[2]}/{i}.png"
    while True: LOOP
for i in range(3): threading.Thread(target=loop, args=(i,), daemon=True).start()
time.sleep(0.1)
sys.exit(3)
"""


@pytest.mark.parametrize("name", LOOPS)
def test_threads_that_draw_while_python_ends_change_nothing(name, tmp_path):
    for _ in range(3):
        done = subprocess.run([sys.executable, "-c", PROGRAM.replace("LOOP", LOOPS[name]), __file__.rpartition("/")[0], tmp_path],
                              capture_output=True, text=True, check=False, timeout=60)
        assert (done.returncode, done.stdout, done.stderr) == (3, "", "")
