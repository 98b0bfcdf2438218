"""Chart of how many times longer other projects' rasterizers take than our backends."""
from peers import over_backend, pairs
from plot_scenes import gain_chart
from tables import THREADS


def against(bench, folder, caption):
    found = pairs(bench)
    for peer in dict.fromkeys(peer for peer, _, _ in found):
        scenes = [scene for scene in bench.scenes if any((peer, scene, n) in found for n in THREADS)]

        def value_of(scene, backend, peer=peer):
            return over_backend(bench, found.get((peer, scene, max(THREADS))), backend)

        gain_chart(bench, folder, caption, f"against-{peer}", scenes, value_of, f"How many times longer {peer} takes",
                   f"Time of {bench.context.get(peer, peer)} over ours on {max(THREADS)} threads; meshes from vertices to "
                   "picture, others from screen triangles.", f"time of {peer} over time of ours")
        yield f"against-{peer}"
