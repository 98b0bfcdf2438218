"""Draws 200 views of a mesh by two workers of Dask, and prints a hash of each."""
from math import cos, pi, sin

from distributed import Client

import edgewise


def view_hash(i: int, scene: edgewise.Scene) -> int:
    eye = 4 * sin(2 * pi * i / 200), 1, 4 * cos(2 * pi * i / 200)
    camera = edgewise.Camera(edgewise.look_at(eye, (0, 0, 0)), edgewise.perspective(0.8, 16 / 9, 0.1))
    return edgewise.pixel_hash(scene.draw(camera, (320, 180), ids=True))


if __name__ == "__main__":
    # Two processes of this machine; or Client("scheduler:8786"), and the machines that serve that scheduler.
    with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:  # type: ignore[no-untyped-call]
        scene = client.scatter(edgewise.Scene.read_obj("mesh.obj"), broadcast=True)  # each worker gets it once
        for number in client.gather(client.map(view_hash, range(200), scene=scene)):
            print(f"{number:016x}")
