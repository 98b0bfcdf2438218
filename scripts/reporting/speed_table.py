"""README's table of speed: times of ours and of peers for whole frames."""
from bench_rows import order
from tables import THREADS, milliseconds, scene_facts


def speed_table(bench):
    """Header and lines, one per scene; bold: the settled fastest of ours."""
    lines = []
    for scene in bench.scenes:
        ours = {backend: row for backend in bench.backends if (row := bench.frame(backend, scene, max(THREADS)))}

        def cell(row):
            best = all(order(row, other) < 0 for other in ours.values() if other is not row)
            return f"**{milliseconds(row)}**" if best and len(ours) > 1 else milliseconds(row)

        lines.append([scene, scene_facts(bench, scene)[0],
                      *(cell(ours[backend]) if backend in ours else "–" for backend in bench.backends),
                      *(milliseconds(bench.frame(peer, scene, max(THREADS))) for peer in bench.peers)])
    return ["scene", "triangles", *bench.backends, *bench.peers], lines
