"""Draws two overlapping squares by the Python module, and prints the picture's hash; square.c and square.cpp draw the same."""
import numpy as np

import edgewise

WIDTH, HEIGHT = 320, 180
scene = edgewise.Scene()
square = scene.add_mesh([[-1, -1, 0], [-1, 1, 0], [1, 1, 0], [1, -1, 0]], [[0, 1, 2], [0, 2, 3]],
                        colours=[0xFF4639E6, 0xFF57C8FF])
scene.add_instance(square)
scene.add_instance(square, [[1, .25, 0, .5], [0, 1, 0, .25], [.5, 0, 1, -1], [0, 0, 0, 1.]])
view = np.eye(4)
view[2, 3] = -3
camera = edgewise.Camera(view, edgewise.perspective(1.0, WIDTH / HEIGHT, .1))
print(f"{edgewise.pixel_hash(scene.draw(camera, (WIDTH, HEIGHT), threads=2)):016x}")
