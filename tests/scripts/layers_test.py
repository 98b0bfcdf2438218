"""No include points up: which folder may include which others (the rooms of README's map)."""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BELOW = {
    "src/edgewise": [],
    "src/core": ["edgewise"],
    "src/scene": ["edgewise", "core"],
    "src/image": ["edgewise", "core"],
    "src/frontend": ["edgewise", "core"],
    "src/raster": ["edgewise", "core"],
    "src/lab": ["edgewise", "core", "scene", "frontend", "raster"],
    "src/support": ["edgewise", "core", "scene", "image"],
    "src/viewer": ["edgewise", "core", "scene", "image", "frontend", "raster", "lab", "support"],
    "bench": ["edgewise", "core", "scene", "image", "frontend", "raster", "lab", "support"],
    "src/cli": ["edgewise", "core", "scene", "image", "frontend", "raster", "lab", "support", "viewer",
                "bench"],  # its peers
}
TILES = ["ablation.h", "tile_list.h", "tile_store-inl.h", "tile_task.h", "tiles.h"]  # shared by the rooms that draw tiles
ROOMS_BELOW = {  # inside src/raster: rooms and headers
    "simd": [],
    "binning": ["simd"],
    "tiled": ["simd", "binning", *TILES],
    "scanline": ["simd", "binning", *TILES],
}


def included(source):
    return re.findall(r'^#include "([^"]+\.h)"', source.read_text(), re.MULTILINE)


def sources(folder):
    return [path for path in (ROOT / folder).rglob("*") if path.suffix in (".h", ".cpp")]


class Layers(unittest.TestCase):
    def test_every_folder_has_its_layer(self):
        self.assertEqual({path.name for path in (ROOT / "src").iterdir()} - {"package"},
                         {Path(folder).name for folder in BELOW} - {"bench"})

    def test_no_include_points_up(self):
        for folder, below in BELOW.items():
            allowed = {*below, Path(folder).name}
            for source in sources(folder):
                for header in included(source):
                    self.assertIn(header.split("/")[0], allowed, f"{source.relative_to(ROOT)} includes {header}")

    def test_rooms_of_raster_know_only_lower_ones(self):
        for room, below in ROOMS_BELOW.items():
            for source in sources(f"src/raster/{room}"):
                for header in included(source):
                    layer, *path = header.split("/")
                    if layer == "raster":
                        self.assertIn(path[0], {*below, room}, f"{source.relative_to(ROOT)} includes {header}")


if __name__ == "__main__":
    unittest.main()
